"""A vehicle on wheel and rail profiles: critical speeds and cycles with the contact as searched.

Nothing is fitted by a polynomial: the contact's functions of y are averaged over a stated width and
go into the model as splines, with all their derivatives. A jump of the contact inside that range
becomes a steep passage of that width; in truth, too, the load moves from one place to the other
over some way. Small cycles do not see it, large ones pass it; what a fold there owes to the width
is told by the fold at another one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.profiles import Contact, Profile, Setup, SplineGeometry, contact_geometry
from wheelset.profiles.geometry import WIDTH, FittedGeometry
from wheelset.studies.first_fold import FirstFold, first_fold
from wheelset.vehicle import Vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

#: Half the displacements searched, and how far short of their ends the geometry is used, m.
SEARCHED, MARGIN = 0.010, 1e-4

#: Cycles are followed up to this multiple of the Hopf speed: worn profiles bend branches both ways.
ABOVE = 1.2


@dataclass(frozen=True, eq=False)
class OnProfiles:
    """A vehicle on profiles: the contact, the functions the model got, and what they lead to."""

    vehicle: Vehicle
    contact: Contact
    geometry: FittedGeometry
    found: FirstFold

    @property
    def hopf(self) -> HopfPoint | None:
        """Where straight running loses its stability, if it does in the window."""
        return self.found.hopf

    @property
    def branch(self) -> Branch | None:
        """The cycles born there."""
        return self.found.branch

    @property
    def folds(self) -> tuple[SpecialPoint, ...]:
        """All folds of these cycles, from the small ones on."""
        return () if self.branch is None else self.branch.of_kind("LPC")


@dataclass(frozen=True)
class LowestCycle:
    """The cycle of lowest speed on a branch: the nonlinear critical speed, m/s, its amplitude, m.

    bound: whether the branch was still falling where it ended, so that the speed is only a bound
    from above. words: how the branch ended then.
    """

    v: float
    amplitude: float
    bound: bool
    words: str


def on_track(vehicle: Vehicle, track: Setup | None = None) -> Setup:
    """A track for a vehicle's wheelset: its rolling radius and the distance of its contacts."""
    return replace(track or Setup(), r0=vehicle.values["r0"], base=2 * vehicle.values["b"])


def searched(
    wheel: Profile,
    rail: Profile,
    vehicle: Vehicle,
    track: Setup | None = None,
    *,
    wheel_right: Profile | None = None,
    rail_right: Profile | None = None,
) -> Contact:
    """The contact of a vehicle's wheelset at -10..10 mm every 0.05 mm, as far as it goes."""
    y = np.linspace(-SEARCHED, SEARCHED, 401)
    return contact_geometry(
        wheel, rail, on_track(vehicle, track), y,
        wheel_right=wheel_right, rail_right=rail_right, trim=True,
    )  # fmt: skip


def on_profiles(
    vehicle: Vehicle, contact: Contact, window: tuple[float, float], width: float = WIDTH
) -> OnProfiles:
    """Hopf point of lowest speed in a window, m/s, and the cycles born there.

    width: standard deviation of the average, m.
    """
    geometry = SplineGeometry.of(contact, reach_of(contact), width)
    return on_geometry(vehicle, contact, geometry, window)


def on_geometry(
    vehicle: Vehicle, contact: Contact, geometry: FittedGeometry, window: tuple[float, float]
) -> OnProfiles:
    """The same with any functions fitted to the contact."""
    functions = ExpandedGeometry(geometry.functions, geometry.reach)
    return OnProfiles(vehicle, contact, geometry, first_fold(vehicle, window, functions, ABOVE))


def reach_of(contact: Contact) -> float:
    """The largest |y| [m] at which a contact's functions are used."""
    return min(-float(contact.y[0]), float(contact.y[-1])) - MARGIN


def lowest_cycle(run: OnProfiles) -> LowestCycle | None:
    """The lowest speed at which a cycle born at the Hopf point exists, at most the Hopf speed."""
    if run.branch is None or run.hopf is None:
        return None
    v, amplitude = cycle_table(run)[["v", "amplitude"]].to_numpy(float).T
    low = int(v.argmin())
    bound = low == len(v) - 1 and v[-1] < v[0]
    words = run.branch.ended.words if bound else ""
    return LowestCycle(float(v[low]), float(amplitude[low]), bool(bound), words)


def cycle_table(run: OnProfiles) -> pd.DataFrame:
    """One row a cycle: v m/s, amplitude m, period s, unstable, point ("LPC", ...)."""
    if run.branch is None:
        return pd.DataFrame(columns=["v", "amplitude", "period", "unstable", "point"])
    table = run.branch.table(["amplitude y", "period"])
    return table.rename(columns={"amplitude y": "amplitude"})


def speed_of_amplitude(run: OnProfiles, amplitudes: ArrayLike) -> NDArray[np.float64]:
    """Speeds [m/s] of the cycles of given amplitudes [m]; NaN where the branch has none.

    Amplitudes grow along these branches; where one is met twice the first counts.
    """
    table = cycle_table(run)
    grown = np.maximum.accumulate(table["amplitude"].to_numpy(float))
    first = np.concatenate([[True], np.diff(grown) > 0]) if len(grown) else np.array([], bool)
    v = table["v"].to_numpy(float)
    asked = np.asarray(amplitudes, float)
    if not first.any():
        return np.full(asked.shape, np.nan)
    return np.interp(asked, grown[first], v[first], left=v[0], right=np.nan)


def speeds_row(run: OnProfiles) -> dict[str, object]:
    """v_lin m/s, flc 1/s, frequency Hz; v_fold m/s, fold_amplitude m of the first fold; v_non m/s,
    amplitude m of the slowest cycle, bound; words: why there is no fold, else "". None for what
    there is not.
    """
    hopf, lowest = run.hopf, lowest_cycle(run)
    fold = run.folds[0] if run.folds else None
    return {
        "v_lin": None if hopf is None else hopf.value,
        "flc": None if hopf is None else hopf.lyapunov,
        "frequency": None if hopf is None else hopf.frequency / (2 * np.pi),
        "v_fold": None if fold is None else float(fold.values[0]),
        "fold_amplitude": None if fold is None else fold.solution.measure("amplitude y"),
        "v_non": None if lowest is None else lowest.v,
        "amplitude": None if lowest is None else lowest.amplitude,
        "bound": None if lowest is None else lowest.bound,
        "words": "" if fold else run.found.words,
    }
