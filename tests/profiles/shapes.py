"""Profiles whose contacts are known in closed form."""

from __future__ import annotations

from wheelset.profiles.curves import PiecewiseCurve, arc, line
from wheelset.profiles.profile import Profile
from wheelset.profiles.setup import Setup

#: Radii of a round rail and of a hollow wheel over it, m, and a cone's slope.
RAIL, WHEEL, CONE = 0.3, 0.5, 0.05

#: Level axle; the profiles' origins one above the other in the middle.
LEVEL = Setup(cant=0.0, roll=False, wheel_origin=0.75, rail_origin=0.75)
ROLLING = Setup(cant=0.0, roll=True, wheel_origin=0.75, rail_origin=0.75)


def round_rail() -> Profile:
    return Profile("round", "rail", PiecewiseCurve((-0.04, 0.04), (arc(RAIL, 0, RAIL, -1),)))


def hollow_wheel(aside: float = 0.0) -> Profile:
    curve = PiecewiseCurve((-0.06, 0.06), (arc(WHEEL, aside, WHEEL, -1),))
    return Profile("hollow", "wheel", curve)


def cone(slope: float = CONE) -> Profile:
    return Profile("cone", "wheel", PiecewiseCurve((-0.06, 0.06), (line(0.0, -slope),)))
