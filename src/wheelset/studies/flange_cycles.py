"""Section 3's limit cycles: Fig. 6, two cases under four ways to write the flange force.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 3, Fig. 6. Two readings
of "nonlinear contact parameters neglected" are computed: the packaged cases as they are, which keep
the terms of the curvatures, and the same without them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from pydantic import Field

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    cycle_from_flip,
    cycle_from_hopf,
)
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.outcomes import NoConvergence, NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.hopf_rows import first_hopf, stability_changes
from wheelset.studies.parameters import CaseParameters, VehicleName
from wheelset.vehicle import Vehicle

#: The laws in the order of Fig. 6's panels.
LAWS = ("none", "quintic", "exponential", "reciprocal")

#: The first reading: the cases as their files have them. The other one: ``flange_readings``.
AS_FILED = "as filed"

#: Speeds followed, m/s: somewhat beyond the panels of Fig. 6, where cycles may come from.
SPEEDS = {"quintic": (20.0, 70.0)}
OTHER_SPEEDS = (45.0, 70.0)

#: Steps of a branch from a Hopf point, of asymmetric cycles and of doubled ones.
STEPS = {"quick": (300, 12, 6), "paper": (600, 40, 20)}

#: Branches end at singularities of the field, where more intervals cost much and tell little.
MESH = Meshing(most=120)


class Parameters(CaseParameters):
    """Parameters of the study of section 3's limit cycles."""

    vehicle_in_full: VehicleName = Field(
        default="guo2021",
        description="Vehicle whose contact-angle terms are put back to see what they change.",
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical", description="Vehicle of the physically consistent reading."
    )


@dataclass(frozen=True, eq=False)
class Family:
    """A branch of cycles in the speed v: where it belongs and where it comes from.

    name: "H" for the cycles born at the Hopf point, "H BPC1" for asymmetric ones, "H BPC1 PD1" for
    doubled ones. hopf: speed of the Hopf point, m/s. missing: why there is no branch although its
    start is known, else empty.
    """

    reading: str
    case: int
    law: str
    name: str
    system: System
    hopf: float
    branch: Branch | None
    missing: str = ""

    @property
    def place(self) -> tuple[str, int, str]:
        """Reading, case and law."""
        return self.reading, self.case, self.law


Rows = Mapping[int, Sequence[str]]


def all_families(p: Parameters, reading: str, rows: Rows) -> tuple[Family, ...]:
    """Every family of Fig. 6's eight panels, by case and law, with a reading's changes by case."""
    return tuple(
        family
        for case in p.cases
        for law in LAWS
        for family in families_of(
            p, case_vehicle(p, case, law, rows.get(case, ())), (reading, case, law)
        )
    )


def case_vehicle(p: Parameters, case: int, law: str, rows: Sequence[str] = ()) -> Vehicle:
    """The vehicle of a case under a flange law, with further changes."""
    return p.load(p.cases[case], rows=[*rows, f"flange_law={law}"])


def families_of(p: Parameters, vehicle: Vehicle, place: tuple[str, int, str]) -> tuple[Family, ...]:
    """The cycles born at a vehicle's first Hopf point, and those they send off."""
    hopf = hopf_of(p, vehicle)
    system, window = hunting_system(vehicle), followed(hopf.value, place[2])
    how = Discretisation(mesh=MESH)
    start = cycle_from_hopf(system, hopf, window[1] - window[0], discretisation=how)
    branch = follow(
        start.problem, start.u, direction=start.tangent, windows={"v": window},
        steps=STEPS[p.resolution][0], kind="cycles",
    )  # fmt: skip
    first = Family(*place, "H", system, hopf.value, branch)
    return (first, *_offspring(first, window, STEPS[p.resolution][1:]))


def hopf_of(p: Parameters, vehicle: Vehicle) -> HopfPoint:
    """The Hopf point of lowest speed; NoConvergence where the window holds none."""
    hopf = first_hopf(stability_changes(vehicle, p.window))
    if hopf is None:
        raise NoConvergence(f"no Hopf point between {p.v_min:g} and {p.v_max:g} m/s", ())
    return hopf


def followed(hopf: float, law: str) -> tuple[float, float]:
    """Speeds to follow cycles over, m/s: the law's, widened to hold the Hopf point."""
    low, high = SPEEDS.get(law, OTHER_SPEEDS)
    return min(low, hopf - 5.0), max(high, hopf + 10.0)


def _offspring(
    parent: Family, window: tuple[float, float], steps: tuple[int, ...]
) -> Iterator[Family]:
    """What the first symmetry breaking and the first doubling of a branch send off, and what these
    send off: a generation for every number of steps.
    """
    if not steps or parent.branch is None:
        return
    for kind in ("BPC", "PD"):
        for origin in parent.branch.of_kind(kind)[:1]:
            child = _sent_off(parent, f"{parent.name} {kind}1", origin, window, steps[0])
            yield child
            yield from _offspring(child, window, steps[1:])


def _sent_off(
    parent: Family, name: str, origin: SpecialPoint, window: tuple[float, float], steps: int
) -> Family:
    branch, missing = None, ""
    try:
        branch = from_flip(parent.system, origin, window, steps)
    except NumericalOutcome as outcome:
        missing = str(outcome)
    return replace(parent, name=name, branch=branch, missing=missing)


def from_flip(
    system: System, origin: SpecialPoint, window: tuple[float, float], steps: int
) -> Branch:
    """The family sent off at a symmetry breaking or a doubling. Raises the outcome of its start."""
    width = window[1] - window[0]
    start = cycle_from_flip(system, origin.solution, "v", width, mesh=MESH)
    return follow(
        start.problem, start.u, direction=start.tangent, windows={"v": window}, steps=steps,
        kind="cycles",
    )  # fmt: skip
