"""The contact of wheels that differ by micrometres from one whose contact is known, many at once.

Both wheels are alike. The gap of a wheel lower by d(u) is the known gap less ``d cos(phi)``, and
moves with the roll by its known derivative; where the least gap lies is looked for anew at every
displacement, so that a contact that jumps elsewhere is found.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from wheelset.profiles import Contact, Profile
from wheelset.profiles.functions import smooth_spline
from wheelset.profiles.search import Wheelset

Array = NDArray[np.float64]

#: Spacing of displacements in the middle, of which the Hopf point takes three derivatives, and
#: beyond; how far the middle reaches, m.
FINE, COARSE, MIDDLE = 5e-5, 1e-4, 3.6e-3

#: Spacing of places on the wheel, and how far they go beyond those of the known contacts, m.
PLACES, BEYOND = 1e-4, 4e-3

#: Gap at places that are not over the rail, m.
AWAY = 1.0

#: Searches: the first finds the roll, the second the contact.
SEARCHES = 2

#: Samples searched together, so that a table of gaps stays small.
TOGETHER = 8


@dataclass(frozen=True, eq=False)
class Neighbourhood:
    """A known contact over y (Y,) [m], symmetric, and the left wheel's gap there.

    u (U,): places [m]; gap and turn (Y, U): gap [m] and its derivative by the roll [m]; cosine (Y,)
    of the roll; shift (Y,): place on the rail less u, m.
    """

    wheel: Profile
    rail: Profile
    y: Array
    u: Array
    gap: Array
    turn: Array
    cosine: Array
    shift: Array

    def functions(self, off: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Functions dr [m], delta [rad], rho [1/m] of y, (samples, 3, Y), and where they are known.

        off (3, samples, U): deviations of z [m], dz/du and d2z/du2. A sample is not known where its
        contact lies at the end of the places.
        """
        blocks = range(0, off.shape[1], TOGETHER)
        found = [self._searched(off[:, k : k + TOGETHER]) for k in blocks]
        return np.concatenate([f for f, _ in found]), np.concatenate([k for _, k in found])

    def _searched(self, off: Array) -> tuple[Array, NDArray[np.bool_]]:
        base = self.gap - off[0][:, np.newaxis] * self.cosine[:, np.newaxis]
        roll, table = np.zeros(0), base
        for search in range(SEARCHES):
            if search:
                table = roll * self.turn
                table += base
            lowest = table.argmin(axis=2)[..., np.newaxis]
            if search + 1 < SEARCHES:
                roll = self._roll(table, lowest)
        inner = np.clip(lowest, 1, len(self.u) - 2)
        place = self._vertex(table, inner)
        return self._at(place, off), (inner == lowest)[..., 0].all(axis=1)

    def _roll(self, table: Array, lowest: NDArray[np.intp]) -> Array:
        """Newton's step to one height of both wheels: the right one is the left one at -y."""
        height = np.take_along_axis(table, lowest, 2)
        turn = np.take_along_axis(np.broadcast_to(self.turn, table.shape), lowest, 2)
        return (height[:, ::-1] - height) / (turn + turn[:, ::-1])

    def _vertex(self, table: Array, k: NDArray[np.intp]) -> Array:
        """Places (samples, Y) of the least gap: vertices of parabolas through three values."""
        before, at, after = (np.take_along_axis(table, k + j, 2)[..., 0] for j in (-1, 0, 1))
        bend = np.maximum(before - 2 * at + after, 1e-18)
        step = np.clip((before - after) / (2 * bend), -1.0, 1.0)
        return self.u[k[..., 0]] + step * (self.u[1] - self.u[0])

    def _at(self, place: Array, off: Array) -> Array:
        """Functions at the places of contact."""
        off_there = (
            [np.interp(u, self.u, o) for u, o in zip(place, each, strict=True)] for each in off
        )
        z, slope, bend = (
            self.wheel.curve(place, k) + np.array(each) for k, each in enumerate(off_there)
        )
        rho = self.rail.curvature(place + self.shift) - bend / (1 + slope**2) ** 1.5
        centre = len(self.y) // 2
        return np.stack([z - z[:, centre, np.newaxis], -np.arctan(slope), rho], axis=1)


def neighbourhood(contact: Contact) -> Neighbourhood:
    """Of the contact of a wheelset with both sides alike, at displacements alike about 0."""
    y, roll, place = _symmetric(contact)
    wheel, rail = contact.wheels[0], contact.setup.laid(contact.rails[0])
    left = Wheelset.on_track(contact.setup, contact.wheels, contact.rails).left
    low = max(wheel.domain[0], place.min() - BEYOND)
    high = min(wheel.domain[1], place.max() + BEYOND)
    u = np.linspace(low, high, int(np.ceil((high - low) / PLACES)) + 1)
    grids = [a.ravel() for a in np.meshgrid(u, y)]
    turned = np.repeat(roll, len(u))
    over = left.on_rail(grids[0], grids[1], turned)
    inside = (over >= rail.domain[0]) & (over <= rail.domain[1])
    gap = np.where(inside, left.gap(grids[0], grids[1], turned), AWAY).reshape(len(y), -1)
    turn = left.by_roll(grids[0], grids[1], turned).reshape(len(y), -1)
    shift = left.on_rail(place, y, roll) - place
    return Neighbourhood(wheel, rail, y, u, gap, turn, np.cos(roll), shift)


def _symmetric(contact: Contact) -> tuple[Array, Array, Array]:
    """Displacements alike on either side, roll, and the left wheel's places of contact."""
    reach = min(-contact.y[0], contact.y[-1])
    outer = np.arange(MIDDLE, reach + 1e-9, COARSE)
    side = np.concatenate([np.arange(1, round(MIDDLE / FINE)) * FINE, outer])
    y: Array = np.concatenate([-side[::-1], np.zeros(1), side])
    roll: Array = np.interp(y, contact.y, contact.roll)
    return y, roll, np.asarray(np.interp(y, contact.y, contact.left.wheel_y), np.float64)


def averaging(y: Array, reach: float, width: float) -> BSpline:
    """The model's average of a function of y as a spline whose coefficients are operators on it:
    ``averaging(...)(x) @ f`` is the averaged function at x. As ``SplineGeometry.of``.
    """
    splines = [smooth_spline(y, unit, reach, width).spline for unit in np.eye(len(y))]
    return BSpline(splines[0].t, np.stack([s.c for s in splines], axis=-1), splines[0].k)
