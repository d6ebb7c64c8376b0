"""Normal contact in strips along the rolling direction, by virtual interpenetration.

Piotrowski & Kik, Vehicle System Dynamics 46 (2008) 27-48. The gap g of the touching profiles is
cut at ``delta_0 = 0.55 delta`` (delta: approach of the bodies). A strip at g < delta_0 reaches
``a = sqrt(2 R (delta_0 - g))`` before and behind, R the rolling radius. The pressure is elliptic
along it, ``p = c sqrt(a^2 - x^2)``, with one c for the patch, from the deflection at the contact:

    delta = 2 (1 - nu^2)/(pi E) int p / sqrt(x^2 + t^2) dA,    N = int p dA

t: lateral distance from the contact. A wide, a conformal and a divided patch need no other rule.
Known error, on Hertzian contacts with A/B from 1/5 to 5: the area is 7 to 11 % too large, the
largest pressure 6 to 10 % and the approach 2 to 3 % too low; the axis ratio is sqrt(A/B).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipe, ellipk

from wheelset.wear.errors import PatchNotFound

Array = NDArray[np.float64]
Index = NDArray[np.intp]

#: Steel: Young's modulus, Pa, and Poisson's ratio.
E, NU = 2.1e11, 0.28

#: Share of the approach to which the profiles are cut.
CUT = 0.55

#: Strips whose gap is larger than this cannot touch, m.
REACH = 3e-4

#: Relative accuracy of the load, most iterations, and the power of Hertz's law N ~ delta^1.5.
ACCURACY, MOST, HERTZ = 1e-12, 80, 1.5


@dataclass(frozen=True, eq=False)
class Patches:
    """Loaded strips of all patches in one list, by patch.

    row: the patch a strip belongs to; column: its place among the strips given. a: half length, m.
    width: m. scale: c of its patch, Pa/m. delta: approach of every patch, m.
    """

    row: Index
    column: Index
    a: Array
    width: Array
    scale: Array
    delta: Array

    @property
    def load(self) -> Array:
        """Force carried by every patch, N."""
        return self.sums(0.5 * np.pi * self.scale * self.a**2 * self.width)

    @property
    def area(self) -> Array:
        """Area of every patch, m2."""
        return self.sums(2 * self.a * self.width)

    @property
    def length(self) -> Array:
        """Longest half length of every patch, m."""
        longest = np.zeros(len(self.delta))
        np.maximum.at(longest, self.row, self.a)
        return longest

    def sums(self, values: Array) -> Array:
        """Values of strips added up by patch."""
        return np.bincount(self.row, values, len(self.delta)).astype(float)


def find_patches(gap: Array, t: Array, width: Array, radius: ArrayLike, load: ArrayLike) -> Patches:
    """The patches under ``load`` [N], shape (patches,), of profiles with a gap [m].

    gap, t: (patches, strips), normal to the contact and lateral distance from it, m; width: of the
    strips, (strips,) m; radius: rolling radius, m. Raises PatchNotFound.
    """
    gap = np.asarray(gap, float)
    load = np.broadcast_to(np.asarray(load, float), gap.shape[:1])
    radius = np.broadcast_to(np.asarray(radius, float), gap.shape[:1])
    row, column = np.nonzero(gap < REACH)
    near = gap[row, column], _mean_distance(t[row, column], width[column]), width[column]
    strips = _Strips(row, *near, radius)
    delta = _approach(strips, load)
    a = strips.half_lengths(delta)
    touching = a > 0
    row, column, a = row[touching], column[touching], a[touching]
    carried = np.bincount(row, 0.5 * np.pi * a**2 * width[column], minlength=len(load))
    return Patches(row, column, a, width[column], (load / carried)[row], delta)


def _mean_distance(t: Array, width: Array) -> Array:
    """Geometric mean of the distance from the contact over a strip: there the integrand is
    logarithmic, and a strip's middle may be the contact itself.
    """
    low, high = t - 0.5 * width, t + 0.5 * width
    mean = (_x_log_x(high) - _x_log_x(low)) / width - 1
    return np.exp(mean)


def _x_log_x(x: Array) -> Array:
    size = np.maximum(abs(x), 1e-300)
    return x * np.log(size)


@dataclass(frozen=True, eq=False)
class _Strips:
    """Strips that may touch; t: distance from the contact, radius: of every patch, m."""

    row: Index
    gap: Array
    t: Array
    width: Array
    radius: Array

    def half_lengths(self, delta: Array) -> Array:
        cut = np.maximum(CUT * delta[self.row] - self.gap, 0.0)
        return np.sqrt(2 * self.radius[self.row] * cut)

    def load(self, delta: Array) -> Array:
        """N = delta pi E / (2 (1 - nu^2)) int sqrt(a^2 - x^2) / int sqrt(..)/sqrt(x^2 + t^2)."""
        a = self.half_lengths(delta)
        on = a > 0
        row, a, t, width = self.row[on], a[on], self.t[on], self.width[on]
        forces = np.bincount(row, 0.5 * np.pi * a**2 * width, minlength=len(delta))
        far = np.hypot(a, t)
        m = (a / far) ** 2
        sinks = np.bincount(row, 2 * far * (ellipk(m) - ellipe(m)) * width, minlength=len(delta))
        return np.pi * E / (2 * (1 - NU**2)) * delta * forces / np.where(sinks > 0, sinks, np.inf)


def _approach(strips: _Strips, load: Array) -> Array:
    """The approach of every patch by secants of log N over log delta inside a bracket."""
    low, high = np.full(len(load), 1e-9), np.full(len(load), REACH / CUT)
    guess = np.full(len(load), 1e-4)
    slope, before = np.full(len(load), HERTZ), None
    for _ in range(MOST):
        miss = _miss(strips, guess, load)
        if np.all(abs(miss) < ACCURACY):
            return guess
        low, high = np.where(miss < 0, guess, low), np.where(miss > 0, guess, high)
        if before is not None:
            slope = _slope(guess, miss, *before, slope)
        before = guess, miss
        step = guess * np.exp(-miss / slope)
        guess = np.where((step > low) & (step < high), step, np.sqrt(low * high))
    worst = int(abs(miss).argmax())
    raise PatchNotFound(float(load[worst]), float(guess[worst]))


def _miss(strips: _Strips, delta: Array, load: Array) -> Array:
    """log of carried over wanted load; very negative where nothing is carried yet."""
    return np.log(np.maximum(strips.load(delta) / load, 1e-30))


def _slope(x: Array, f: Array, x0: Array, f0: Array, slope: Array) -> Array:
    """Slope of the secant; the last one where the two points have become one."""
    run = np.log(x / x0)
    moved = abs(run) > 1e-14
    secant = (f - f0) / np.where(moved, run, 1.0)
    return np.where(moved & (secant > 0.3) & (secant < 30), secant, slope)
