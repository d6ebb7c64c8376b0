"""Speed of the contact search beside the straightforward one, in one run, and what they differ by.

The peer does for each displacement what a textbook says: it takes the gap on a fine grid of the
wheel, its least value, a parabola through the three lowest points, and finds the roll by scipy's
``brentq``. Run with ``make bench``; the result is printed and stored in ``benchmarks/results``.
"""

from __future__ import annotations

import json
import statistics
from pathlib import Path
from time import perf_counter

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from wheelset.profiles import Profile, Setup, contact_geometry, packaged, profile_from_points

RESULTS = Path(__file__).parent / "results" / "profiles.json"

#: Displacements, m; every how many the peer does; its grid, m; rounds.
Y, EVERY, GRID, ROUNDS = np.linspace(-0.010, 0.010, 401), 10, 2e-5, 7

#: Beside a jump a grid may take the other contact: displacements left out of the comparison, m.
BESIDE = 1e-4


class Peer:
    """A wheelset on a track, each displacement by itself."""

    def __init__(self, wheel: Profile, rail: Profile, setup: Setup) -> None:
        laid = setup.laid(rail)
        self.r0, self.out, self.at = setup.r0, setup.wheel_at, setup.rail_at(laid)
        low, high = wheel.domain
        self.u = np.arange(low + GRID, high, GRID)
        self.z = wheel.z(self.u)
        points = np.arange(laid.domain[0] + GRID, laid.domain[1], GRID)
        self.rail = CubicSpline(points, laid.z(points), extrapolate=False)

    def lowest(self, s: int, y: float, roll: float) -> tuple[float, float]:
        """Height at which a wheel touches, and the place on it."""
        u, z = self.u, self.z
        across = (self.out + u) * np.cos(roll) + s * z * np.sin(roll) + s * y
        gap = self.rail(across - self.at) - z * np.cos(roll) + s * (self.out + u) * np.sin(roll)
        k = int(np.nanargmin(gap))
        a, b, c = gap[k - 1 : k + 2]
        shift = 0.5 * (a - c) / (a - 2 * b + c)
        return float(b - 0.25 * (a - c) * shift), float(u[k] + shift * GRID)

    def settle(self, y: float) -> tuple[float, float]:
        """Places of contact on the left and the right wheel."""

        def uneven(roll: float) -> float:
            return self.lowest(1, y, roll)[0] - self.lowest(-1, y, roll)[0]

        roll = brentq(uneven, -0.02, 0.02, xtol=1e-10)
        return self.lowest(1, y, roll)[1], self.lowest(-1, y, roll)[1]


def measure(wheel: Profile, rail: Profile) -> dict[str, float]:
    """Times of 401 displacements and the largest difference of the rolling radius difference."""
    setup, some = Setup(), Y[::EVERY]
    peer = Peer(wheel, rail, setup)
    contact_geometry(wheel, rail, setup, Y)
    ours, theirs = [], []
    for _ in range(ROUNDS):
        start = perf_counter()
        contact = contact_geometry(wheel, rail, setup, Y)
        middle = perf_counter()
        places = np.array([peer.settle(float(y)) for y in some])
        ours.append(middle - start)
        theirs.append((perf_counter() - middle) * EVERY)
    jumps = np.array([jump.y for jump in contact.jumps])
    clear = [not len(jumps) or abs(jumps - y).min() > BESIDE for y in some]
    dr = wheel.z(places[:, 0]) - wheel.z(places[:, 1])
    off = abs(dr - np.interp(some, contact.y, contact.dr))[clear]
    return {
        "ours_ms": 1e3 * statistics.median(ours),
        "straightforward_ms": 1e3 * statistics.median(theirs),
        "times_faster": statistics.median(t / o for t, o in zip(theirs, ours, strict=True)),
        "jumps": len(jumps),
        "largest_difference_um": 1e6 * float(off.max()),
    }


def measured_again(name: str) -> Profile:
    """A packaged wheel through points every 0.2 mm, as a file would give it."""
    y, z = packaged(name).points(2e-4)
    return profile_from_points(name, "wheel", y, z)


def main() -> None:
    """Formulas, splines through points, a pair that jumps."""
    rail = packaged("CHN60")
    pairs = {
        "LMB10 on CHN60": (packaged("LMB10"), rail),
        "LMB10 through points on CHN60": (measured_again("LMB10"), rail),
        "S1002 on 60E1": (packaged("S1002"), packaged("60E1")),
    }
    result = {name: measure(*pair) for name, pair in pairs.items()}
    RESULTS.write_text(json.dumps(result, indent=1) + "\n", "utf-8")
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
