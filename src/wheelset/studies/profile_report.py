"""What there is to report on a vehicle on profiles: contact, conicity, critical speeds, cycles.

Wheels that differ left and right do not rest in the middle of the track: where they rest is sought
first, and the speeds are those of that equilibrium.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.equilibria.equilibrium import equilibrium
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.profiles import Contact, SplineGeometry
from wheelset.profiles.conicity import ConicityTable, conicity_table
from wheelset.studies.first_fold import fold_of
from wheelset.studies.on_profiles import ABOVE, OnProfiles, cycle_table, reach_of, speeds_row
from wheelset.vehicle import Vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

#: Widths of the average beside the one asked for, in parts of it.
WIDTHS = (0.6, 1.0, 2.0)

#: Starts from which equilibria are sought, over the displacements with known contacts.
STARTS = 9

#: Contacts have to be known so far from the middle for functions of y, m.
LEAST = 5e-4

#: Equilibria closer than this in y are one, m.
SAME = 1e-7

Progress = Callable[[str], None]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Speeds:
    """Critical speeds with one width [m] of the average.

    run: None where nothing could be computed. rest: y, m, of the equilibrium nearest to the middle;
    others: further ones. stable: whether it is at the window's ends. words: how it ended.
    """

    width: float
    run: OnProfiles | None
    rest: float
    others: tuple[float, ...]
    stable: tuple[bool, bool]
    words: str

    @property
    def branch(self) -> Branch | None:
        """The cycles born at the Hopf point."""
        return None if self.run is None else self.run.branch


@dataclass(frozen=True, eq=False)
class ProfileReport:
    """All there is to report; ``speeds`` by width, those of the width asked for by ``chosen``."""

    vehicle: Vehicle
    contact: Contact
    window: tuple[float, float]
    width: float
    conicity: ConicityTable
    speeds: tuple[Speeds, ...]

    @property
    def chosen(self) -> Speeds:
        """With the width asked for."""
        return min(self.speeds, key=lambda s: abs(s.width - self.width))

    @property
    def symmetric(self) -> bool:
        """Whether left and right are alike."""
        return all(left is right for left, right in (self.contact.wheels, self.contact.rails))


def profile_report(
    vehicle: Vehicle,
    contact: Contact,
    amplitudes: list[float],
    window: tuple[float, float],
    width: float,
    progress: Progress = lambda words: None,
) -> ProfileReport:
    """Conicities at amplitudes [m]; speeds in a window, m/s, at three widths of the average [m]."""
    conicity = conicity_table(contact, amplitudes)
    speeds = []
    for part in WIDTHS:
        found = critical_speeds(vehicle, contact, window, part * width)
        progress(f"averaged over {part * width * 1e3:g} mm: {found.words}")
        speeds.append(found)
    return ProfileReport(vehicle, contact, window, width, conicity, tuple(speeds))


def critical_speeds(
    vehicle: Vehicle, contact: Contact, window: tuple[float, float], width: float
) -> Speeds:
    """The Hopf point of lowest speed and its cycles, from where the wheelset rests."""
    reach = reach_of(contact)
    if reach < LEAST:
        words = f"the contact is known up to {max(reach, 0) * 1e3:.2f} mm from the middle only"
        return Speeds(width, None, 0.0, (), (False, False), words)
    geometry = SplineGeometry.of(contact, reach, width)
    functions = ExpandedGeometry(geometry.functions, geometry.reach)
    system = hunting_system(vehicle, functions)
    rests = equilibria(system, window[0], reach)
    if not len(rests):
        words = "the wheelset rests nowhere between the last displacements with a known contact"
        return Speeds(width, None, 0.0, (), (False, False), words)
    stable = (_stable(system, rests[0], window[0]), _stable(system, rests[0], window[1]))
    try:
        found = fold_of(system, window, ABOVE, rests[0])
    except NumericalOutcome as outcome:
        return Speeds(width, None, float(rests[0, 0]), (), stable, f"no stability: {outcome}")
    run = OnProfiles(vehicle, contact, geometry, found)
    others = tuple(float(y) for y in rests[1:, 0])
    return Speeds(width, run, float(rests[0, 0]), others, stable, found.words)


def equilibria(system: System, v: float, reach: float) -> Array:
    """Where the wheelset can rest, (k, 4), the one nearest to the middle first."""
    p, found = system.p(v=v), [np.zeros((0, system.n))]
    for y in sorted(np.linspace(-reach, reach, STARTS), key=abs):
        try:
            state, _ = equilibrium(system, p, [y, 0.0, 0.0, 0.0])
        except NumericalOutcome:
            continue  # another start finds it, or nobody does
        known = np.concatenate(found)[:, 0]
        if abs(state[0]) < reach and not np.any(abs(known - state[0]) < SAME):
            found.append(state[np.newaxis])
    rests = np.concatenate(found)
    return rests[abs(rests[:, 0]).argsort()]


def _stable(system: System, state: Array, v: float) -> bool:
    return bool(np.linalg.eigvals(system.jacobian(state, system.p(v=v))).real.max() < 0)


def speeds_table(report: ProfileReport) -> pd.DataFrame:
    """A row a width [m]: rest m, kind of the Hopf point, and ``speeds_row``'s columns, SI units."""
    return pd.DataFrame([_row(speeds) for speeds in report.speeds])


def _row(speeds: Speeds) -> dict[str, object]:
    known = {} if speeds.run is None else speeds_row(speeds.run)
    hopf = None if speeds.run is None else speeds.run.hopf
    kind = None if hopf is None else hopf.kind
    return {
        "width": speeds.width,
        "rest": speeds.rest,
        "kind": kind,
        **known,
        "words": speeds.words,
    }


def cycles_table(report: ProfileReport) -> pd.DataFrame:
    """All cycles: width m, v m/s, amplitude m, period s, unstable, point."""
    tables = [
        cycle_table(s.run).assign(width=s.width) for s in report.speeds if s.run and s.run.branch
    ]
    if not tables:
        return pd.DataFrame(columns=["width", "v", "amplitude", "period", "unstable", "point"])
    return pd.concat(tables, ignore_index=True)
