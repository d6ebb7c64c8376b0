"""A wheel's or rail's profile.

Coordinates: y from the nominal (taping) circle or the rail's centre, outward positive, to the
field side; z down, so that a flange has z > 0. Left and right profiles look alike in them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from wheelset.profiles.curves import Array, Curve, samples

Kind = Literal["wheel", "rail"]
Side = Literal["left", "right", "both"]


@dataclass(frozen=True)
class Profile:
    """A wheel's or rail's profile in its own coordinates, m.

    in_place: a rail whose formula or measurement holds its inclination already.
    source: where the shape comes from; notes: what was found and repaired while reading it.
    """

    name: str
    kind: Kind
    curve: Curve
    side: Side = "both"
    in_place: bool = False
    source: str = ""
    notes: tuple[str, ...] = ()

    @property
    def domain(self) -> tuple[float, float]:
        """First and last y, m."""
        return self.curve.domain

    def z(self, y: ArrayLike) -> Array:
        """Height [m], positive down, of the shape of y."""
        return self.curve(y)

    def slope(self, y: ArrayLike) -> Array:
        """dz/dy."""
        return self.curve(y, 1)

    def curvature(self, y: ArrayLike) -> Array:
        """Curvature [1/m], positive where the body is convex: negative on a hollow tread."""
        bent = self.curve(y, 2) / (1 + self.curve(y, 1) ** 2) ** 1.5
        return bent if self.kind == "rail" else -bent

    def points(self, spacing: float = 1e-4) -> tuple[Array, Array]:
        """Points y, z [m] of the profile, no further apart in y than ``spacing`` [m]."""
        y = samples(self.curve, spacing)
        return y, self.curve(y)

    def canted(self, angle: float) -> Profile:
        """A rail leaning inward by ``angle`` [rad], its top at z = 0 again."""
        curve = self.curve.rotated(angle)
        return replace(self, curve=curve.moved(0.0, -_top(curve)), in_place=True)

    def gauge_point(self, depth: float = 0.014) -> float:
        """The y [m] at which a rail's gauge side is ``depth`` below its top.

        Raises ValueError if the profile does not reach that deep.
        """
        y, z = self.points(SCAN)
        inside = np.flatnonzero((y < y[z.argmin()]) & (z >= z.min() + depth))
        if not len(inside):
            raise ValueError(
                f"{self.name}: the gauge side ends {z[0] - z.min():.4f} m below the top, the gauge "
                f"is measured at {depth} m; give a deeper profile or the position of its origin"
            )
        low, high, level = y[inside[-1]], y[inside[-1] + 1], z.min() + depth
        while high - low > 1e-12:
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.z(middle) >= level else (low, middle)
        return float(low)


#: Spacing of the samples among which tops and gauge points are looked for, m.
SCAN = 5e-5


def _top(curve: Curve) -> float:
    return float(curve(samples(curve, SCAN)).min())
