"""A whole bifurcation diagram in one parameter: equilibria, the cycles born on them, and theirs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from numpy.typing import ArrayLike

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.cycles.cycle_curve import CycleCurve
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_from_flip,
    cycle_from_hopf,
)
from wheelset.bifurcation.equilibria.equilibrium_curve import equilibrium_curve
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System

#: Two Hopf points nearer than this, relative to the window, are one.
SAME = 1e-6


@dataclass(frozen=True, eq=False)
class Family:
    """A branch of cycles: its name says where it comes from, as "H1", "H1 BPC1", "H1 PD2".

    missing: why there is no branch although its start is known, else empty.
    """

    name: str
    branch: Branch | None
    missing: str = ""


@dataclass(frozen=True, eq=False)
class Diagram:
    """equilibria: one branch through the window. families: cycles, in the order they were found."""

    parameter: str
    equilibria: Branch
    families: tuple[Family, ...]

    @property
    def branches(self) -> dict[str, Branch]:
        """All branches by name, to draw or to save."""
        found = {f.name: f.branch for f in self.families if f.branch is not None}
        return {"equilibrium": self.equilibria, **found}


@dataclass(frozen=True)
class _Task:
    """A branch to follow: how it is called, what it starts from, and how deep it lies."""

    name: str
    kind: str
    origin: SpecialPoint
    depth: int


def diagram(
    system: System,
    parameter: str,
    window: tuple[float, float],
    guess: ArrayLike | None = None,
    *,
    depth: int = 2,
    steps: int = 400,
    control: StepControl | None = None,
    discretisation: Discretisation | None = None,
) -> Diagram:
    """Equilibria over a window of a parameter, the cycles from every Hopf point, and the families
    that symmetry breaking and period doubling send off.

    depth: generations of cycles (1: those born at Hopf points only). steps: at most a branch.
    A family that cannot be started is listed with the reason. The equilibrium is sought at the
    system's own value of the parameter, or in the middle of the window.
    """
    low, high = window
    if not low <= system.values[parameter] <= high:
        system = system.with_values(**{parameter: (low + high) / 2})
    equilibria = equilibrium_curve(system, parameter, window, guess)
    tasks = [_Task(f"H{i}", "H", h, 1) for i, h in enumerate(equilibria.of_kind("H"), 1)]
    families: list[Family] = []
    births: list[float] = []
    width = window[1] - window[0]
    while tasks:
        task = tasks.pop(0)
        value = float(task.origin.values[0])
        if task.kind == "H" and any(abs(value - b) < SAME * width for b in births):
            continue  # a branch from another Hopf point ended here
        family = _family(system, parameter, window, task, steps, control, discretisation)
        families.append(family)
        if family.branch is not None:
            births += [float(h.values[0]) for h in family.branch.of_kind("H")]
            tasks += list(_offspring(task, family.branch, depth))
    return Diagram(parameter, equilibria, tuple(families))


def _offspring(task: _Task, branch: Branch, depth: int) -> Iterator[_Task]:
    """What a branch sends off: asymmetric cycles of a symmetric family, doubled cycles."""
    if task.depth >= depth:
        return
    for kind in ("BPC", "PD"):
        flips = [s for s in branch.of_kind(kind) if kind == "PD" or s.solution.symmetric]
        for number, origin in enumerate(flips, 1):
            yield _Task(f"{task.name} {kind}{number}", kind, origin, task.depth + 1)


def _family(
    system: System,
    parameter: str,
    window: tuple[float, float],
    task: _Task,
    steps: int,
    control: StepControl | None,
    discretisation: Discretisation | None,
) -> Family:
    width = window[1] - window[0]
    try:
        start = _start(system, parameter, task, width, discretisation)
    except NumericalOutcome as outcome:
        return Family(task.name, None, str(outcome))
    branch = follow(
        start.problem, start.u, direction=start.tangent, windows={parameter: window},
        control=control, steps=steps, kind="cycles",
    )  # fmt: skip
    return Family(task.name, branch)


def _start(
    system: System, parameter: str, task: _Task, width: float, how: Discretisation | None
) -> Start[CycleCurve]:
    if task.kind != "H":
        mesh = (how or Discretisation()).mesh
        return cycle_from_flip(system, task.origin.solution, parameter, width, mesh=mesh)
    value, state = float(task.origin.values[0]), task.origin.solution.state
    frequency = task.origin.coefficients["frequency"]
    hopf = hopf_point(system, parameter, value, frequency, state)
    return cycle_from_hopf(system, hopf, width, discretisation=how)
