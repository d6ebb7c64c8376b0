"""The operation under which a wheel wears, and the conditions drawn from it.

A condition is one wheel, taken as the left one: the right wheel is the left one of the mirrored
motion, and displacement, yaw and curves are drawn to both sides alike.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc

from wheelset.wear.patch import Array
from wheelset.wear.ranges import within

_RANGES = {
    "speed": (1.0, 150.0, "m/s"),
    "load": (1e3, 3e5, "N"),
    "load_scatter": (0.0, 0.3, "of the load"),
    "displacement": (1e-5, 5e-3, "m"),
    "yaw": (0.0, 0.02, "rad"),
    "difference_share": (0.0, 1.0, ""),
    "traction": (0.0, 0.01, ""),
    "friction": (0.05, 1.0, ""),
}

#: Standard deviations at which drawn values are cut.
CUT = 3.0


@dataclass(frozen=True)
class Curve:
    """Curves of one radius [m]: their share of the distance, and by how far [m] the wheelset runs
    towards the outer rail there, besides the scatter of straight track.
    """

    share: float
    radius: float
    shift: float

    def __post_init__(self) -> None:
        within("share", self.share, 0.0, 1.0, "of the distance")
        within("radius", self.radius, 100.0, 1e5, "m")
        within("shift", self.shift, 0.0, 8e-3, "m")


#: Assumed: a high-speed line is straight for two thirds; stations are left through wide switches.
CURVES = (Curve(0.22, 9000.0, 0.5e-3), Curve(0.10, 7000.0, 1e-3), Curve(0.01, 1500.0, 3e-3))


@dataclass(frozen=True)
class Operation:
    """Conditions of a high-speed trainset. Raises ValueError naming a field that is out of range.

    speed: 300 km/h (assumed). load: static, of one wheel (that of guo2021_physical); load_scatter:
    its dynamic standard deviation (assumed). displacement: standard deviation of the lateral
    displacement on straight track (assumed; of 1.5, 2 and 2.5 mm the one with which both laws keep
    their wear within the published 25 mm of the nominal circle). curves: assumed.
    yaw: standard deviation of the lateral creepage, rad (assumed). difference_share: share
    of the rolling radius difference that becomes longitudinal creepage; 1: the wheelset
    does not yaw freely (assumed: stiff guidance). traction: standard deviation of the creepage by
    which the wheel drives and brakes (assumed: 4 kN of 60 kN). friction: assumed, dry rail.
    """

    speed: float = 300 / 3.6
    load: float = 60e3
    load_scatter: float = 0.12
    displacement: float = 1.5e-3
    curves: tuple[Curve, ...] = CURVES
    yaw: float = 5e-4
    difference_share: float = 1.0
    traction: float = 3e-4
    friction: float = 0.3

    def __post_init__(self) -> None:
        for name, bounds in _RANGES.items():
            within(name, getattr(self, name), *bounds)
        within("sum of the curves' shares", sum(c.share for c in self.curves), 0.0, 1.0)

    def to_dict(self) -> dict[str, Any]:
        """Everything by name, for files."""
        return asdict(self)

    def draw(self, count: int, seed: int) -> Conditions:
        """``count`` conditions, a power of two, by a scrambled Sobol sequence."""
        within("count", count, 2, 2**20, "conditions")
        if count & (count - 1):
            raise ValueError(f"count = {count} is no power of two, as Sobol's sequence needs it")
        points = qmc.Sobol(5, scramble=True, seed=seed).random(count)
        track, sign, weight = self._tracks(points[:, 0])
        normal = np.clip(ndtri(np.clip(points[:, 1:], 1e-12, 1 - 1e-12)), -CUT, CUT)
        shift = np.array([0.0, *(c.shift for c in self.curves)])[track] * sign
        bend = np.array([0.0, *(1 / c.radius for c in self.curves)])[track] * sign
        return Conditions(
            shift + self.displacement * normal[:, 0],
            self.load * (1 + self.load_scatter * normal[:, 1]),
            self.yaw * normal[:, 2],
            self.traction * normal[:, 3],
            bend,
            weight,
        ).ascending()

    def _tracks(self, u: Array) -> tuple[Array, Array, Array]:
        """Straight (0) or a curve, its side, and the weight; rare curves are drawn more often."""
        curves = [c.share for c in self.curves]
        shares = np.array([1 - sum(curves), *curves])
        chances = np.sqrt(shares) / np.sqrt(shares).sum()
        ends = np.cumsum(chances)
        track = np.minimum(np.searchsorted(ends, u, side="right"), len(shares) - 1)
        inside = (u - (ends - chances)[track]) / chances[track]
        weight = (shares / chances)[track]
        return track, np.where(inside < 0.5, -1.0, 1.0), weight / weight.sum()


@dataclass(frozen=True, eq=False)
class Conditions:
    """Conditions of one wheel, arrays of one length, by ascending displacement y [m].

    load: N. yaw: lateral creepage. traction: creepage, positive where the wheel brakes. bend:
    curvature of the track, 1/m, positive with the wheel outside. weight: share of the distance.
    """

    y: Array
    load: Array
    yaw: Array
    traction: Array
    bend: Array
    weight: Array

    def ascending(self) -> Conditions:
        """By displacement."""
        order = np.argsort(self.y, kind="stable")
        return Conditions(*(values[order] for values in vars(self).values()))
