"""Functions of the lateral displacement with known Taylor coefficients, fitted to points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BSpline, make_interp_spline, make_lsq_spline

from wheelset.profiles.curves import Array

#: Degree of the splines: the model's normal forms need five derivatives.
DEGREE = 5

#: A Gaussian average: points in a standard deviation, standard deviations on either side, and
#: points from knot to knot of the spline through it.
PER_WIDTH, WINGS, KNOT = 20, 6, 5

#: Numbers of intervals tried for a spline.
INTERVALS = (2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32)


class Function(Protocol):
    """f(y) with its Taylor coefficients."""

    def taylor(self, y: ArrayLike, order: int) -> Array:
        """f^(j)(y)/j!, j = 0..order, shape ``y.shape + (order + 1,)``."""
        ...


@dataclass(frozen=True)
class Polynomial:
    """``sum c_k y^k``; coefficients by ascending powers, SI units."""

    coefficients: tuple[float, ...]

    def taylor(self, y: ArrayLike, order: int) -> Array:
        """f^(j)(y)/j!."""
        f = np.polynomial.Polynomial(self.coefficients)
        y = np.asarray(y, float)
        return np.stack([f.deriv(j)(y) / math.factorial(j) for j in range(order + 1)], axis=-1)


@dataclass(frozen=True)
class SineSeries:
    """``sum_k a_k cos(k q y) + b_k sin(k q y)``, k = 0, 1, ...; q in rad/m."""

    q: float
    a: tuple[float, ...]
    b: tuple[float, ...]

    def taylor(self, y: ArrayLike, order: int) -> Array:
        """f^(j)(y)/j!: every derivative turns the phase by a quarter."""
        w = self.q * np.arange(len(self.a))
        phase = np.asarray(y, float)[..., None] * w
        terms = []
        for j in range(order + 1):
            turned = phase + j * np.pi / 2
            wave = np.cos(turned) * self.a + np.sin(turned) * self.b
            terms.append((wave * w**j).sum(-1) / math.factorial(j))
        return np.stack(terms, axis=-1)


@dataclass(frozen=True, eq=False)
class Spline:
    """A spline of degree 5 on [-reach, reach], continued beyond by its tangents."""

    spline: BSpline
    reach: float

    @property
    def intervals(self) -> int:
        """Number of polynomial pieces."""
        return len(np.unique(self.spline.t)) - 1

    def taylor(self, y: ArrayLike, order: int) -> Array:
        """f^(j)(y)/j!."""
        y = np.asarray(y, float)
        inside = np.clip(y, -self.reach, self.reach)
        beyond = y - inside
        terms = [
            self.spline(inside, nu=j) / math.factorial(j) for j in range(min(order, DEGREE) + 1)
        ]
        terms += [np.zeros_like(y)] * (order - DEGREE)
        if order:
            terms[0] = terms[0] + beyond * terms[1]
        elif np.any(beyond):
            terms[0] = terms[0] + beyond * self.spline(inside, nu=1)
        kept = np.arange(order + 1) < 2
        return np.where((beyond == 0)[..., None] | kept, np.stack(terms, axis=-1), 0.0)


def fit_polynomial(y: Array, values: Array, degree: int) -> Polynomial:
    """Least squares."""
    scale = float(abs(y).max())
    c = np.polynomial.polynomial.polyfit(y / scale, values, degree)
    return Polynomial(tuple(float(ck / scale**k) for k, ck in enumerate(c)))


def fit_sines(y: Array, values: Array, terms: int) -> SineSeries:
    """Least squares; the longest wave is four times the reach, so that ends need not meet."""
    q = float(np.pi / 2 / abs(y).max())
    k = np.arange(terms + 1)
    columns = np.hstack([np.cos(q * y[:, None] * k), np.sin(q * y[:, None] * k[1:])])
    c, *_ = np.linalg.lstsq(columns, values, rcond=None)
    return SineSeries(q, tuple(c[: terms + 1].tolist()), (0.0, *c[terms + 1 :].tolist()))


def fit_spline(y: Array, values: Array, tolerance: float | None = None) -> Spline:
    """Least squares on equal intervals of [-reach, reach].

    Their number minimises the generalised cross validation ``n RSS / (n - p)^2``, or is the
    smallest whose largest error is below ``tolerance``, if one reaches it.
    """
    reach = float(abs(y).max())
    allowed = [n for n in INTERVALS if n + DEGREE < len(y) / 3]
    fits = [_lsq(y, values, reach, n) for n in allowed]
    errors = [values - fit(y) for fit in fits]
    if tolerance is not None:
        good = [k for k, error in enumerate(errors) if abs(error).max() <= tolerance]
        return Spline(fits[good[0] if good else -1], reach)
    left = len(y) - np.array(allowed) - DEGREE
    score = np.array([np.sum(error**2) for error in errors]) / left**2
    return Spline(fits[int(score.argmin())], reach)


def smooth_spline(y: Array, values: Array, reach: float, width: float) -> Spline:
    """A spline through the values averaged with a Gaussian of standard deviation ``width`` [m].

    An average does not swing beside a kink or a jump, as a least squares spline does, and keeps
    straight lines as they are. The values may cover more than [-reach, reach]; beyond their ends
    they are continued by the last straight piece.
    """
    fine = width / PER_WIDTH
    count = int(np.ceil(reach / (KNOT * fine)))
    fine = reach / (KNOT * count)
    wing = int(np.ceil(WINGS * width / fine))
    half = KNOT * count + wing
    grid = np.linspace(-half * fine, half * fine, 2 * half + 1)
    kernel = np.exp(-0.5 * (np.arange(-wing, wing + 1) * fine / width) ** 2)
    averaged = np.convolve(_continued(grid, y, values), kernel / kernel.sum(), "valid")
    knots = grid[wing : len(grid) - wing]
    return Spline(make_interp_spline(knots[::KNOT], averaged[::KNOT], k=DEGREE), reach)


def _continued(grid: Array, y: Array, values: Array) -> Array:
    """Linear interpolation, and extrapolation by the last straight pieces."""
    inside = np.interp(grid, y, values)
    first = (values[1] - values[0]) / (y[1] - y[0]) * np.minimum(grid - y[0], 0.0)
    last = (values[-1] - values[-2]) / (y[-1] - y[-2]) * np.maximum(grid - y[-1], 0.0)
    return inside + first + last


def _lsq(y: Array, values: Array, reach: float, intervals: int) -> BSpline:
    inner = np.linspace(-reach, reach, intervals + 1)
    knots: NDArray[np.float64] = np.concatenate([[-reach] * DEGREE, inner, [reach] * DEGREE])
    return make_lsq_spline(y, values, knots, k=DEGREE)
