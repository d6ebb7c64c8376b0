"""Contact geometry: how radius, contact angle and curvature change as the wheelset moves sideways.

A geometry gives three functions of y for each wheel: ``dr`` = r - r0 [m], the contact angle
``delta`` [rad] and the sum of lateral curvatures of wheel and rail ``rho`` [1/m]. It gives them
either as expressions in y and parameters (the polynomials of Eqs. (1)-(4)) or as anything that can
be expanded in a Taylor series at any y (a sine, a spline through a measured profile): the chain
rule is the model's, so both go through the same Hopf points, cycles and normal forms.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from wheelset.vehicle.symbols import p, y

Array = NDArray[np.float64]

SIDES = {"left": +1, "right": -1}
QUANTITIES = ("dr", "delta", "rho")


class Expandable(Protocol):
    """A function of y [m] with known Taylor coefficients."""

    def taylor(self, y: Array, order: int) -> Array:
        """f^(j)(y)/j!, j = 0..order, shape ``y.shape + (order + 1,)``."""
        ...


class ContactGeometry(Protocol):
    """What the model needs of a pair of wheels on a pair of rails."""

    def expression(self, quantity: str, side: str) -> sp.Expr:
        """``dr`` [m], ``delta`` [rad] or ``rho`` [1/m] of the "left" or "right" wheel, in y."""
        ...

    @property
    def functions(self) -> Mapping[str, Expandable]:
        """Functions the expressions leave to be expanded numerically, by name."""
        ...

    @property
    def reach(self) -> float | None:
        """The |y| [m] that motions must stay below; None: no such end."""
        ...


@dataclass(frozen=True)
class PolynomialGeometry:
    """Eqs. (1)-(4): cubic polynomials, left and right wheel allowed to differ.

    With s = +1 left, -1 right, and the mirror image y -> s y of one wheel on the other,
    ``dr_s = a1 (s y) + a2 (s y)^2 + a3 (s y)^3`` plus s times the same polynomial in the half
    differences da0..da3; likewise delta (c, dc) and rho (e + f, dh). The even terms alike on both
    wheels keep the model odd; only the differences break its mirror symmetry.
    """

    functions: Mapping[str, Expandable] = field(default_factory=dict)
    reach: None = None

    def expression(self, quantity: str, side: str) -> sp.Expr:
        """Polynomial in y of a quantity on a side."""
        s = SIDES[side]
        common, difference = _COEFFICIENTS[quantity]
        return sp.Add(
            *(
                (c + s * d) * (s * y) ** k
                for k, (c, d) in enumerate(zip(common, difference, strict=True))
            )
        )


_COEFFICIENTS: dict[str, tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]] = {
    "dr": ((sp.Integer(0), p.a1, p.a2, p.a3), (p.da0, p.da1, p.da2, p.da3)),
    "delta": ((p.c0, p.c1, p.c2, p.c3), (p.dc0, p.dc1, p.dc2, p.dc3)),
    "rho": (
        (p.e0 + p.f0, p.e1 + p.f1, p.e2 + p.f2, p.e3 + p.f3),
        (p.dh0, p.dh1, p.dh2, p.dh3),
    ),
}


@dataclass(frozen=True)
class ExpandedGeometry:
    """A geometry given by six functions that can be expanded at any y, e.g. splines.

    functions: keys "dr_left", "delta_left", "rho_left", "dr_right", ...; dr in m, delta in rad,
    rho in 1/m. reach: the |y| [m] up to which they are known; motions that come there leave the
    domain of the model. ``mirrored`` makes the right wheel from the left one.
    """

    functions: Mapping[str, Expandable]
    reach: float | None = None

    def __post_init__(self) -> None:
        if self.reach is not None and not 0 < self.reach < math.inf:
            raise ValueError(f"reach = {self.reach:g} m is out of range; it is above 0, or None")
        missing = {f"{q}_{side}" for q in QUANTITIES for side in SIDES} - set(self.functions)
        if missing:
            raise ValueError(
                f"contact geometry lacks {', '.join(sorted(missing))}; give all six functions "
                "or use ExpandedGeometry.mirrored(dr, delta, rho)"
            )

    @classmethod
    def mirrored(
        cls, dr: Expandable, delta: Expandable, rho: Expandable, reach: float | None = None
    ) -> ExpandedGeometry:
        """Both wheels alike: the right one is the left one's mirror image, f_right(y) = f(-y)."""
        left = {"dr_left": dr, "delta_left": delta, "rho_left": rho}
        right = {name.replace("left", "right"): Mirrored(f) for name, f in left.items()}
        return cls({**left, **right}, reach)

    def expression(self, quantity: str, side: str) -> sp.Expr:
        """An undefined function of y, expanded numerically."""
        return sp.Function(f"{quantity}_{side}", real=True)(y)


@dataclass(frozen=True)
class Mirrored:
    """y -> f(-y)."""

    f: Expandable

    def taylor(self, y: Array, order: int) -> Array:
        """Odd coefficients change sign."""
        return self.f.taylor(-np.asarray(y), order) * (-1.0) ** np.arange(order + 1)
