"""The wheelset settled on its rails: where both wheels touch, and how far it rolls.

With roll, the axle's height must be the same for both wheels: ``h_l(phi) = h_r(phi)`` with
``h = min G``. Its derivative is that of the gap at the point of contact (the envelope theorem), so
Newton's method needs no differences.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.profiles.curves import Array
from wheelset.profiles.gap import Wheel
from wheelset.profiles.minima import ROUGH, Minima, refined, scan
from wheelset.profiles.profile import Profile
from wheelset.profiles.setup import Setup

SIDES = ("left", "right")

#: Where the roll is taken as found, rad; Newton steps after each scan.
ROLLED, STEPS = 1e-10, 4

#: Least lever of the roll, m (it is about the distance of the rails), and its largest step, rad:
#: bounds for displacements at which a profile has ended and the contact means nothing.
LEVER, FARTHEST = 0.1, 0.02

#: A roll that ends further than this from where it was scanned, rad, is scanned again, so often.
MOVED, RESCANS = 1e-5, 12

#: Spacing of the displacements at which rough scans bring the roll near, m, and how often.
NEAR, NEAR_STEPS = 3e-4, 3


@dataclass(frozen=True, eq=False)
class Touch:
    """One wheel's contact for every displacement.

    u: place on the wheel; gap: G there; rival_u, rival_gap: the next minimum and how much higher
    it is, m (u itself and infinity where there is none); ends: the profile ended there.
    """

    u: Array
    gap: Array
    rival_u: Array
    rival_gap: Array
    ends: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Settled:
    """Displacements y, roll [rad] and the touch of both wheels.

    scanned: the roll at which minima were looked for; step: what Newton's method still changed.
    """

    y: Array
    roll: Array
    left: Touch
    right: Touch
    scanned: Array
    step: Array

    @property
    def unsettled(self) -> NDArray[np.bool_]:
        """Where the roll was not found, or moved away from where the minima were looked for."""
        return (abs(self.step) > ROLLED) | (abs(self.roll - self.scanned) > MOVED)

    def replaced(self, rows: NDArray[np.intp], other: Settled) -> Settled:
        """With the rows of another search in place of these."""
        return _merged(self, other, lambda these, others: _replaced(these, rows, others))

    def only(self, rows: slice | NDArray[np.bool_]) -> Settled:
        """Some rows of it."""
        return _merged(self, self, lambda these, _: these[rows])

    def joined(self, other: Settled) -> Settled:
        """Together with the rows of another search, by ascending y."""
        order = np.argsort(np.concatenate([self.y, other.y]), kind="stable")
        return _merged(self, other, lambda *both: np.concatenate(both)[order])


Merge = Callable[[NDArray[Any], NDArray[Any]], NDArray[Any]]


def _merged(one: Settled, other: Settled, merge: Merge) -> Settled:
    touches = [
        Touch(*(merge(getattr(a, f.name), getattr(b, f.name)) for f in fields(Touch)))
        for a, b in ((one.left, other.left), (one.right, other.right))
    ]
    y, roll, scanned, step = (
        merge(getattr(one, name), getattr(other, name)) for name in ("y", "roll", "scanned", "step")
    )
    return Settled(y, roll, touches[0], touches[1], scanned, step)


def _replaced(values: NDArray[Any], rows: NDArray[np.intp], others: NDArray[Any]) -> NDArray[Any]:
    changed = values.copy()
    changed[rows] = others
    return changed


@dataclass(frozen=True, eq=False)
class Wheelset:
    """Both wheels over their rails."""

    left: Wheel
    right: Wheel
    rolls: bool

    @classmethod
    def on_track(
        cls, setup: Setup, wheels: tuple[Profile, Profile], rails: tuple[Profile, Profile]
    ) -> Wheelset:
        """Left and right profiles placed as the set-up says."""
        first = setup.laid(rails[0])
        laid = (first, first if rails[1] is rails[0] else setup.laid(rails[1]))
        places = [setup.rail_at(first)]
        places.append(places[0] if laid[1] is first else setup.rail_at(laid[1]))
        left, right = (
            Wheel.over(
                s,
                wheel.curve,
                rail.curve,
                low=setup.radius(side) - setup.mean_radius,
                b=setup.wheel_at,
                br=place,
            )
            for s, side, wheel, rail, place in zip(
                (1, -1), SIDES, wheels, laid, places, strict=True
            )
        )
        return cls(left, right, setup.roll)

    def settle(self, y: Array, near: Array | None = None) -> Settled:
        """The contact of both wheels at every y [m]; near: the roll, roughly, if it is known."""
        if not self.rolls:
            return self._settle_near(y, np.zeros_like(y))
        settled = self._settle_near(y, self._rough_roll(y) if near is None else near)
        for _ in range(RESCANS):
            again = np.flatnonzero(settled.unsettled)
            if not len(again):
                break
            settled = settled.replaced(again, self._settle_near(y[again], settled.roll[again]))
        return settled

    def _settle_near(self, y: Array, scanned: Array) -> Settled:
        """Scan at one roll, then roll until the axle's height is one."""
        wheels = (self.left, self.right)
        minima = [scan(wheel, y, scanned) for wheel in wheels]
        phi, step = scanned, np.zeros_like(y)
        for _ in range(STEPS):
            minima = [refined(w, m, y, phi) for w, m in zip(wheels, minima, strict=True)]
            left, right = (_touch(w, m, y, phi) for w, m in zip(wheels, minima, strict=True))
            step = self._roll_step(left, right, y, phi) if self.rolls else step
            if abs(step).max(initial=0.0) < ROLLED:
                break
            phi = phi + step
        return Settled(y, phi, left, right, scanned, step)

    def _rough_roll(self, y: Array) -> Array:
        """Roll near y, from rough scans at some displacements about y."""
        table = np.arange(y.min() - NEAR, y.max() + 2 * NEAR, NEAR)
        phi = np.zeros_like(table)
        for _ in range(NEAR_STEPS):
            left, right = (
                _touch(wheel, scan(wheel, table, phi, ROUGH), table, phi)
                for wheel in (self.left, self.right)
            )
            phi = phi + self._roll_step(left, right, table, phi)
        return np.interp(y, table, phi)

    def _roll_step(self, left: Touch, right: Touch, y: Array, phi: Array) -> Array:
        slope = self.left.by_roll(left.u, y, phi) - self.right.by_roll(right.u, y, phi)
        return np.clip((right.gap - left.gap) / np.maximum(slope, LEVER), -FARTHEST, FARTHEST)


def _touch(wheel: Wheel, minima: Minima, y: Array, phi: Array) -> Touch:
    """The lowest and the second lowest minimum of every row."""
    if not len(minima.row):
        none = np.zeros(len(minima.ends))
        return Touch(none, none, none, none + np.inf, none == 0)
    gap = wheel.gap(minima.u, y[minima.row], phi[minima.row])
    order = np.lexsort((gap, minima.row))
    row, u, gap = minima.row[order], minima.u[order], gap[order]
    every = np.arange(len(minima.ends))
    first = np.minimum(np.searchsorted(row, every), len(row) - 1)
    second = np.minimum(first + 1, len(row) - 1)
    alone = (second == first) | (row[second] != row[first])
    rival = np.where(alone, first, second)
    rival_gap = np.where(alone, np.inf, gap[second] - gap[first])
    ends = minima.ends | (row[first] != every)
    return Touch(u[first], gap[first], u[rival], rival_gap, ends)
