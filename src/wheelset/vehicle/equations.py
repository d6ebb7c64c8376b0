"""The equations of motion, Eqs. (1)-(21) of Guo et al. (2021), written down once.

A *wheel equation* is written for a wheel of side s and holds for the left (s = +1) and the right
one (s = -1); ``EquationsOfMotion`` keeps both the general form, which the book prints, and the
assignments of the two wheels, which are computed. Axes: x forward, y to the left, z up.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from wheelset.vehicle.contact import LEAST_SATURATION, wheel_equations
from wheelset.vehicle.flange import FLANGE_LAWS, FlangeLaw
from wheelset.vehicle.geometry import QUANTITIES, SIDES, ContactGeometry, PolynomialGeometry
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.quantities import (
    Equation,
    Ft,
    Fx_track,
    Fy_track,
    Fyc,
    Fyn,
    Mz_track,
    Mzc,
    cos_gamma,
    delta,
    dr,
    for_side,
    left,
    on_side,
    phi,
    psidd,
    r,
    rho,
    right,
    u2,
    ydd,
)
from wheelset.vehicle.symbols import p, psi, psid, reach, s, v, y, yd

#: cos(delta + s phi) has to exceed this: beyond it tan and 1/cos in Eqs. (7), (8) blow up.
LEAST_COSINE = 1e-3


@dataclass(frozen=True)
class Requirement:
    """``symbol > least`` is needed by derivatives of ``order`` and above (0: by f itself)."""

    symbol: sp.Symbol
    quantity: str
    where: str
    unit: str
    least: float = 0.0
    order: int = 0


@dataclass(frozen=True)
class EquationsOfMotion:
    """geometry, roll, wheel, body: equations in the order they are evaluated, wheel equations in
    their general form. assignments: the same, both wheels written out. derivative: of the state
    (y, psi, yd, psid). requirements: the domain. law: the flange law in use.
    """

    geometry: tuple[Equation, ...]
    roll: Equation
    wheel: tuple[Equation, ...]
    body: tuple[Equation, ...]
    assignments: tuple[tuple[sp.Symbol, sp.Expr], ...]
    derivative: tuple[sp.Expr, ...]
    requirements: tuple[Requirement, ...]
    law: FlangeLaw


def equations_of_motion(
    options: ModelOptions, contact: ContactGeometry | None = None
) -> EquationsOfMotion:
    """The model for the given structural options and contact geometry (default: polynomials)."""
    contact = contact or PolynomialGeometry()
    law = FLANGE_LAWS[options.flange_law]
    roll = Equation(phi, (left(dr) - right(dr)) / (2 * p.b), "7", "rad", "roll angle")
    wheel = wheel_equations(options)
    body = _body_equations(options, law)
    assignments = (
        *(
            (on_side(symbol, side), contact.expression(q, side))
            for side in SIDES
            for q, symbol in zip(QUANTITIES, (dr, delta, rho), strict=True)
        ),
        (roll.symbol, roll.expression),
        *_on_both_wheels(wheel),
        *((e.symbol, e.expression) for e in body),
        *((_bound_symbol(i), b.expression) for i, b in enumerate(law.bounds)),
        *(_within_reach() if contact.reach is not None else ()),
    )
    derivative = (yd, psid, ydd, psidd)
    return EquationsOfMotion(
        _geometry_equations(),
        roll,
        wheel,
        body,
        assignments,
        derivative,
        (*_requirements(options, law), *(_reach_requirements() if contact.reach else ())),
        law,
    )


def _geometry_equations() -> tuple[Equation, ...]:
    """Eqs. (1)-(4) as the polynomial geometry has them, for a wheel of side s."""

    def cubic(c: tuple[sp.Expr, ...]) -> sp.Expr:
        return sp.Add(*(ck * (s if k % 2 else 1) * y**k for k, ck in enumerate(c)))

    h = [getattr(p, f"e{k}") + getattr(p, f"f{k}") for k in range(4)]
    return (
        Equation(dr, cubic((sp.Integer(0), p.a1, p.a2, p.a3)), "1", "m", "rolling radius less r0"),
        Equation(delta, cubic((p.c0, p.c1, p.c2, p.c3)), "2", "rad", "contact angle"),
        Equation(rho, cubic(tuple(h)), "3, 4", "1/m", "sum of curvatures"),
    )


def _body_equations(options: ModelOptions, law: FlangeLaw) -> tuple[Equation, ...]:
    """Eqs. (15)-(19) and the flange force, solved for the accelerations."""

    def over_wheels(expression: sp.Expr) -> sp.Expr:
        return sp.Add(*(for_side(expression, side) for side in SIDES))

    lateral = Fy_track + Fyn
    yaw = -s * p.b * Fx_track - s * p.b * psi * lateral + Mz_track
    suspension_y = -2 * p.Kpy * y - 2 * p.Cpy * yd
    suspension_psi = -2 * p.wp**2 * (p.Kpx * psi + p.Cpx * psid)
    return (
        Equation(Fyc, over_wheels(lateral), "15", "N", "lateral force of contact"),
        Equation(Mzc, over_wheels(yaw), "15", "N m", "yaw moment of contact"),
        Equation(Ft, options.flange_wheels * law.force, law.equation, "N", "flange force"),
        Equation(ydd, (suspension_y + Fyc + Ft) / p.mw, "16", "m/s2", "lateral acceleration"),
        Equation(psidd, (suspension_psi + Mzc) / p.Iwz, "17", "1/s2", "yaw acceleration"),
    )


def _on_both_wheels(wheel: tuple[Equation, ...]) -> tuple[tuple[sp.Symbol, sp.Expr], ...]:
    return tuple(
        (on_side(e.symbol, side), for_side(e.expression, side)) for side in SIDES for e in wheel
    )


def _requirements(options: ModelOptions, law: FlangeLaw) -> tuple[Requirement, ...]:
    wheels = tuple(req for side in SIDES for req in _wheel_requirements(options, side))
    bounds = tuple(
        Requirement(_bound_symbol(i), b.quantity, "flange", b.unit)
        for i, b in enumerate(law.bounds)
    )
    return (Requirement(v, "speed v", "", "m/s"), *wheels, *bounds)


def _wheel_requirements(options: ModelOptions, side: str) -> tuple[Requirement, ...]:
    where = f"{side} wheel"
    smooth = Requirement(
        on_side(u2, side),
        "squared saturation (F / mu N)^2, whose root is not smooth at zero",
        where,
        "1",
        LEAST_SATURATION,
        order=2,
    )
    return (
        Requirement(on_side(r, side), "rolling radius (A of Eq. 5)", where, "m"),
        Requirement(on_side(rho, side), "sum of curvatures (B of Eq. 5)", where, "1/m"),
        Requirement(
            on_side(cos_gamma, side),
            "cosine of the contact slope delta + s phi",
            where,
            "1",
            LEAST_COSINE,
        ),
        *((smooth,) if options.creep_law == "shen_hedrick_elkins" else ()),
    )


def _within_reach() -> tuple[tuple[sp.Symbol, sp.Expr], ...]:
    """What is left of the displacements with known contacts, on either side."""
    return tuple((_room_symbol(side), reach - SIDES[side] * y) for side in SIDES)


def _reach_requirements() -> tuple[Requirement, ...]:
    words = "distance to the last displacement with a known contact"
    return tuple(Requirement(_room_symbol(side), words, f"to the {side}", "m") for side in SIDES)


def _room_symbol(side: str) -> sp.Symbol:
    return sp.Symbol(f"contact_room_{side}", real=True)


def _bound_symbol(i: int) -> sp.Symbol:
    return sp.Symbol(f"flange_bound_{i}", real=True)
