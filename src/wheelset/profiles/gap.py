"""The vertical gap between one wheel and its rail.

The wheelset is displaced by y and rolls by phi about its middle at rail level, r0 below the axle;
there y is measured (the axle's centre moves by ``y - r0 sin phi``). A point u of a wheel's profile
then stands at

    U = (b + u) cos phi + s z(u) sin phi + s y     outward from the track's centre
    Z = z(u) cos phi - s (b + u) sin phi           below the wheelset's middle

and ``G = z_rail(U) - Z`` is the height at which that point would touch. The wheel touches where G
is least: there ``dG/du = 0``, and the tangents agree.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wheelset.profiles.curves import Array, Curve, samples

#: Spacing of the table of a rail's height used while scanning, m.
TABLE = 5e-5

#: Height given to points beyond the end of a rail, m.
NOWHERE = 1.0


@dataclass(frozen=True, eq=False)
class Table:
    """A curve at equal spacing, NOWHERE beyond its ends: linear interpolation by index."""

    first: float
    spacing: float
    z: Array
    rise: Array

    @classmethod
    def of(cls, curve: Curve) -> Table:
        """Sampled no further apart than TABLE."""
        y = samples(curve, TABLE)
        spacing = float(y[1] - y[0])
        z = np.concatenate([[NOWHERE], curve(y), [NOWHERE, NOWHERE]])
        rise = np.diff(z, append=NOWHERE)
        rise[[0, -3]] = 0.0
        z[-3] = NOWHERE
        return cls(float(y[0]) - spacing, spacing, z, rise)

    def at(self, y: Array) -> Array:
        """Heights, of the shape of y."""
        place = (y - self.first) / self.spacing
        np.clip(place, 0.0, len(self.z) - 1.5, out=place)
        index = place.astype(np.intp)
        place -= index
        place *= self.rise[index]
        place += self.z[index]
        return place


@dataclass(frozen=True, eq=False)
class Wheel:
    """One wheel over its rail: s = +1 left, -1 right; b, br: the profiles' origins, m.

    low: how far its profile lies below the other wheel's middle, if their radii differ, m.
    """

    s: int
    curve: Curve
    rail: Curve
    low: float
    b: float
    br: float
    table: Table

    @classmethod
    def over(cls, s: int, curve: Curve, rail: Curve, *, low: float, b: float, br: float) -> Wheel:
        """With the rail's height tabulated for scanning."""
        return cls(s, curve, rail, low, b, br, Table.of(rail))

    def on_rail(self, u: Array, y: Array, phi: Array) -> Array:
        """The point's place on the rail's profile, m."""
        return self._place(u, self.curve(u), y, np.cos(phi), np.sin(phi))

    def _place(self, u: Array, z: Array, y: Array, c: Array, n: Array) -> Array:
        return (self.b + u) * c + self.s * (self.low + z) * n + self.s * y - self.br

    def _below(self, u: Array, z: Array, c: Array, n: Array) -> Array:
        return (self.low + z) * c - self.s * (self.b + u) * n

    def table_of_gaps(self, u: Array, z: Array, y: Array, phi: Array) -> Array:
        """G of all u for all (y, phi), from the table; shape (len(y), len(u))."""
        c, n = np.cos(phi), self.s * np.sin(phi)
        across, down = self.b + u, self.low + z
        turn = np.stack([c, n, self.s * y - self.br], axis=1)
        place = turn @ np.stack([across, down, np.ones_like(u)])
        height = self.table.at(place)
        height -= turn[:, :2] @ np.stack([down, -across])
        return height

    def gap(self, u: Array, y: Array, phi: Array) -> Array:
        """G [m]."""
        c, n, z = np.cos(phi), np.sin(phi), self.curve(u)
        return self.rail(self._place(u, z, y, c, n)) - self._below(u, z, c, n)

    def slopes(self, u: Array, y: Array, phi: Array) -> tuple[Array, Array]:
        """dG/du and d2G/du2."""
        c, n = np.cos(phi), np.sin(phi)
        z, z1, z2 = self.curve.jet(u)
        _, steep, bent = self.rail.jet(self._place(u, z, y, c, n))
        u1 = c + self.s * z1 * n
        first = steep * u1 - (z1 * c - self.s * n)
        return first, bent * u1**2 + steep * self.s * z2 * n - z2 * c

    def by_roll(self, u: Array, y: Array, phi: Array) -> Array:
        """dG/dphi at fixed u, which is that of the least gap too."""
        c, n, z = np.cos(phi), np.sin(phi), self.curve(u)
        sideways = -(self.b + u) * n + self.s * (self.low + z) * c
        downwards = -(self.low + z) * n - self.s * (self.b + u) * c
        return self.rail(self._place(u, z, y, c, n), 1) * sideways - downwards
