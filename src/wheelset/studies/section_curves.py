"""What the scans of sections 4 and 5 have in common: vehicles, panels, Hopf curves.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, Figs 7 and 8.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.equilibria.hopf import HopfPoint, hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve
from wheelset.bifurcation.system import System
from wheelset.studies.parameters import VehicleName, WindowParameters

Array = NDArray[np.float64]
Window = tuple[float, float]

#: Speeds between which curves are followed, m/s.
SPEEDS: Window = (1.0, 1000.0)

#: How a Hopf curve is walked: the longest step, as a part of the windows' widths.
LONGEST = {"quick": 0.05, "paper": 0.02}

#: Left beyond a start that lies outside a window, as a part of the window's width.
ROOM = 0.01

#: Rounding of a window's bound, as a part of its width.
EDGE = 1e-9


class ReadingsParameters(WindowParameters):
    """Parameters of a study that carries three readings of the unprinted values."""

    vehicle: VehicleName = Field(
        default="guo2021", description="Name of a packaged vehicle or path of a vehicle file."
    )
    vehicle_second: VehicleName = Field(
        default="guo2021_m2", description="A second reading of what the paper does not print."
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical", description="The physically consistent reading."
    )

    @property
    def readings(self) -> tuple[str, ...]:
        """The vehicles of the page, each once."""
        return tuple(dict.fromkeys((self.vehicle, self.vehicle_second, self.vehicle_physical)))

    @property
    def control(self) -> StepControl:
        """How Hopf curves are walked."""
        return StepControl(first=1e-3, most=LONGEST[self.resolution])


@dataclass(frozen=True)
class Scan:
    """A panel: its letter, the coefficient scanned, the window drawn and the one searched, SI."""

    panel: str
    parameter: str
    window: Window
    searched: Window

    def around(self, value: float, searched: bool = True) -> Window:
        """The window, made wide enough to have a start that lies outside within it."""
        low, high = self.searched if searched else self.window
        room = ROOM * (high - low)
        return min(low, value - room), max(high, value + room)

    def shows(self, value: float) -> bool:
        """Whether the panel does."""
        return self.window[0] <= value <= self.window[1]


def hopf_branch(
    system: System, hopf: HopfPoint, parameter: str, window: Window, control: StepControl
) -> Branch:
    """The Hopf point followed over a window of a coefficient, both ways, at 1 to 1000 m/s."""
    windows = {"v": SPEEDS, parameter: window}
    free = (hopf.parameter, parameter)
    return hopf_curve(system, hopf, free, windows, control=control, steps=2000)


def hopf_at(system: System, branch: Branch, value: float) -> HopfPoint | None:
    """The Hopf point at a value of the scanned coefficient; None beyond the curve's ends.

    Where the curve has several, the one nearest to the walk's start.
    """
    names, at = branch.parameters, branch.values[:, 1]
    if not reached(value, at):
        return None
    value = min(max(value, float(at.min())), float(at.max()))
    crossing = (at[:-1] - value) * (at[1:] - value) <= 0
    lengths = np.array([abs(point.arclength) for point in branch.points])
    i = int(np.flatnonzero(crossing)[np.argmin(lengths[:-1][crossing])])
    part = (value - at[i]) / (at[i + 1] - at[i]) if at[i + 1] != at[i] else 0.0
    speed = float(branch.values[i, 0] + part * (branch.values[i + 1, 0] - branch.values[i, 0]))
    near = branch.points[i + round(part)].solution
    there = system.with_values(**{names[1]: value})
    return hopf_point(there, names[0], speed, near.frequency, near.state)


def reached(value: float, at: Array) -> bool:
    """Whether a curve with points at these values of its coefficient has one at that value."""
    return max(at.min() - value, value - at.max()) <= EDGE * float(np.ptp(at))
