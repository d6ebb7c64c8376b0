"""Where branches of limit cycles come from: a Hopf point, an orbit, another branch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.locate import corrected
from wheelset.bifurcation.curves.zero_problem import ZeroProblem
from wheelset.bifurcation.cycles import meshes
from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.critical_modes import Borders, Mode, critical_mode
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import MESHING, CycleCurve, Meshing
from wheelset.bifurcation.cycles.symmetry import has_symmetry, require_symmetry
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.equilibria.lyapunov import critical_pair
from wheelset.bifurcation.integration.trajectory import Trajectory
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]
Problem = TypeVar("Problem", bound=ZeroProblem)

#: Components of an eigenvector below this part of the greatest one take no part in the cycle.
ABSENT = 1e-9

#: Part of an orbit's size by which u(t + T/2) may differ from S u(t) before it is a cycle.
NEARLY = 0.02

#: Rounds of equidistribution and refinement of a cycle found from an approximate orbit.
REFINEMENTS = 6

#: Steps of Newton's method onto a cycle from an approximate orbit.
MAX_ITERATIONS = 20


@dataclass(frozen=True, eq=False)
class Start(Generic[Problem]):
    """Where a curve begins: the problem, its unknowns, and the direction to set out in."""

    problem: Problem
    u: Array
    tangent: Array


@dataclass(frozen=True)
class Discretisation:
    """How cycles are represented.

    intervals: mesh intervals of the part computed, to begin with. half: True for half a period of a
    symmetric cycle, False for the full period, None to use half where the symmetry is there. mesh:
    how it is renewed.
    """

    intervals: int = 20
    half: bool | None = None
    mesh: Meshing = MESHING

    def __post_init__(self) -> None:
        if self.intervals < 2:
            raise ValueError(f"intervals = {self.intervals}: at least 2 are needed")


def cycle_from_hopf(
    system: System,
    hopf: HopfPoint,
    width: float | None = None,
    size: float = 1e-2,
    discretisation: Discretisation | None = None,
) -> Start[CycleCurve]:
    """The branch of cycles born at a Hopf point, in the point's parameter.

    width: typical change of the parameter, for norms (default: its value, or 1). size: of the first
    cycle in the norm of the state's scales; a cycle of no size leaves period and parameter open.
    """
    seed = cycle_at_hopf(system, hopf, width, discretisation)
    return onto(seed.problem, seed.u + size * seed.tangent, seed.tangent)


def cycle_at_hopf(
    system: System,
    hopf: HopfPoint,
    width: float | None = None,
    discretisation: Discretisation | None = None,
) -> Start[CycleCurve]:
    """The cycle of no size at a Hopf point, and the eigenvector's motion as a unit direction."""
    how = discretisation or Discretisation()
    p, x0 = system.p(**{hopf.parameter: hopf.value}), np.array(hopf.state)
    pair = critical_pair(system.jacobian(x0, p), hopf.frequency)
    scales = system.state_scales
    signs = np.where(np.abs(pair.q / scales) > ABSENT * np.abs(pair.q / scales).max(), -1.0, 1.0)
    half = _half(system, p, how.half, signs, scales, x0)
    space = Collocation(
        system, p, (hopf.parameter,), np.full(how.intervals, 1 / how.intervals),
        signs if half else np.ones(system.n), half, scales,
    )  # fmt: skip
    turn = 2j * np.pi * space.kappa
    wave = pair.q * np.exp(turn * space.mesh)[:, np.newaxis]
    stage_phase = np.exp(turn * stage_phases(space))[..., np.newaxis]
    size = np.sqrt((space.weights * (pair.q * stage_phase).real ** 2).sum())
    motion = space.join(wave.real / size, (pair.q * stage_phase).real / size, 0.0, np.zeros(1))
    rest = space.join(
        x0 + 0 * wave.real, x0 + 0 * (pair.q * stage_phase).real, 2 * np.pi / hopf.frequency,
        np.array([hopf.value]),
    )  # fmt: skip
    sizes = np.array([2 * np.pi / hopf.frequency, width or abs(hopf.value) or 1.0])
    return Start(CycleCurve.at(space, rest + motion, sizes, how.mesh), rest, motion)


def _half(
    system: System, p: Array, wanted: bool | None, signs: Array, scales: Array, about: Array
) -> bool:
    if wanted is None:
        return has_symmetry(system, p, signs, scales, about)
    if wanted:
        require_symmetry(system, p, signs, scales, about)
    return wanted


def stage_phases(space: Collocation) -> Array:
    """s at the stages, (N, m)."""
    return space.mesh[:-1, np.newaxis] + space.h[:, np.newaxis] * space.rule.c


