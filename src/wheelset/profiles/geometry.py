"""Contact geometry as functions of y, for the equations of motion.

Each class gives ``functions``: six functions with Taylor coefficients by the names "dr_left",
"delta_left", "rho_left", "dr_right", ... dr [m] is measured from the mean rolling radius of the
centred wheelset, delta in rad, rho in 1/m. All are fitted over [-reach, reach] at the displacements
that were asked for; a jump in there is smoothed over like the rest, and ``jumps`` names it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from wheelset.profiles.contact import Contact
from wheelset.profiles.curves import Array
from wheelset.profiles.functions import (
    Function,
    Polynomial,
    fit_polynomial,
    fit_sines,
    fit_spline,
    smooth_spline,
)
from wheelset.profiles.jumps import Jump
from wheelset.profiles.search import SIDES

QUANTITIES = ("dr", "delta", "rho")

#: Half the range over which geometries are fitted, m, and the width of a spline's average, m.
REACH, WIDTH = 0.006, 5e-4


@dataclass(frozen=True)
class FitError:
    """How far a function is from the contacts: root mean square and largest, at y [m]."""

    rms: float
    largest: float
    y: float


@dataclass(frozen=True, eq=False)
class FittedGeometry:
    """Six functions of y, their errors by the same names, and the jumps they smooth over."""

    functions: Mapping[str, Function]
    errors: Mapping[str, FitError]
    reach: float
    jumps: tuple[Jump, ...]


class SplineGeometry(FittedGeometry):
    """Splines of degree 5."""

    @classmethod
    def of(cls, contact: Contact, reach: float = REACH, width: float = WIDTH) -> SplineGeometry:
        """Through contacts averaged over the displacement with a Gaussian of this width [m].

        The width is the criterion: what is narrower, the kinks at joints of arcs among it, is
        averaged out; all derivatives are those of the average.
        """
        if not 5e-5 <= width <= 5e-3:
            raise ValueError(f"width = {width:g} m is out of range; it lies between 5e-5 and 5e-3")
        y, values = contact_functions(contact)
        return cls(*_fitted(contact, reach, lambda n: smooth_spline(y, values[n], reach, width)))

    @classmethod
    def by_validation(
        cls,
        contact: Contact,
        reach: float = REACH,
        tolerances: Mapping[str, float] | None = None,
    ) -> SplineGeometry:
        """Least squares by generalised cross validation, or to largest errors by quantity.

        Closer to smooth contacts; beside kinks and jumps it swings.
        """
        allowed = tolerances or {}
        y, values = _within(contact, reach)
        return cls(
            *_fitted(
                contact, reach, lambda n: fit_spline(y, values[n], allowed.get(n.split("_")[0]))
            )
        )


class PolynomialFit(FittedGeometry):
    """Polynomials, Eqs. (1)-(4) of the paper at degree 3."""

    @classmethod
    def of(cls, contact: Contact, reach: float = REACH, degree: int = 3) -> PolynomialFit:
        """Least squares of a degree."""
        if not 1 <= degree <= 15:
            raise ValueError(f"degree = {degree} is out of range; it lies between 1 and 15")
        y, values = _within(contact, reach)
        return cls(*_fitted(contact, reach, lambda n: fit_polynomial(y, values[n], degree)))

    def coefficients(self, quantity: str) -> tuple[Array, Array]:
        """Those alike on both wheels, and half the differences, by ascending powers.

        The left function is ``sum (c_k + d_k) y^k``, the right one ``sum (c_k - d_k) (-y)^k``:
        for dr c1 is the paper's a1, for delta c0..c3 are its own.
        """
        left, right = (self._of(quantity, side) for side in SIDES)
        mirrored = right * (-1.0) ** np.arange(len(right))
        return 0.5 * (left + mirrored), 0.5 * (left - mirrored)

    def _of(self, quantity: str, side: str) -> Array:
        function = self.functions[f"{quantity}_{side}"]
        assert isinstance(function, Polynomial)
        return np.array(function.coefficients)


class SineFit(FittedGeometry):
    """Sines and cosines, the paper's suggestion for worn profiles."""

    @classmethod
    def of(cls, contact: Contact, reach: float = REACH, terms: int = 4) -> SineFit:
        """Least squares with so many harmonics of a wave of four times the reach."""
        if not 1 <= terms <= 30:
            raise ValueError(f"terms = {terms} is out of range; it lies between 1 and 30")
        y, values = _within(contact, reach)
        return cls(*_fitted(contact, reach, lambda n: fit_sines(y, values[n], terms)))


def contact_functions(contact: Contact) -> tuple[Array, dict[str, Array]]:
    """The displacements asked for [m], and dr, delta, rho of both wheels there by name."""
    part = contact.asked
    nominal = 0.5 * sum(
        float(np.interp(0.0, contact.y, getattr(contact, side).r)) for side in SIDES
    )
    values = {}
    for side in SIDES:
        wheel = getattr(contact, side)
        values[f"dr_{side}"] = wheel.r[part] - nominal
        values[f"delta_{side}"] = wheel.delta[part]
        values[f"rho_{side}"] = wheel.rho[part]
    return contact.y[part], values


def _within(contact: Contact, reach: float) -> tuple[Array, dict[str, Array]]:
    """Those within reach."""
    y, values = contact_functions(contact)
    part = abs(y) <= reach + 1e-12
    return y[part], {name: f[part] for name, f in values.items()}


def _fitted(
    contact: Contact, reach: float, fit: Callable[[str], Function]
) -> tuple[dict[str, Function], dict[str, FitError], float, tuple[Jump, ...]]:
    """Functions by name, their errors within reach; ValueError beyond the contacts."""
    first, last = float(contact.y[0]), float(contact.y[-1])
    if not 5e-4 <= reach <= min(-first, last) + 1e-12:
        raise ValueError(
            f"reach = {reach:g} m is out of range; it lies between 0.0005 m and what the contacts "
            f"cover, {min(-first, last):g} m"
        )
    y, values = _within(contact, reach)
    functions = {name: fit(name) for name in values}
    errors = {name: _error(y, f, functions[name]) for name, f in values.items()}
    inside = tuple(jump for jump in contact.jumps if abs(jump.y) <= reach)
    return functions, errors, reach, inside


def _error(y: Array, values: Array, function: Function) -> FitError:
    off = abs(function.taylor(y, 0)[..., 0] - values)
    worst = int(off.argmax())
    return FitError(float(np.sqrt(np.mean(off**2))), float(off[worst]), float(y[worst]))
