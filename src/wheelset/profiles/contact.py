"""Where a wheelset touches its rails as it moves sideways, and what the contacts are like."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from wheelset.profiles.curves import Array
from wheelset.profiles.errors import ContactOutcome, NotSettled, ProfileEnds, ProfileError
from wheelset.profiles.gap import Wheel
from wheelset.profiles.jumps import Jump, beside_jumps, closely_settled, jumps
from wheelset.profiles.profile import Kind, Profile
from wheelset.profiles.search import SIDES, Settled, Touch, Wheelset
from wheelset.profiles.setup import Setup

#: Displacements that are searched if none are given, m.
DISPLACEMENTS = np.linspace(-0.010, 0.010, 401)


@dataclass(frozen=True, eq=False)
class SideContact:
    """One wheel's contact over the displacements; arrays of the length of y.

    wheel_y, rail_y: places on the profiles, m. r: rolling radius, m. delta: contact angle from
    the wheelset's axle, positive towards the flange, rad. wheel_curvature, rail_curvature:
    1/m, positive where convex. rival_y, rival_gap: the next minimum of the gap on the wheel
    and how far it is from touching, m; the contact itself and infinity where there is none.
    """

    wheel_y: Array
    rail_y: Array
    r: Array
    delta: Array
    wheel_curvature: Array
    rail_curvature: Array
    rival_y: Array
    rival_gap: Array

    @property
    def rho(self) -> Array:
        """Sum of the lateral curvatures of wheel and rail, 1/m."""
        return self.wheel_curvature + self.rail_curvature


@dataclass(frozen=True, eq=False)
class Contact:
    """Contacts of both wheels over the wheelset's lateral displacement y to the left.

    y [m] is measured at rail level; the axle's centre moves by ``axle_y``. It ascends and holds,
    besides the displacements asked for (``asked`` is true there), both sides of every jump, no
    more than 1e-6 m apart. roll [rad]: positive when the left wheel rises. wheels, rails: left and
    right profiles as given. ended: why part of the displacements asked for is missing, if it is.
    """

    setup: Setup
    wheels: tuple[Profile, Profile]
    rails: tuple[Profile, Profile]
    y: Array
    asked: NDArray[np.bool_]
    roll: Array
    left: SideContact
    right: SideContact
    jumps: tuple[Jump, ...]
    ended: tuple[ContactOutcome, ...] = ()

    @property
    def dr(self) -> Array:
        """Rolling radius difference, left less right, m."""
        return self.left.r - self.right.r

    @property
    def axle_y(self) -> Array:
        """Lateral displacement of the axle's centre, m."""
        return self.y - self.setup.mean_radius * np.sin(self.roll)

    def to_frame(self) -> pd.DataFrame:
        """Everything over the displacements asked for, SI units; indexed by y."""
        columns = {"dr": self.dr, "roll": self.roll}
        for side in SIDES:
            contact = getattr(self, side)
            columns |= {f"{name}_{side}": array for name, array in vars(contact).items()}
            columns[f"rho_{side}"] = contact.rho
        frame = pd.DataFrame(columns, index=pd.Index(self.y, name="y"))
        return frame[self.asked]


def contact_geometry(
    wheel: Profile,
    rail: Profile,
    setup: Setup | None = None,
    y: ArrayLike = DISPLACEMENTS,
    *,
    wheel_right: Profile | None = None,
    rail_right: Profile | None = None,
    trim: bool = False,
) -> Contact:
    """The contact of a wheelset on a track at the displacements y [m], ascending.

    Rigid, planar, quasi-static. Raises ProfileEnds where the contact would lie beyond the end of
    a profile, NotSettled where no roll is found; with ``trim`` the displacements from there on are
    left out and ``ended`` says so.
    """
    setup = setup or Setup()
    wheels, rails = (wheel, wheel_right or wheel), (rail, rail_right or rail)
    _check_kinds(wheels, "wheel")
    _check_kinds(rails, "rail")
    asked = _checked(y)
    wheelset = Wheelset.on_track(setup, wheels, rails)
    first = wheelset.settle(asked)
    reach, ended = _reach(first)
    if ended and not trim:
        raise ended[0]
    settled = closely_settled(wheelset, first.only(reach))
    found = jumps(settled, wheelset)
    settled = settled.only(np.isin(settled.y, asked) | beside_jumps(settled))
    return Contact(
        setup,
        wheels,
        rails,
        settled.y,
        np.isin(settled.y, asked),
        settled.roll,
        _side(wheelset.left, settled, settled.left, wheels[0], setup.radius("left")),
        _side(wheelset.right, settled, settled.right, wheels[1], setup.radius("right")),
        found,
        ended,
    )


def _check_kinds(profiles: tuple[Profile, Profile], kind: Kind) -> None:
    for profile in profiles:
        if profile.kind != kind:
            raise ProfileError(f"{profile.name} is a {profile.kind}, a {kind} is wanted here")


def _checked(y: ArrayLike) -> Array:
    asked = np.atleast_1d(np.asarray(y, float))
    ascending = asked.ndim == 1 and bool(np.all(np.diff(asked) > 0))
    if not (ascending and np.isfinite(asked).all() and abs(asked).max(initial=0.0) <= 0.05):
        raise ValueError("y must be ascending displacements between -0.05 and 0.05 m, in m")
    return asked


def _reach(settled: Settled) -> tuple[slice, tuple[ContactOutcome, ...]]:
    """The displacements about the middle that are known, and why the others are not."""
    bad = settled.left.ends | settled.right.ends | settled.unsettled
    centre = int(abs(settled.y).argmin())
    if bad[centre]:
        raise _outcome(settled, centre)
    low = int(np.flatnonzero(bad[:centre]).max(initial=-1)) + 1
    high = int(np.flatnonzero(bad[centre:]).min(initial=len(bad) - centre)) + centre
    at = ([low - 1] if low else []) + ([high] if high < len(bad) else [])
    return slice(low, high), tuple(_outcome(settled, k) for k in at)


def _outcome(settled: Settled, k: int) -> ContactOutcome:
    y = float(settled.y[k])
    for side in SIDES:
        if getattr(settled, side).ends[k]:
            return ProfileEnds(side, y)
    return NotSettled(y)


def _side(wheel: Wheel, settled: Settled, touch: Touch, profile: Profile, r0: float) -> SideContact:
    place = wheel.on_rail(touch.u, settled.y, settled.roll)
    rail = Profile("", "rail", wheel.rail)
    return SideContact(
        touch.u,
        place,
        r0 + profile.z(touch.u),
        -np.arctan(profile.slope(touch.u)),
        profile.curvature(touch.u),
        rail.curvature(place),
        touch.rival_u,
        touch.rival_gap,
    )
