"""The five flange laws, Eqs. (24)-(27) of Guo et al. (2021), as symbolic expressions.

Each is the lateral force Ft(y) [N] on the wheelset at displacement y [m] (positive to the left).
To add a law: write one class with its equation and append it to ``FLANGE_LAWS``; the tests over
the registry then apply to it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from wheelset.vehicle.symbols import p, y

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Bound:
    """``symbol expression > 0`` for the law to be defined; ``quantity`` names it in messages."""

    quantity: str
    expression: sp.Expr
    unit: str


@dataclass(frozen=True)
class FlangeLaw:
    """A flange law.

    name, title: as options and as words. equation: number in the paper, "" for none.
    force: Ft in N as an expression in y, the parameters and, for a piecewise law, ``region``.
    parameters: names of its coefficients. bounds: its domain.
    thresholds, regions: corners in y (increasing) and the value of ``region`` between them.
    restoring_from: displacement [m] as an expression beyond which the force has to restore.
    """

    name: str
    title: str
    equation: str
    force: sp.Expr
    parameters: tuple[str, ...] = ()
    bounds: tuple[Bound, ...] = ()
    thresholds: tuple[sp.Expr, ...] = ()
    regions: tuple[float, ...] = ()
    restoring_from: sp.Expr = field(default_factory=lambda: p.eta)

    def __str__(self) -> str:
        return self.name

    @property
    def smooth(self) -> bool:
        """Whether the force is smooth in y."""
        return not self.thresholds


#: Which side the flange touches: -1, 0 (between the flanges) or +1, for the piecewise law.
region = sp.Symbol("flange_region", real=True)

NONE = FlangeLaw("none", "no flange", "", sp.Integer(0))

# Ft = -k0 (y - eta) beyond +eta, -k0 (y + eta) beyond -eta, 0 between: region^2 switches it on.
PIECEWISE_LINEAR = FlangeLaw(
    "piecewise_linear",
    "piecewise linear",
    "24",
    -(region**2) * p.k0 * (y - region * p.eta),
    ("k0", "eta"),
    thresholds=(-p.eta, p.eta),
    regions=(-1.0, 0.0, 1.0),
)

# The cubic term pushes outward: the force restores only beyond sqrt(d1/d2), as the paper says.
QUINTIC = FlangeLaw(
    "quintic",
    "quintic polynomial",
    "25",
    p.d1 * y**3 - p.d2 * y**5,
    ("d1", "d2"),
    restoring_from=sp.sqrt(p.d1 / p.d2),
)

# With the printed p1 > 0 and q1 < 0 the force opposes y.
EXPONENTIAL = FlangeLaw(
    "exponential",
    "exponential",
    "26",
    p.p1 * sp.exp(p.q1 * y) - p.p1 * sp.exp(-p.q1 * y),
    ("p1", "q1"),
)

# With the printed p2 < 0 the force opposes y; poles at y = +-q2.
RECIPROCAL = FlangeLaw(
    "reciprocal",
    "reciprocal",
    "27",
    p.p2 / (p.q2 - y) - p.p2 / (p.q2 + y),
    ("p2", "q2"),
    bounds=(
        Bound("distance to the pole of the reciprocal flange law at y = q2", p.q2 - y, "m"),
        Bound("distance to the pole of the reciprocal flange law at y = -q2", p.q2 + y, "m"),
    ),
)

FLANGE_LAWS: dict[str, FlangeLaw] = {
    law.name: law for law in (NONE, PIECEWISE_LINEAR, QUINTIC, EXPONENTIAL, RECIPROCAL)
}


def flange_force(law: FlangeLaw, y_values: ArrayLike, values: Mapping[str, float]) -> Array:
    """Ft in N on one wheel at displacements [m] of any shape, inside the law's domain.

    values: the law's coefficients, SI. Outside the domain (the poles of the reciprocal law) the
    formula still gives numbers; ``law.bounds`` says where it holds.
    """
    expression = law.force
    if not law.smooth:
        low, high = law.thresholds
        below, between, above = (expression.subs(region, side) for side in law.regions)
        expression = sp.Piecewise((below, y < low), (above, y > high), (between, True))
    function = sp.lambdify([y, *(getattr(p, name) for name in law.parameters)], expression)
    force = function(np.asarray(y_values, dtype=float), *(values[name] for name in law.parameters))
    return np.broadcast_to(np.asarray(force, dtype=float), np.shape(y_values))
