"""A wheelset on its track: what has to be known besides the profiles. SI units.

Signs: y to the left, z down; the left side has s = +1, the right one s = -1. A profile's own y is
``s`` times the track's. Roll is positive when the left wheel rises.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from wheelset.profiles.profile import Profile

_RANGES = {
    "gauge": (0.5, 2.0),
    "cant": (0.0, 0.2),
    "back_to_back": (0.5, 2.0),
    "r0": (0.1, 1.5),
    "r0_right": (0.1, 1.5),
    "taping": (0.03, 0.12),
    "wheel_origin": (0.3, 1.2),
    "rail_origin": (0.3, 1.2),
    "base": (0.5, 2.5),
    "gauge_depth": (0.005, 0.02),
}


@dataclass(frozen=True)
class Setup:
    """Where the profiles stand.

    gauge, measured ``gauge_depth`` below the rails' top; cant: the rails' inclination, inward;
    back_to_back: between the wheels' back faces, ``taping`` inside the nominal circle; r0: nominal
    radius, ``r0_right`` if the right wheel differs; base: e, the distance of the contacts in the
    kinematic equation. wheel_origin, rail_origin: distance of the profiles' origins from the
    centre where they are prescribed; otherwise they follow from back_to_back and gauge.
    roll: whether the wheelset rolls until both wheels touch, or keeps its axle level.

    Raises ValueError naming the field, its value and its range.
    """

    gauge: float = 1.435
    cant: float = 1 / 40
    back_to_back: float = 1.353
    r0: float = 0.46
    roll: bool = True
    r0_right: float | None = None
    taping: float = 0.07
    wheel_origin: float | None = None
    rail_origin: float | None = None
    base: float = 1.5
    gauge_depth: float = 0.014

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            low, high = _RANGES.get(field.name, (0, 1))
            if value is not None and not low <= value <= high:
                raise ValueError(
                    f"{field.name} = {value:g} is out of range; it lies between {low:g} and "
                    f"{high:g}{'' if field.name == 'cant' else ' m'}"
                )

    def radius(self, side: str) -> float:
        """Nominal radius of the left or right wheel, m."""
        return self.r0_right if side == "right" and self.r0_right is not None else self.r0

    @property
    def mean_radius(self) -> float:
        """Mean of both nominal radii, m: the r0 of the kinematic equation."""
        return 0.5 * (self.radius("left") + self.radius("right"))

    @property
    def wheel_at(self) -> float:
        """Distance of a wheel profile's origin from the wheelset's centre, m."""
        return self.wheel_origin or self.back_to_back / 2 + self.taping

    def laid(self, rail: Profile) -> Profile:
        """The rail as it lies in the track: inclined, unless the profile is already."""
        return rail if rail.in_place or not self.cant else rail.canted(self.cant)

    def rail_at(self, laid: Profile) -> float:
        """Distance of a laid rail profile's origin from the track's centre, m."""
        return self.rail_origin or self.gauge / 2 - laid.gauge_point(self.gauge_depth)


#: The set-up in which EN 15302 tabulates its results: level axle, origins at +-750 mm.
EN_15302 = Setup(cant=0.0, roll=False, wheel_origin=0.75, rail_origin=0.75)

#: Spacing of the tables of EN 15302, m.
EN_15302_GRID = 1e-4
