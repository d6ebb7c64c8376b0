"""A smooth curve through measured points.

Criterion: scipy's smoothing spline over the contour, its weight by generalised cross validation
(GCV) times RELAX, or such that the residual is a stated noise. GCV weighs heights; slopes and
curvatures are best at a few times its weight (measured on the packaged profiles with 5 and 20 um of
noise). A tread of R350 and a flange root of R14 have no weight in common: running surface, flange
and field side are smoothed each with its own and joined over JOIN.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

import numpy as np
from scipy.interpolate import BSpline, make_smoothing_spline
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import brentq

from wheelset.profiles.curves import Array, SplineCurve
from wheelset.profiles.errors import ProfileError

Smoothing = Literal["gcv", "none"] | float

#: Times the weight of GCV.
RELAX = 10.0

#: Slope where the running surface ends, short of flange roots and rail corners of R13 to R15 that
#: would leave their mark on its weight; half of what zones share, and their margins, mm.
STEEP, JOIN, MARGIN = 0.15, 2.0, 2.5

#: The running surface ends here at the latest, mm: the 1:15 of a wheel's field side begins with
#: a kink at 30 mm, which would leave its own mark on the weight.
OUTERMOST = 28.0

#: Fewest points of a zone; spacing of the smooth curve, mm; residual taken as exact, mm.
FEWEST, SPACING, EXACT = 30, 0.05, 1e-6


def smoothed(y: Array, z: Array, how: Smoothing = "gcv") -> tuple[SplineCurve, str]:
    """The curve [m] through points y, z [m], y ascending, and what was done in words.

    how: "gcv"; the standard deviation of the noise [m]; or "none" to pass through the points.
    """
    if how == "none":
        return SplineCurve.through(y, z), "not smoothed: a cubic spline through all points"
    noise = None if how == "gcv" else _checked_noise(how)
    y, z = y * 1e3, z * 1e3
    t = contour(y, z)
    ends = zone_ends(t, y, z)
    zones = [_Zone.fitted(t, y, z, a, b, noise) for a, b in pairwise(ends)]
    curve = _joined(zones, ends, t)
    residual = z - curve(y)
    steep = np.sqrt(1 + curve(y, 1) ** 2)
    rms = float(np.sqrt(np.mean((residual / steep) ** 2))) * 1e3
    kind = "GCV" if noise is None else f"a stated noise of {noise * 1e3:g} um"
    words = f"smoothed by {kind} in {len(zones)} zones; residual {rms:.2f} um rms"
    return _in_metres(curve), words


def _checked_noise(noise: Smoothing) -> float:
    value = float(noise)
    if not 1e-8 <= value <= 1e-3:
        raise ValueError(f"noise = {value:g} m is out of range; it lies between 1e-8 and 1e-3 m")
    return value * 1e3


def contour(y: Array, z: Array) -> Array:
    """Length along the contour, mm, along slightly filtered points so that noise does not add."""
    soft = gaussian_filter1d(z, 3.0, mode="nearest")
    step = np.hypot(np.diff(y), np.diff(soft))
    return np.concatenate([[0.0], np.cumsum(np.maximum(step, 1e-6))])


def zone_ends(t: Array, y: Array, z: Array) -> Array:
    """Contour at the ends of the zones: where the running surface meets flange and field side."""
    grid = np.arange(y[0], y[-1], 0.25)
    slope = np.gradient(gaussian_filter1d(np.interp(grid, y, z), 4.0, mode="nearest"), grid)
    steep = abs(slope) > STEEP
    runs = np.flatnonzero(np.diff(np.concatenate([[True], steep, [True]]).astype(int)))
    lengths = runs[1::2] - runs[::2]
    k = 2 * int(lengths.argmax()) if len(lengths) else 0
    inner = grid[[runs[k], runs[k + 1] - 1]] if len(lengths) else y[[0, -1]]
    inner = np.minimum(inner, OUTERMOST)
    ends = [t[0], *np.interp(inner, y, t), t[-1]]
    kept = [ends[0]]
    for end in ends[1:]:
        enough = np.count_nonzero((t >= kept[-1]) & (t <= end)) >= FEWEST
        if enough:
            kept.append(end)
    kept[-1] = ends[-1]
    return np.array(kept if len(kept) > 1 else [ends[0], ends[-1]])


class _Zone:
    """Smoothing splines y(t), z(t) of one weight over a zone and its margins."""

    def __init__(self, y: BSpline, z: BSpline, low: float, high: float) -> None:
        self.y, self.z, self.low, self.high = y, z, low, high

    @classmethod
    def fitted(
        cls, t: Array, y: Array, z: Array, low: float, high: float, noise: float | None
    ) -> _Zone:
        part = (t >= low - MARGIN) & (t <= high + MARGIN)
        t, y, z = t[part], y[part], z[part]
        if len(t) < 5:
            raise ProfileError(f"{len(t)} points are too few to smooth; give 20 or more")
        weight = gcv_weight(t, z) if noise is None else _noise_weight(t, z, noise)
        fits = [make_smoothing_spline(t, v, lam=weight) for v in (y, z)]
        return cls(fits[0], fits[1], float(t[0]), float(t[-1]))

    def curve(self) -> SplineCurve:
        """z over y in mm."""
        t = np.linspace(self.low, self.high, int((self.high - self.low) / SPACING) + 2)
        y, z = self.y(t), self.z(t)
        graph = np.concatenate([[True], np.diff(np.maximum.accumulate(y)) > 1e-6])
        return SplineCurve.through(y[graph], z[graph])


def _rms(t: Array, z: Array, log_weight: float) -> float:
    fit = make_smoothing_spline(t, z, lam=10.0**log_weight)
    return float(np.sqrt(np.mean((fit(t) - z) ** 2)))


def gcv_weight(t: Array, z: Array) -> float:
    """RELAX times scipy's weight, which it does not tell: that of the same residual."""
    fit = make_smoothing_spline(t, z)
    return RELAX * _weight_of(t, z, float(np.sqrt(np.mean((fit(t) - z) ** 2))))


