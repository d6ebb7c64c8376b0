"""Wear laws: what a particle of the wheel loses while it slides through the contact.

A law gives the depth removed per distance rolled, m/m, from pressure p [Pa], traction tau [Pa],
slip s (sliding over rolling speed) and rolling speed V [m/s]; over the length of a strip
it adds up to the depth of a pass. Coefficients are the published ones, of dry steel in a
laboratory; a calibration multiplies them by one factor.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Protocol

import numpy as np

from wheelset.wear.patch import Array

#: Density of steel, kg/m3, and 1 ug/(m mm2) in kg/m3.
DENSITY, MICROGRAM = 7850.0, 1e-3


class WearLaw(Protocol):
    """Depth per distance rolled."""

    @property
    def name(self) -> str:
        """The word by which it is chosen."""
        ...

    def rate(self, p: Array, tau: Array, s: Array, V: float) -> Array:
        """Depth removed per distance rolled, m/m; arrays of one shape."""
        ...


@dataclass(frozen=True)
class ArchardKTH:
    """Archard's law ``dz = k (p/H) ds`` with the map of KTH for k by sliding speed and pressure.

    Jendel, Wear 253 (2002) 89-99; Enblom & Berg. Mild below 0.2 m/s and above 0.7 m/s (1 to
    10e-4), severe between (30 to 40e-4), seizure at p > 0.8 H (300 to 400e-4). Each k is the middle
    of its band. H: hardness of a wheel, Pa (assumed 2.7e9, about 270 HB).
    """

    mild: float = 5e-4
    severe: float = 35e-4
    fast: float = 5e-4
    seizure: float = 350e-4
    slow_limit: float = 0.2
    fast_limit: float = 0.7
    pressure_limit: float = 0.8
    H: float = 2.7e9

    @property
    def name(self) -> str:
        """The word by which it is chosen."""
        return "archard_kth"

    def k(self, p: Array, sliding: Array) -> Array:
        """The map: k at a pressure [Pa] and a sliding speed [m/s]."""
        slow = np.where(sliding < self.slow_limit, self.mild, self.severe)
        by_speed = np.where(sliding > self.fast_limit, self.fast, slow)
        return np.where(p > self.pressure_limit * self.H, self.seizure, by_speed)

    def rate(self, p: Array, tau: Array, s: Array, V: float) -> Array:
        """k p s / H."""
        return self.k(p, s * V) * p * s / self.H


@dataclass(frozen=True)
class USFD:
    """Sheffield's law: mass lost per distance rolled and area, from T-gamma/A = tau s [N/mm2].

    Lewis & Dwyer-Joyce (2004); Braghin et al., Wear 261 (2006) 1253-1264; used locally:

        K = 5.3 x             x <= 10.4
        K = 5.3 10.4 (55)     10.4 < x <= 77.2
        K = 55 + 61.9 (x - 77.2)

    in ug/m/mm2, depth = K/density. Printed as ``61.9 x - 4778.7``, the last regime begins at zero:
    4778.7 = 61.9 * 77.2 leaves the 55 out; here it is added, so that K is continuous.
    """

    mild: float = 5.3
    catastrophic: float = 61.9
    first_limit: float = 10.4
    second_limit: float = 77.2
    density: float = DENSITY

    @property
    def name(self) -> str:
        """The word by which it is chosen."""
        return "usfd"

    def K(self, x: Array) -> Array:
        """ug/m/mm2 at x = T-gamma/A [N/mm2]."""
        beyond = np.maximum(x - self.second_limit, 0.0)
        return self.mild * np.minimum(x, self.first_limit) + self.catastrophic * beyond

    def rate(self, p: Array, tau: Array, s: Array, V: float) -> Array:
        """K(tau s)/density."""
        return self.K(tau * s * 1e-6) * MICROGRAM / self.density


@dataclass(frozen=True)
class Zobory:
    """Zobory's law: mass lost per energy, in two regimes of the power tau s V [W/m2].

    Zobory, Vehicle System Dynamics 28 (1997) 221-259: k = 7e-10 kg/J up to 4e6 W/m2 and 21e-10
    beyond; depth = k tau s / density.
    """

    mild: float = 7e-10
    severe: float = 21e-10
    limit: float = 4e6
    density: float = DENSITY

    @property
    def name(self) -> str:
        """The word by which it is chosen."""
        return "zobory"

    def rate(self, p: Array, tau: Array, s: Array, V: float) -> Array:
        """k tau s / density."""
        k = np.where(tau * s * V > self.limit, self.severe, self.mild)
        return k * tau * s / self.density


#: All laws by name. A new law is its equation and a word here.
WEAR_LAWS: Mapping[str, WearLaw] = MappingProxyType(
    {law.name: law for law in (ArchardKTH(), USFD(), Zobory())}
)


def wear_law(name: str) -> WearLaw:
    """The law of that name; ValueError otherwise."""
    if name not in WEAR_LAWS:
        raise ValueError(f'law "{name}" is unknown; choose one of {", ".join(WEAR_LAWS)}')
    return WEAR_LAWS[name]


def coefficients(law: WearLaw) -> dict[str, float]:
    """The numbers of a law by name."""
    return {f.name: getattr(law, f.name) for f in fields(law)}  # type: ignore[arg-type]
