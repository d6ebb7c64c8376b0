"""The quantities of the equations of motion, named as in the paper, and what an equation is.

A *wheel quantity* is a symbol for a wheel of side s; ``on_side`` gives the left or right wheel's.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from wheelset.vehicle.geometry import QUANTITIES, SIDES
from wheelset.vehicle.symbols import p, s


@dataclass(frozen=True)
class Equation:
    """symbol = expression. number: in the paper; unit and meaning: for the table of symbols."""

    symbol: sp.Symbol
    expression: sp.Expr
    number: str
    unit: str
    meaning: str


def _real(name: str) -> sp.Symbol:
    return sp.Symbol(name, real=True)


# Wheel quantities, in the order of evaluation.
dr, delta, rho = map(_real, QUANTITIES)
r, gamma, cos_gamma, sin_gamma = map(_real, ("r", "gamma", "cos_gamma", "sin_gamma"))
A, B, ratio, N, patch = map(_real, ("A", "B", "k", "N", "ab"))
shape, cube = map(_real, ("shape", "ab_cubed"))
C11, C22, C23, C33 = map(_real, ("C11", "C22", "C23", "C33"))
f11, f22, f23, f33 = map(_real, ("f11", "f22", "f23", "f33"))
xi_x, xi_y, xi_s = map(_real, ("xi_x", "xi_y", "xi_s"))
Kx, Ky, Kz = map(_real, ("Fx_linear", "Fy_linear", "Mz_linear"))
u2, saturation = map(_real, ("u_squared", "saturation"))
Fx, Fy, Mz, Fyn = map(_real, ("Fx", "Fy", "Mz", "Fyn"))
Fx_track, Fy_track, Mz_track = map(_real, ("Fx_track", "Fy_track", "Mz_track"))
# Quantities of the wheelset.
phi, G = _real("phi"), p.E / (2 * (1 + p.nu))
Fyc, Mzc, Ft = map(_real, ("Fyc", "Mzc", "Ft"))
ydd, psidd = map(_real, ("ydd", "psidd"))

WHEEL_QUANTITIES = (
    dr, delta, rho, r, gamma, cos_gamma, sin_gamma, A, B, ratio, N, shape, cube, patch,
    C11, C22, C23, C33, f11, f22, f23, f33, xi_x, xi_y, xi_s, Kx, Ky, Kz, u2, saturation,
    Fx, Fy, Mz, Fyn, Fx_track, Fy_track, Mz_track,
)  # fmt: skip


def on_side(symbol: sp.Symbol, side: str) -> sp.Symbol:
    """The symbol of a wheel quantity on the left or right wheel: xi_x -> xi_x_left."""
    return _real(f"{symbol.name}_{side}")


def left(symbol: sp.Symbol) -> sp.Symbol:
    """A wheel quantity on the left wheel."""
    return on_side(symbol, "left")


def right(symbol: sp.Symbol) -> sp.Symbol:
    """A wheel quantity on the right wheel."""
    return on_side(symbol, "right")


def for_side(expression: sp.Expr, side: str) -> sp.Expr:
    """A wheel expression on one wheel: s -> +-1 and every wheel quantity -> that wheel's."""
    wheel = {q: on_side(q, side) for q in WHEEL_QUANTITIES}
    return expression.xreplace({**wheel, s: sp.Integer(SIDES[side])})