def _noise_weight(t: Array, z: Array, noise: float) -> float:
    return _weight_of(t, z, noise)


def _weight_of(t: Array, z: Array, residual: float) -> float:
    """The weight whose spline leaves this residual, mm; within what the points allow."""
    low, high = -9.0, 7.0
    if residual <= max(_rms(t, z, low), EXACT):
        return 10.0**low
    if residual >= _rms(t, z, high):
        return 10.0**high
    found = brentq(lambda w: np.log(_rms(t, z, w) / residual), low, high, xtol=0.02)
    return float(10.0**found)


def _joined(zones: list[_Zone], ends: Array, t: Array) -> SplineCurve:
    """One curve of all zones, each handing over to the next within JOIN of their common end."""
    curves = [zone.curve() for zone in zones]
    y = [float(zone.y(end)) for zone, end in zip(zones, ends[1:-1], strict=False)]
    first, last = curves[0].domain[0], curves[-1].domain[1]
    grid = np.linspace(first, last, int((last - first) / SPACING) + 2)
    grid = _denser(grid, curves)
    value = curves[0](np.clip(grid, *curves[0].domain))
    for at, curve in zip(y, curves[1:], strict=True):
        x = np.clip((grid - at) / (2 * JOIN) + 0.5, 0.0, 1.0)
        share = x**3 * (10 - 15 * x + 6 * x**2)
        value = (1 - share) * value + share * curve(np.clip(grid, *curve.domain))
    return SplineCurve.through(grid, value)


def _denser(grid: Array, curves: list[SplineCurve]) -> Array:
    """The grid with the spacing kept along the contour where the curve is steep."""
    slope = np.zeros_like(grid)
    for curve in curves:
        inside = (grid >= curve.domain[0]) & (grid <= curve.domain[1])
        slope[inside] = np.maximum(slope[inside], abs(curve(grid[inside], 1)))
    length = np.concatenate([[0], np.cumsum(np.diff(grid) * np.sqrt(1 + slope[1:] ** 2))])
    even = np.linspace(0.0, length[-1], int(length[-1] / SPACING) + 2)
    return np.interp(even, length, grid)


def _in_metres(curve: SplineCurve) -> SplineCurve:
    s = curve.spline
    return SplineCurve(BSpline(s.t * 1e-3, s.c * 1e-3, s.k))
