"""The kinematic motion ``y'' = -dr(y) / (e r0)`` over the distance run (Klingel; EN 15302).

Between two displacements dr is a straight line, so the motion there is a piece of a harmonic or a
hyperbolic one, known in closed form: the wavelength is exact for the given dr, with its jumps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.errors import NoPeriodicMotion

#: Halvings of the bracket of a peak: from the width of the track to the last digit.
HALVINGS = 60

#: Intervals narrower than this are not split off at a peak, m: their work is lost in rounding.
NARROWEST = 1e-9


@dataclass(frozen=True, eq=False)
class Difference:
    """The rolling radius difference dr [m] over ascending y [m], a straight line in between."""

    y: Array
    dr: Array

    @property
    def work(self) -> Array:
        """Its integral from the first y, m^2."""
        mean = 0.5 * (self.dr[1:] + self.dr[:-1])
        return np.concatenate([[0.0], np.cumsum(mean * np.diff(self.y))])

    def work_at(self, y: Array | float) -> Array:
        """The integral at any y: exact, a parabola in each interval."""
        y = np.asarray(y, float)
        k = np.clip(np.searchsorted(self.y, y) - 1, 0, len(self.y) - 2)
        d = y - self.y[k]
        slope = (self.dr[k + 1] - self.dr[k]) / (self.y[k + 1] - self.y[k])
        return self.work[k] + d * (self.dr[k] + 0.5 * slope * d)

    def between(self, low: float, high: float) -> Difference:
        """The part between two displacements."""
        inner = (self.y > low + NARROWEST) & (self.y < high - NARROWEST)
        y = np.concatenate([[low], self.y[inner], [high]])
        return Difference(y, np.interp(y, self.y, self.dr))


def peaks(difference: Difference, amplitude: float) -> tuple[float, float]:
    """The ends of the motion: ``amplitude`` [m] apart from their middle, with no work between.

    Left and right profiles may differ: the middle need not be zero. Raises NoPeriodicMotion.
    """
    first, last = float(difference.y[0]), float(difference.y[-1])
    low, high = first, last - 2 * amplitude
    if high < low or not _unbalanced(difference, low, high, amplitude):
        raise NoPeriodicMotion(
            amplitude,
            f"the contact is known from {first * 1e3:.2f} to {last * 1e3:.2f} mm, which does not "
            "hold the whole wave",
        )
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _work(difference, middle, amplitude) < 0:
            low = middle
        else:
            high = middle
    return high, high + 2 * amplitude


def _work(difference: Difference, start: float, amplitude: float) -> float:
    low, high = difference.work_at(np.array([start, start + 2 * amplitude]))
    return float(high - low)


def _unbalanced(difference: Difference, low: float, high: float, amplitude: float) -> bool:
    return _work(difference, low, amplitude) <= 0 <= _work(difference, high, amplitude)


def wavelength(difference: Difference, start: float, end: float, stiffness: float) -> float:
    """Twice the way from one peak to the other, m; stiffness = 1 / (e r0), 1/m^2.

    In an interval of width d, from speed v0 to v1 (slopes of the path), with ``w^2 = stiffness
    dr'``, the way is ``2/w atan(w d / (v0 + v1))``, hyperbolic for dr' < 0. Raises
    NoPeriodicMotion if the wheelset would turn back before it reaches the other peak.
    """
    part = difference.between(start, end)
    d = np.diff(part.y)
    square = -2 * stiffness * part.work
    square[[0, -1]] = 0.0
    if np.any(square[1:-1] <= 0):
        turn = part.y[1 + int(np.argmax(square[1:-1] <= 0))]
        raise NoPeriodicMotion(
            0.5 * (end - start),
            f"the wheelset turns back at y = {turn * 1e3:.3f} mm before it reaches the other side",
        )
    v = np.sqrt(square)
    chord = d / np.maximum(v[1:] + v[:-1], 1e-300)
    bend = stiffness * np.diff(part.dr) / d * chord**2
    return float(4 * np.sum(chord * _slowed(bend)))


def _slowed(x: Array) -> Array:
    """atan(sqrt x)/sqrt x, continued to x < 0 as atanh(sqrt -x)/sqrt -x."""
    root = np.sqrt(np.maximum(abs(x), 1e-12))
    round_part = np.where(x > 0, np.arctan(root), np.arctanh(np.minimum(root, 1 - 1e-16)))
    return np.where(abs(x) < 1e-12, 1 - x / 3, round_part / root)
