"""The first fold of the cycles born at a vehicle's Hopf point: its nonlinear critical speed."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_start import cycle_from_hopf
from wheelset.bifurcation.equilibria.hopf import HopfPoint, instabilities
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.hopf_rows import first_hopf
from wheelset.vehicle import Vehicle
from wheelset.vehicle.geometry import ContactGeometry

#: What section 5 gives every vehicle: a3 where another coefficient is scanned (p. 1000), and the
#: flange law that section 3 recommends for cycles.
SECTION_5 = ("a3=200", "flange_law=exponential")

#: Typical change of the speed, m/s, for norms.
WIDTH = 10.0

#: Cycles are followed between these multiples of the Hopf speed.
BELOW, ABOVE = 0.2, 1.02

#: A period this many times that at the Hopf point: the cycle comes near to other equilibria.
SLOWED = 3.0


@dataclass(frozen=True, eq=False)
class FirstFold:
    """A vehicle's first Hopf point and the first fold of the cycles born there, as far as found.

    words: how the search ended, the reason where there is no fold. branch: the cycles followed.
    """

    system: System
    hopf: HopfPoint | None
    fold: SpecialPoint | None
    words: str
    branch: Branch | None = None

    @property
    def cycle(self) -> Cycle | None:
        """The cycle at the fold."""
        return None if self.fold is None else self.fold.solution


def first_fold(
    vehicle: Vehicle,
    window: tuple[float, float],
    contact: ContactGeometry | None = None,
    above: float = ABOVE,
) -> FirstFold:
    """Hopf point of lowest speed in a window, m/s, and the first fold along its cycles.

    contact: a geometry to use instead of the vehicle's polynomials. above: the multiple of the Hopf
    speed up to which cycles are followed.
    """
    return fold_of(hunting_system(vehicle, contact), window, above)


def fold_of(
    system: System,
    window: tuple[float, float],
    above: float = ABOVE,
    rest: ArrayLike | None = None,
) -> FirstFold:
    """The same of a system; rest: near the equilibrium (default: the origin)."""
    hopf = first_hopf(instabilities(system, "v", window, rest))
    if hopf is None:
        words = f"no Hopf point between {window[0]:g} and {window[1]:g} m/s"
        return FirstFold(system, None, None, words)
    try:
        branch = cycles(system, hopf, above)
    except NumericalOutcome as outcome:
        return FirstFold(system, hopf, None, f"no cycles: {outcome}")
    folds = branch.of_kind("LPC")
    if folds:
        return FirstFold(system, hopf, folds[0], folds[0].words, branch)
    return FirstFold(system, hopf, None, without_fold(hopf, branch), branch)


def cycles(system: System, hopf: HopfPoint, above: float = ABOVE) -> Branch:
    """The cycles born at a Hopf point, followed in speed until they leave its neighbourhood."""
    start = cycle_from_hopf(system, hopf, WIDTH)
    window = BELOW * hopf.value, above * hopf.value
    return follow(
        start.problem, start.u, direction=start.tangent, windows={"v": window}, steps=400,
        kind="cycles",
    )  # fmt: skip


def without_fold(hopf: HopfPoint, branch: Branch) -> str:
    """Why a branch of cycles has no fold: how it began and how it ended, in words."""
    begin, end = branch.points[0], branch.points[-1]
    if hopf.lyapunov is not None and hopf.lyapunov < 0 and branch.ended.kind == "window":
        return (
            "no fold of cycles: they are born stable and grow with the speed; at "
            f"{end.values[0]:.2f} m/s their amplitude is {1e3 * end.solution.measure('max y'):.2f} "
            "mm"
        )
    grown = 1e3 * end.solution.measure("max y")
    first, last = begin.solution.period, end.solution.period
    slow = ", slowing down at other equilibria" if last > SLOWED * first else ""
    return (
        f"no fold of cycles: from {begin.values[0]:.1f} to {end.values[0]:.1f} m/s the amplitude "
        f"grows to {grown:.1f} mm and the period goes from {first:.3f} to {last:.2f} s{slow}; "
        f"then {branch.ended.kind}"
    )
