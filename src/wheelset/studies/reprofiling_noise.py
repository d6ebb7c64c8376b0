"""A profile measured with noise and smoothed: everything linear, so that a sample is a product.

The smoothing is that of ``profiles.smoothing``, zone by zone and joined, with its weights held
fixed: they are chosen once, by generalised cross validation of a few noisy measurements.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_smoothing_spline

from wheelset.profiles import Profile
from wheelset.profiles.smoothing import JOIN, MARGIN, contour, gcv_weight, zone_ends

Array = NDArray[np.float64]

#: Measurements whose weights the fixed weight of a zone is the median of: of the running surface,
#: and of the others; their seed.
TRIALS, OTHER_TRIALS, TRIAL_SEED = 3, 1, 20210

#: Two derivatives in m of what was computed in mm.
IN_METRES = (1.0, 1e3, 1e6)


@dataclass(frozen=True)
class Measurement:
    """How a profile is measured.

    noise: standard deviation of the heights, white, m; spacing of the points, m; offset [m] and
    tilt [rad]: standard deviations of the profile's alignment, sideways and about the taping point.
    repeats: independent measurements that are averaged.
    """

    noise: float = 5e-6
    spacing: float = 2e-4
    offset: float = 0.0
    tilt: float = 0.0
    repeats: int = 1

    def drawn(self, generator: np.random.Generator, points: int) -> tuple[Array, float, float]:
        """Noise of the points [m], offset [m] and tilt [rad] of an average of the repeats."""
        part = self.repeats**-0.5
        noise = part * self.noise * generator.standard_normal(points)
        offset, tilt = part * np.array([self.offset, self.tilt]) * generator.standard_normal(2)
        return noise, float(offset), float(tilt)


@dataclass(frozen=True, eq=False)
class Smoother:
    """A measured profile at places u (U,) [m] from heights z (n,) [m] of its points.

    operators (3, U, n): z, dz/du and d2z/du2 at the places are products with z. bias (3, U): what
    smoothing alone does to the profile without noise.
    """

    operators: Array
    bias: Array

    @property
    def points(self) -> int:
        """How many points are measured."""
        return int(self.operators.shape[2])

    def deviations(self, noise: Array) -> Array:
        """What is off in z, dz/du, d2z/du2 with noise (samples, n): (3, samples, U)."""
        return self.bias[:, np.newaxis] + noise @ self.operators.transpose(0, 2, 1)


def smoother(profile: Profile, u: Array, measurement: Measurement) -> Smoother:
    """Of a profile measured so, at places u [m] inside its domain.

    The weight of a zone is the median of those that cross validation gives noisy measurements.
    """
    y, z = profile.points(measurement.spacing)
    t = contour(y * 1e3, z * 1e3)
    ends, zones, middle = zone_ends(t, y * 1e3, z * 1e3), [], np.interp(0.0, y, t)
    for low, high in pairwise(ends):
        part = (t >= low - MARGIN) & (t <= high + MARGIN)
        trials = TRIALS if low <= middle <= high else OTHER_TRIALS
        weight = _weight(t[part], z[part] * 1e3, measurement.noise * 1e3, trials)
        zones.append(_zone(t, y * 1e3, part, weight, u * 1e3))
    operators = _joined(zones, np.interp(ends[1:-1], t, y * 1e3), u * 1e3)
    operators *= np.array(IN_METRES)[:, np.newaxis, np.newaxis]
    exact = np.array([profile.curve(u, k) for k in range(3)])
    return Smoother(operators, operators @ z - exact)


def _weight(t: Array, z: Array, noise: float, count: int) -> float:
    """The median weight by cross validation of noisy heights, mm."""
    generator = np.random.default_rng(TRIAL_SEED)
    trials = [z + noise * generator.standard_normal(len(z)) for _ in range(count)]
    return float(np.median([gcv_weight(t, trial) for trial in trials]))


def _zone(t: Array, y: Array, part: NDArray[np.bool_], weight: float, u: Array) -> Array:
    """Operators (3, U, n) of a zone, mm; outside it they mean nothing."""
    across = make_smoothing_spline(t[part], y[part], lam=weight)
    along = np.interp(u, across(t[part]), t[part])
    for _ in range(3):  # Newton's method for y(t) = u
        along = along - (across(along) - u) / across(along, 1)
        along = np.clip(along, t[part][0], t[part][-1])
    basis = make_smoothing_spline(t[part], np.eye(int(part.sum())), lam=weight)
    first, second = across(along, 1)[:, np.newaxis], across(along, 2)[:, np.newaxis]
    slope = basis(along, 1) / first
    values = np.stack([basis(along), slope, (basis(along, 2) - second * slope) / first**2])
    out = np.zeros((3, len(u), len(t)))
    out[:, :, part] = values
    return out


def _joined(zones: list[Array], ends: Array, u: Array) -> Array:
    """Each zone handing over to the next within JOIN of their common end, derivatives included."""
    value = zones[0]
    for at, zone in zip(ends, zones[1:], strict=True):
        s0, s1, s2 = (s[:, np.newaxis] for s in _share((u - at) / (2 * JOIN) + 0.5))
        d0, d1, d2 = zone - value
        moved = (s0 * d0, s0 * d1 + s1 * d0, s0 * d2 + 2 * s1 * d1 + s2 * d0)
        value = value + np.stack(moved)
    return value


def _share(x: Array) -> Iterator[Array]:
    """The step ``x^3 (10 - 15 x + 6 x^2)`` of the part of the way x, and two derivatives by u."""
    x = np.clip(x, 0.0, 1.0)
    yield x**3 * (10 - 15 * x + 6 * x**2)
    yield 30 * (x * (1 - x)) ** 2 / (2 * JOIN)
    yield 60 * x * (1 - x) * (1 - 2 * x) / (2 * JOIN) ** 2


def aligned(profile: Profile, u: Array, offset: float, tilt: float) -> Array:
    """What an alignment does to z, dz/du, d2z/du2 at places u [m]: (3, U)."""
    if offset == tilt == 0.0:
        return np.zeros((3, len(u)))
    moved = np.array([profile.curve(u - offset, k) - profile.curve(u, k) for k in range(3)])
    return moved + tilt * np.array([u, np.ones_like(u), np.zeros_like(u)])