def cycle_from_orbit(
    system: System,
    parameter: str,
    orbit: Trajectory,
    period: float | None = None,
    width: float | None = None,
    discretisation: Discretisation | None = None,
) -> Start[CycleCurve]:
    """The branch through the cycle near an integrated orbit, at the system's own parameters.

    The orbit's last period is used; period in s: by default the time between the last two upward
    crossings of the first state's mean. Raises NoConvergence where there is no cycle near.
    """
    last, whole = float(orbit.t[-1]), float(orbit.t[-1] - orbit.t[0])
    length = period or _period(orbit.t, orbit.x[:, 0])
    if not 0 < length <= whole:
        raise ValueError(f"period = {length}: must lie in 0 .. {whole:.6g} s, the orbit's length")

    def turn(phase: Array) -> Array:
        return orbit(last - length + phase * length)

    return cycle_from_guess(system, parameter, turn, length, width, discretisation)


def _period(t: Array, first: Array) -> float:
    """Time between the last two upward crossings of the mean, by linear interpolation."""
    above = first - first[len(first) // 2 :].mean()
    up = np.flatnonzero((above[:-1] < 0) & (above[1:] >= 0))
    if len(up) < 2:
        raise ValueError("the orbit shows no two periods; give its period, or a longer orbit")
    crossings = t[up] - above[up] * (t[up + 1] - t[up]) / (above[up + 1] - above[up])
    return float(crossings[-1] - crossings[-2])


def cycle_from_guess(
    system: System,
    parameter: str,
    orbit: Callable[[Array], Array],
    period: float,
    width: float | None = None,
    discretisation: Discretisation | None = None,
) -> Start[CycleCurve]:
    """The branch through the cycle near a function of the phase, (points,) -> (points, n), whose
    period in s is about ``period``.
    """
    how = discretisation or Discretisation()
    p, scales = system.p(), system.state_scales
    signs, half = _orbit_symmetry(system, p, how.half, orbit, scales)
    fine = Collocation(
        system, p, (parameter,), np.full(4 * how.intervals, 0.25 / how.intervals), signs, half,
        scales,
    )  # fmt: skip
    guess = _sampled(fine, orbit, period, np.array([p[system.index(parameter)]]))
    h = meshes.equidistributed(fine, fine.split(guess), how.intervals)
    space = replace(fine, h=h)
    u = meshes.moved(fine, space, guess)
    start = at_parameter(curve_at(space, u, (width,), how.mesh), u)
    return _refined(start) if how.mesh.accuracy else start


def _refined(start: Start[CycleCurve]) -> Start[CycleCurve]:
    """The start on a mesh that suits its cycle, as fine as the accuracy asks for."""
    for _ in range(REFINEMENTS):
        curve, u = start.problem, start.u
        error = curve.estimated(u, start.tangent)
        if error <= (curve.mesh.accuracy or np.inf):
            break
        renewal = replace(curve, age=curve.mesh.every).renewal(u, error)
        assert renewal.transfer is not None
        start = at_parameter(renewal.problem, renewal.transfer(u))
    return start


def cycle_from_cycle(
    system: System,
    cycle: Cycle,
    parameter: str,
    width: float | None = None,
    mesh: Meshing = MESHING,
) -> Start[CycleCurve]:
    """The branch through a known cycle, in any parameter; mesh and symmetry are the cycle's."""
    curve, u = known(system, cycle, (parameter,), (width,), mesh)
    return at_parameter(curve, u)


def known(
    system: System,
    cycle: Cycle,
    parameters: tuple[str, ...],
    widths: tuple[float | None, ...],
    mesh: Meshing = MESHING,
) -> tuple[CycleCurve, Array]:
    """The equations of a known cycle with parameters free, and its unknowns."""
    p = system.p(**cycle.parameters)
    signs = np.ones(system.n) if cycle.signs is None else np.array(cycle.signs)
    space = Collocation(
        system, p, parameters, np.diff(cycle.mesh), signs, cycle.symmetric, system.state_scales
    )
    u = Orbit(cycle.nodes, signs * cycle.nodes[0, 0], cycle.period, p[space.where]).vector
    return curve_at(space, u, widths, mesh), u


def curve_at(
    space: Collocation, u: Array, widths: tuple[float | None, ...], mesh: Meshing
) -> CycleCurve:
    """Cycles with the phase of u; a width not given is the parameter's own size."""
    orbit = space.split(u)
    sizes = [w or abs(v) or 1.0 for w, v in zip(widths, orbit.free.tolist(), strict=True)]
    return CycleCurve.at(space, u, np.array([orbit.period, *sizes]), mesh)


def at_parameter(curve: CycleCurve, guess: Array) -> Start[CycleCurve]:
    """Newton's method onto the cycle with the guess's parameter, and the direction of growth."""
    return onto(curve, guess, last_unknown(guess), 1e-11)


def last_unknown(u: Array) -> Array:
    """The direction of the last unknown, a parameter, which Newton's method across it keeps."""
    direction = np.zeros(len(u))
    direction[-1] = 1.0
    return direction


def onto(problem: Problem, guess: Array, direction: Array, wanted: float = 1e-10) -> Start[Problem]:
    """The point of a curve that Newton's method reaches across a direction."""
    point = corrected(problem, guess, direction, wanted, MAX_ITERATIONS, 1e-8).point
    return Start(problem, point.u, point.tangent)


def _orbit_symmetry(
    system: System, p: Array, wanted: bool | None, orbit: Callable[[Array], Array], scales: Array
) -> tuple[Array, bool]:
    """Signs with orbit(phase + 1/2) = S orbit(phase), and whether to use them."""
    phase = np.linspace(0, 0.5, 100, endpoint=False)
    first, second = orbit(phase) / scales, orbit(phase + 0.5) / scales
    flipped, kept = np.abs(first + second).max(axis=0), np.abs(first - second).max(axis=0)
    size = np.abs(first).max()
    if wanted is None and (np.minimum(flipped, kept) > NEARLY * size).any():
        return np.ones(system.n), False
    open_ = np.maximum(flipped, kept) <= NEARLY * size  # components that take no part
    for sign in (-1.0, 1.0):
        signs = np.where(open_, sign, np.where(flipped < kept, -1.0, 1.0))
        if has_symmetry(system, p, signs, scales, np.zeros(system.n)) and wanted is not False:
            return signs, True
    if wanted:
        require_symmetry(system, p, signs, scales, np.zeros(system.n))
    return np.ones(system.n), False


def _sampled(
    space: Collocation, orbit: Callable[[Array], Array], period: float, free: Array
) -> Array:
    """Unknowns from a function of the phase in periods."""
    points, stages = space.mesh, stage_phases(space).ravel()
    return space.join(
        orbit(space.kappa * points), orbit(space.kappa * stages).reshape(space.shape), period, free
    )


def cycle_from_flip(
    system: System,
    cycle: Cycle,
    parameter: str,
    width: float | None = None,
    size: float = 1e-2,
    mesh: Meshing = MESHING,
) -> Start[CycleCurve]:
    """The branch that a flip sends off: doubled cycles at a PD, asymmetric ones at a BPC of a
    symmetric family (the other of the pair is its mirror image).

    The part computed is run through twice, the mode changing sign in between. size: distance of the
    first cycle from the old one, relative to 1 + its own norm; a tenth of it and a hundredth where
    Newton's method does not get there, as beside a singularity of the field.
    """
    curve, u = known(system, cycle, (parameter,), (width,), mesh)
    space, orbit = curve.space, curve.space.split(u)
    found, _ = mode_at(curve, u, flip=True)
    double = replace(
        space, h=np.concatenate([space.h, space.h]) / 2, signs=np.ones(system.n), half=False
    )
    period = orbit.period if space.half else 2 * orbit.period
    twice = double.join(*_twice(orbit.mesh_values, orbit.stages, space.signs), period, orbit.free)
    away = double.join(*_twice(found.x, found.v, -space.signs), 0.0, np.zeros(1))
    doubled = curve_at(double, twice, (width,), mesh)
    for part in (1.0, 0.1, 0.01):
        try:
            return _beside(doubled, twice, away, part * size)
        except NumericalOutcome as outcome:
            failure = outcome
    raise failure


def _twice(x: Array, X: Array, signs: Array) -> tuple[Array, Array]:
    """Mesh values and stages of a function followed by its image."""
    return np.concatenate([x[:-1], signs * x]), np.concatenate([X, signs * X])


def mode_at(curve: CycleCurve, u: Array, flip: bool) -> tuple[Mode, Borders]:
    """The mode nearest to critical at u, and borders that fit it."""
    orbit = curve.space.split(u)
    return critical_mode(curve.space, orbit, curve.anchor.row, float(curve.sizes[0]), flip)


def cycle_from_crossing(
    system: System,
    cycle: Cycle,
    tangent: Array,
    parameter: str,
    width: float | None = None,
    size: float = 1e-2,
    mesh: Meshing = MESHING,
) -> Start[CycleCurve]:
    """The other branch through a branch point of cycles.

    tangent (N,): the first branch's there. Sets out along the kernel's other direction.
    """
    curve, u = known(system, cycle, (parameter,), (width,), mesh)
    anything = np.random.default_rng(7).standard_normal(len(u) - 1)
    linearisation = replace(curve.linearised(u), residual=anything)
    away, _ = linearisation.newton(curve.metric * tangent)
    return _beside(curve, u, away, size)


def _beside(curve: CycleCurve, u: Array, away: Array, size: float) -> Start[CycleCurve]:
    """The cycle at a distance from u, found across the direction that leads away."""
    direction = away / np.sqrt(curve.metric @ away**2)
    step = size * (1 + np.sqrt(curve.metric @ u**2))
    return onto(curve, u + step * direction, direction)
