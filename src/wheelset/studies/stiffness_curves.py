"""Section 6: the suspension stiffness that keeps a critical speed at 70 m/s, Fig. 11.

At a fixed speed the Hopf point is continued in the longitudinal and lateral stiffness Kpx and Kpy:
above the curve straight running is stable at that speed. The cycles born on the curve are followed
in Kpx; where they turn, a fold of cycles, is continued in the same two: it is the curve for the
nonlinear critical speed, above which these cycles do not exist below the flange's contact.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 6, Fig. 11.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from pydantic import Field

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle_start import cycle_from_hopf
from wheelset.bifurcation.equilibria.hopf import HopfPoint, instabilities
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.profiles import Contact, SplineGeometry
from wheelset.studies.on_profiles import reach_of
from wheelset.studies.parameters import Speed
from wheelset.studies.section_curves import LONGEST
from wheelset.studies.worn_profiles import AT_THE_FLANGE, Law, WearParameters
from wheelset.vehicle import Vehicle
from wheelset.vehicle.geometry import ContactGeometry, ExpandedGeometry

STIFFNESSES = ("Kpx", "Kpy")

#: Fig. 11's axes, N/m, and how far curves are followed beyond them.
PANEL = {"Kpx": (0.0, 1.5e6), "Kpy": (0.0, 3e6)}
FOLLOWED = {"Kpx": (1.0, 6e6), "Kpy": (1.0, 6e6)}

#: Lateral stiffnesses at which a first point is sought, N/m, and a typical change of a stiffness.
TRIED, CHANGE = (1e6, 0.2e6, 2.5e6), 1e6

#: Cycles are followed down to this part of the stiffness at the Hopf point: those that need more
#: than it are sought.
DOWN_TO = 0.6


class Parameters(WearParameters):
    """Parameters of the study of Fig. 11."""

    speed: Speed = Field(default=70.0, description="The critical speed to be kept, m/s.")
    law_second: Law = Field(default="usfd", description="A second wear law, for comparison.")


@dataclass(frozen=True, eq=False)
class StiffnessCurves:
    """The curves of one mileage: of Hopf points and of folds; None where ``words`` say why.

    system: at the fixed speed. cycles: those followed in Kpx from the Hopf curve.
    """

    mileage: float
    system: System
    hopf: Branch | None
    folds: Branch | None
    cycles: Branch | None
    words: str
    fold_words: str


def stiffness_curves(
    p: Parameters, contacts: Mapping[float, Contact]
) -> tuple[StiffnessCurves, ...]:
    """Fig. 11's curves by mileage, and those of folds."""
    vehicle = p.load(p.vehicle)
    return tuple(_on_contact(p, vehicle, m, contact) for m, contact in contacts.items())


def _on_contact(
    p: Parameters, vehicle: Vehicle, mileage: float, contact: Contact
) -> StiffnessCurves:
    splines = SplineGeometry.of(contact, reach_of(contact), p.width)
    geometry = ExpandedGeometry(splines.functions, splines.reach)
    return curves_of(p, vehicle, mileage, geometry)


def curves_of(
    p: Parameters,
    vehicle: Vehicle,
    mileage: float,
    geometry: ContactGeometry | None,
    largest: float = AT_THE_FLANGE,
) -> StiffnessCurves:
    """The curves of a vehicle on a geometry (default: its own polynomials).

    largest: amplitude of the folds that count, m.
    """
    system = hunting_system(vehicle, geometry).with_values(v=p.speed)
    found = first_point(system)
    if found is None:
        return StiffnessCurves(mileage, system, None, None, None, _without(p, system), "no cycles")
    at, hopf = found
    curve = hopf_stiffness(at, hopf, LONGEST[p.resolution])
    cycles, folds, words = _folds(at, hopf, largest)
    return StiffnessCurves(mileage, at, curve, folds, cycles, "", words)


def first_point(system: System) -> tuple[System, HopfPoint] | None:
    """The Hopf point of largest Kpx for the first lateral stiffness that has one."""
    for lateral in TRIED:
        at = system.with_values(Kpy=lateral)
        points = [q for q in instabilities(at, "Kpx", FOLLOWED["Kpx"]) if isinstance(q, HopfPoint)]
        if points:
            return at, points[-1]
    return None


def hopf_stiffness(system: System, hopf: HopfPoint, longest: float = LONGEST["paper"]) -> Branch:
    """The Hopf points in both stiffnesses, at the system's speed.

    longest: a step, as a part of the windows.
    """
    control = StepControl(first=1e-3, most=longest)
    return hopf_curve(system, hopf, STIFFNESSES, FOLLOWED, control=control, steps=2000)


def _without(p: Parameters, system: System) -> str:
    """Why no stiffness keeps the speed: straight running is stable, or unstable, at all tried."""
    soft = system.with_values(**{name: low for name, (low, _) in FOLLOWED.items()})
    growth = np.linalg.eigvals(soft.jacobian(np.zeros(system.n))).real.max()
    word = "unstable at any of them" if growth > 0 else "stable even without a suspension"
    return f"no stiffness has its Hopf point at {p.speed:g} m/s: straight running is {word}"


# --- folds ----------------------------------------------------------------------------------------


def _folds(
    system: System, hopf: HopfPoint, largest: float
) -> tuple[Branch | None, Branch | None, str]:
    """The cycles in Kpx, and the curve of their fold of largest Kpx, or why there is none."""
    window = DOWN_TO * hopf.value, FOLLOWED["Kpx"][1]
    try:
        start = cycle_from_hopf(system, hopf, CHANGE)
        cycles = follow(
            start.problem, start.u, direction=start.tangent, windows={"Kpx": window},
            steps=400, kind="cycles",
        )  # fmt: skip
    except NumericalOutcome as outcome:
        return None, None, f"no cycles: {outcome}"
    fold = last_fold(cycles, largest)
    if fold is None:
        return cycles, None, _without_fold(cycles)
    try:
        return cycles, _fold_curve(system, fold), ""
    except NumericalOutcome as outcome:
        return cycles, None, f"the fold could not be followed: {outcome}"


def last_fold(cycles: Branch, largest: float = AT_THE_FLANGE) -> SpecialPoint | None:
    """The fold that needs most stiffness among those of cycles below an amplitude [m]."""
    folds = [f for f in cycles.of_kind("LPC") if f.solution.measure("amplitude y") < largest]
    return max(folds, key=lambda fold: float(fold.values[0]), default=None)


def _fold_curve(system: System, fold: SpecialPoint) -> Branch:
    start = lpc_from_cycle(system, fold.solution, STIFFNESSES, (CHANGE, CHANGE))
    return both_ways(
        start.problem, start.u, direction=start.tangent, windows=FOLLOWED, steps=400,
        kind="folds of cycles",
    )  # fmt: skip


def _without_fold(cycles: Branch) -> str:
    end = cycles.points[-1]
    grown = 1e3 * end.solution.measure("amplitude y")
    return (
        f"no fold: the cycles reach {grown:.1f} mm at Kpx = {end.values[0] / 1e6:.2f} MN/m; "
        f"{cycles.ended.words}"
    )
