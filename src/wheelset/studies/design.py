"""What follows for a designer: the two critical speeds, and what moves them.

v_lin is the Hopf speed, above which straight running is unstable; v_non the speed of the first
fold of cycles (LPC), below which every disturbance dies out. Between them it depends on its size.
Not in the paper.
"""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd
from pydantic import Field

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.studies.first_fold import SECTION_5, FirstFold, first_fold
from wheelset.studies.parameters import VehicleName, WindowParameters

#: The physical reading has a curvature sum that allows 1.15 mm with the printed polynomials: its
#: cycles are computed with constant curvatures.
CONSTANT_CURVATURES = ("e1=0", "e3=0", "f1=0", "f3=0")


class Parameters(WindowParameters):
    """Parameters of the study for a designer."""

    vehicle: VehicleName = Field(
        default="guo2021",
        description="Packaged vehicle or path of a file; taken with the exponential flange and "
        "a3 = 200 m⁻², as in section 5.",
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical",
        description="The physically consistent reading, taken with constant curvatures besides.",
    )

    @property
    def readings(self) -> dict[str, tuple[str, tuple[str, ...]]]:
        """By title: the vehicle and what the study gives it."""
        return {
            "paper-consistent": (self.vehicle, SECTION_5),
            "physical": (self.vehicle_physical, (*SECTION_5, *CONSTANT_CURVATURES)),
        }


@dataclass(frozen=True, eq=False)
class Reading:
    """A vehicle with its Hopf point and its first fold of cycles; words: what is missing, why."""

    title: str
    values: dict[str, float]
    found: FirstFold

    @property
    def hopf(self) -> HopfPoint:
        """The Hopf point; only of a complete reading."""
        assert self.found.hopf is not None
        return self.found.hopf

    @property
    def fold(self) -> SpecialPoint:
        """The fold; only of a complete reading."""
        assert self.found.fold is not None
        return self.found.fold

    @property
    def cycle(self) -> Cycle:
        """The cycle at the fold; only of a complete reading."""
        cycle: Cycle = self.fold.solution
        return cycle

    @property
    def branch(self) -> Branch:
        """The cycles from the Hopf point on; only of a complete reading."""
        assert self.found.branch is not None
        return self.found.branch

    @property
    def complete(self) -> bool:
        """Whether there are both speeds."""
        return self.found.hopf is not None and self.found.fold is not None


def readings(p: Parameters) -> tuple[Reading, ...]:
    """The readings of the study with their critical speeds, where they have them."""
    loaded = {title: p.load(name, given) for title, (name, given) in p.readings.items()}
    return tuple(
        Reading(title, vehicle.values, first_fold(vehicle, p.window))
        for title, vehicle in loaded.items()
    )


def critical_speeds(found: tuple[Reading, ...]) -> pd.DataFrame:
    """One row a reading: reading, v_lin and v_non m/s, gap m/s, flc, amplitude m and frequency Hz
    of the cycle at the fold, words; None for what there is not.
    """
    return pd.DataFrame([_speeds(reading) for reading in found])


def _speeds(reading: Reading) -> dict[str, object]:
    hopf, fold, cycle = reading.found.hopf, reading.found.fold, reading.found.cycle
    v_lin = None if hopf is None else hopf.value
    v_non = None if fold is None else float(fold.values[0])
    return {
        "reading": reading.title,
        "v_lin": v_lin,
        "v_non": v_non,
        "gap": v_lin - v_non if v_lin and v_non else None,
        "flc": None if hopf is None else hopf.lyapunov,
        "amplitude": None if cycle is None else cycle.measure("amplitude y"),
        "frequency": None if cycle is None else cycle.measure("frequency"),
        "words": reading.found.words,
    }
