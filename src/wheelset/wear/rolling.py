"""Wear of a wheel that rolls over a rail under drawn conditions: the rate of depth over its y."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from wheelset.profiles import Contact, Profile, Setup, contact_geometry
from wheelset.profiles.gap import Wheel
from wheelset.profiles.search import Wheelset
from wheelset.wear.creep import CELLS, Slip, slide
from wheelset.wear.errors import ContactLost
from wheelset.wear.laws import WearLaw
from wheelset.wear.operation import Conditions
from wheelset.wear.patch import Array, Index, Patches, find_patches
from wheelset.wear.ranges import within

#: Largest share of the distance without a known contact, over which nothing is worn then.
MOST_LOST = 0.02


@dataclass(frozen=True)
class Strips:
    """Places on the wheel where wear is counted, m: from, to and spacing; smoothing: standard
    deviation of the Gaussian by which rates are averaged over y.

    The average stands for what the conditions leave out: rails, gauge and inclination differ along
    the line. It is a choice; what it changes is reported, not hidden.
    """

    first: float = -0.042
    last: float = 0.030
    spacing: float = 2.5e-4
    smoothing: float = 2.5e-3

    def __post_init__(self) -> None:
        within("spacing", self.spacing, 5e-5, 1e-3, "m")
        within("smoothing", self.smoothing, 2 * self.spacing, 0.02, "m")
        within("last", self.last, self.first + 0.01, 0.07, "m")
        within("first", self.first, -0.07, 0.0, "m")

    @property
    def y(self) -> Array:
        """The places, m."""
        count = round((self.last - self.first) / self.spacing) + 1
        return np.linspace(self.first, self.last, count)

    def smoothed(self, rate: Array) -> Array:
        """The average over y; nothing lies beyond the ends."""
        width = self.smoothing / self.spacing
        return gaussian_filter1d(rate, width, mode="constant", truncate=6.0)


@dataclass(frozen=True, eq=False)
class Rolling:
    """A wheel pair's rail, track, operation and law: everything but the wheel's shape."""

    rail: Profile
    setup: Setup
    conditions: Conditions
    law: WearLaw
    strips: Strips
    speed: float
    friction: float
    difference_share: float
    cells: int = CELLS

    def rate(self, wheel: Profile) -> Array:
        """Vertical depth per distance rolled at the strips' places, m/m."""
        touching = Touching.of(self, wheel)
        patches = touching.patches(self.strips)
        slip = touching.slip(self, patches)
        sliding = slide(patches, slip, self.cells)
        per_metre = self.law.rate(sliding.pressure, sliding.traction, sliding.slip, self.speed)
        depth = per_metre.sum(axis=0) * sliding.dx
        # a particle passes once a turn; the depth is normal, the profile's z vertical
        turn = 2 * np.pi * (self.setup.r0 + touching.z)
        weighted = depth * touching.conditions.weight[patches.row]
        total = np.bincount(patches.column, weighted, minlength=len(touching.z))
        return self.strips.smoothed(total * np.hypot(1.0, touching.slope) / turn)


@dataclass(frozen=True, eq=False)
class Touching:
    """The left wheel's contacts under those conditions that have one.

    z, slope: of the wheel at the strips. gap: (conditions, strips), vertical, from the contact, m.
    u, r, delta: place [m], rolling radius [m], angle [rad] of the contact; mean_r: of both wheels.
    """

    conditions: Conditions
    z: Array
    slope: Array
    gap: Array
    u: Array
    r: Array
    delta: Array
    mean_r: Array

    @classmethod
    def of(cls, rolling: Rolling, wheel: Profile) -> Touching:
        """By the contact search; raises ContactLost."""
        y, place = np.unique(rolling.conditions.y, return_inverse=True)
        contact = contact_geometry(wheel, rolling.rail, rolling.setup, y, trim=True)
        known, rows = _known(contact, y, place, rolling.conditions)
        left = contact.left
        wheelset = Wheelset.on_track(
            rolling.setup, (wheel, wheel), (rolling.rail, rolling.rail)
        ).left
        at, phi = contact.y[rows, None], contact.roll[rows, None]
        u = np.clip(rolling.strips.y, *wheel.domain)
        gap = wheelset.gap(u, at, phi) - wheelset.gap(left.wheel_y[rows, None], at, phi)
        there = _covered(rolling.strips.y, wheelset.on_rail(u, at, phi), wheel, wheelset)
        mean_r = 0.5 * (left.r + contact.right.r)[rows]
        return cls(
            known,
            wheel.z(u),
            wheel.slope(u),
            np.where(there, gap, np.inf),
            left.wheel_y[rows],
            left.r[rows],
            left.delta[rows],
            mean_r,
        )

    def patches(self, strips: Strips) -> Patches:
        """Gaps are taken normal to the wheel and distances along it.

        The vertical part of the normal force is the load; creep forces are left out of it.
        """
        y = strips.y
        steep = np.hypot(1.0, self.slope)
        middle = 0.5 * (steep[1:] + steep[:-1])
        along = np.concatenate([[0.0], np.cumsum(middle * strips.spacing)])
        t = along - np.interp(self.u, y, along)[:, None]
        load = self.conditions.load / np.cos(self.delta)
        return find_patches(self.gap / steep, t, steep * strips.spacing, self.r, load)

    def slip(self, rolling: Rolling, patches: Patches) -> Slip:
        """Slip of the wheel over the rail: positive forward where the wheel is too slow.

        The wheel turns so that the mean radius rolls; a strip's own radius holds the spin.
        """
        row, column = patches.row, patches.column
        c, r0 = self.conditions, rolling.setup.r0
        across = (self.r[row] - (rolling.setup.r0 + self.z[column])) / r0
        path = self.mean_r - self.r + 0.5 * rolling.setup.base * r0 * c.bend
        common = rolling.difference_share * path / r0 + c.traction
        inclined = np.sin(np.arctan(self.slope))
        return Slip(across + common[row], c.yaw[row], (inclined / r0)[column], rolling.friction)


def _covered(y: Array, place: Array, wheel: Profile, over: Wheel) -> NDArray[np.bool_]:
    """Whether a strip lies on the wheel and over the rail: beyond their ends nothing touches."""
    (low, high), (first, last) = wheel.domain, over.rail.domain
    return (y >= low) & (y <= high) & (place >= first) & (place <= last)


def _known(
    contact: Contact, y: Array, place: Index, conditions: Conditions
) -> tuple[Conditions, Index]:
    """The conditions whose contact is known, and where it stands among the contacts."""
    asked = np.flatnonzero(contact.asked)
    found = np.isin(y, contact.y[asked])[place]
    lost = float(conditions.weight[~found].sum())
    if lost > MOST_LOST:
        raise ContactLost(lost, str(contact.ended[0]))
    kept = Conditions(*(values[found] for values in vars(conditions).values()))
    return kept, asked[np.searchsorted(contact.y[asked], kept.y)]
