"""Where curves of critical cycles come from: a special point of a branch, or a generalised Hopf."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending, SpecialPoint
from wheelset.bifurcation.cycles.critical_curve import GH_END, CriticalCurve
from wheelset.bifurcation.cycles.critical_points import SMALL
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import MESHING, Anchor, CycleCurve, Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_at_hopf,
    known,
    last_unknown,
    mode_at,
    onto,
)
from wheelset.bifurcation.equilibria.hopf import HopfPoint, hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import GHPoint, gh_point
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: Halvings of the first cycle's size from which a curve is started at a generalised Hopf point.
TRIALS = 6


def lpc_from_cycle(
    system: System,
    cycle: Cycle,
    parameters: tuple[str, str],
    widths: tuple[float | None, float | None] = (None, None),
    mesh: Meshing = MESHING,
) -> Start[CriticalCurve]:
    """The curve of folds through the cycle of an LPC; sets out towards larger second parameters.

    widths: typical changes of the parameters, for norms (default: their values).
    """
    return _critical(*known(system, cycle, parameters, widths, mesh), flip=False)


def pd_from_cycle(
    system: System,
    cycle: Cycle,
    parameters: tuple[str, str],
    widths: tuple[float | None, float | None] = (None, None),
    mesh: Meshing = MESHING,
) -> Start[CriticalCurve]:
    """The curve of flips through the cycle of a PD, or of a symmetry-breaking BPC that was computed
    on half a period; sets out towards larger second parameters.
    """
    return _critical(*known(system, cycle, parameters, widths, mesh), flip=True)


def _critical(cycles: CycleCurve, u: Array, flip: bool) -> Start[CriticalCurve]:
    return onto(bordered(cycles, u, flip), u, last_unknown(u))


def bordered(cycles: CycleCurve, u: Array, flip: bool) -> CriticalCurve:
    """The augmented problem with its phase reference at u and borders fitted there."""
    anchored = replace(cycles, anchor=Anchor.at(cycles.space, u))
    return CriticalCurve(anchored, mode_at(anchored, u, flip)[1])


def lpc_from_gh(
    system: System,
    gh: GHPoint,
    widths: tuple[float, float] | None = None,
    size: float = 0.1,
    discretisation: Discretisation | None = None,
) -> Start[CriticalCurve]:
    """The curve of folds that ends at a generalised Hopf point, towards larger cycles.

    In the normal form r' = r (Re l + FLC r^2 + SLC r^4) the fold has r^2 = -FLC / (2 SLC) and
    Re l = FLC^2 / (4 SLC); the cycle is u = 2 r Re(q e^(iwt)). size: of the first cycle, in the
    norm of the state's scales; halved where Newton's method does not converge from it.
    """
    for trial in range(TRIALS):
        try:
            return _from_gh(system, gh, widths, size / 2**trial, discretisation)
        except NoConvergence as outcome:
            failure = outcome
    raise failure


def _from_gh(
    system: System,
    gh: GHPoint,
    widths: tuple[float, float] | None,
    size: float,
    discretisation: Discretisation | None,
) -> Start[CriticalCurve]:
    first, other = gh.parameters
    width, other_width = widths or tuple(abs(v) or 1.0 for v in gh.values)
    there = system.with_values(**dict(zip(gh.parameters, gh.values, strict=True)))
    start = cycle_at_hopf(there, _hopf(there, gh, gh.values[1]), width, discretisation)
    space = replace(start.problem.space, free=(first, other))
    sizes = np.append(start.problem.sizes, other_width)
    radius = size * _radius(start, gh)
    value = _with_coefficient(there, gh, -2 * gh.second_lyapunov * radius**2, other_width)
    near = _hopf(there, gh, value)
    u = np.append(start.u, value) + size * np.append(start.tangent, 0.0)
    u[-2], u[-3] = near.value, 2 * np.pi / near.frequency
    problem = bordered(CycleCurve.at(space, u, sizes, start.problem.mesh), u, flip=False)
    return onto(problem, u, np.append(start.tangent, 0.0))


def _hopf(system: System, gh: GHPoint, value: float) -> HopfPoint:
    """The Hopf point with the second parameter at a value."""
    first, other = gh.parameters
    return hopf_point(
        system.with_values(**{other: value}), first, gh.values[0], gh.frequency, gh.state
    )


def _radius(start: Start[CycleCurve], gh: GHPoint) -> float:
    """r of the cycle whose motion is the start's tangent: u = 2 r Re(q e^(iwt)), |q| = 1."""
    space = start.problem.space
    stages = space.split(start.tangent).stages
    return float(np.sqrt((space.quadrature * stages**2).sum() / 2))


def _with_coefficient(system: System, gh: GHPoint, wanted: float, width: float) -> float:
    """Value of the second parameter at which FLC has a wanted value, to first order."""
    step = 1e-4 * width
    here, there = (_coefficient(system, gh, gh.values[1] + s * step) for s in (-1, 1))
    return gh.values[1] + wanted * 2 * step / (there - here)


def _coefficient(system: System, gh: GHPoint, value: float) -> float:
    found = _hopf(system, gh, value)
    if found.lyapunov is None:
        raise NoConvergence(f"the first Lyapunov coefficient beside GH: {found.reason}", ())
    return found.lyapunov


def with_gh_ends(system: System, curve: Branch) -> Branch:
    """A curve of folds with the generalised Hopf points in which it ends, computed as such.

    The curve itself stops a little before them, where its equations lose their regularity and
    Newton's method may not converge either.
    """
    ends = {0: curve.began, len(curve) - 1: curve.ended}
    found = {
        index: _gh_end(system, curve, index)
        for index, ending in ends.items()
        if ending.words == GH_END or _size(system, curve.points[index].solution) < SMALL
    }
    special = sorted((*curve.special, *found.values()), key=lambda point: point.index)
    began, ended = (
        Ending("problem", GH_END) if index in found else ending for index, ending in ends.items()
    )
    return replace(curve, special=tuple(special), began=began, ended=ended)


def _size(system: System, cycle: Cycle) -> float:
    """Root mean square of u - mean, in the norm of the state's scales."""
    rms = np.array([cycle.measure(f"rms {name}") for name in cycle.state_names])
    return float(np.linalg.norm(rms / system.state_scales))


def _gh_end(system: System, curve: Branch, index: int) -> SpecialPoint:
    end: BranchPoint = curve.points[index]
    cycle: Cycle = end.solution
    first, other = curve.parameters
    rest = np.array([cycle.measure(f"mean {name}") for name in cycle.state_names])
    near = (rest, 2 * np.pi / cycle.period, dict(cycle.parameters))
    gh = gh_point(system, (first, other), near)
    coefficients = {"SLC": gh.second_lyapunov, "frequency": gh.frequency}
    words = "generalised Hopf: the curve of folds ends"
    values = np.array(gh.values)
    return SpecialPoint("GH", words, coefficients, index, end.u, end.tangent, values, cycle)
