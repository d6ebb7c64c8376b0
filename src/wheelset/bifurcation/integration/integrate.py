"""Time integration of x' = f(x, p): dense output, located events, named endings.

The default method is DOP853 (Dormand and Prince's explicit pair of order 8). Hunting is a
self-excited oscillation whose fast damped modes (creep forces, rate ~ 1/v) stay within a few
thousand 1/s and whose flange contact acts for a few ms: accuracy limits the step, not stability,
and a one-step method starts again at a corner or a boundary at full order. At a walking pace
(below about 1 m/s) the creep forces make the problem stiff; choose "Radau" or "LSODA" there, which
use the exact Jacobian.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.integration.corners import piecewise_steps
from wheelset.bifurcation.integration.endings import (
    BecameNotFinite,
    Ending,
    LeftDomain,
    SettledToCycle,
    SettledToEquilibrium,
    SolverFailed,
)
from wheelset.bifurcation.integration.events import Event, EventSpec
from wheelset.bifurcation.integration.plan import (
    Plan,
    checked_atol,
    checked_options,
    checked_parameters,
    checked_section,
    checked_span,
    checked_state,
)
from wheelset.bifurcation.integration.settling import Settling
from wheelset.bifurcation.integration.step import Step
from wheelset.bifurcation.integration.stepping import smooth_steps
from wheelset.bifurcation.integration.trajectory import Trajectory
from wheelset.bifurcation.integration.watching import watches
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]
Progress = Callable[[float], None]


def integrate(
    system: System,
    x0: ArrayLike,
    t_end: float,
    *,
    p: ArrayLike | None = None,
    method: str = "DOP853",
    rtol: float = 1e-9,
    atol: ArrayLike | None = None,
    events: Sequence[EventSpec] = (),
    stop_when_settled: bool = False,
    settle_tol: float = 1e-6,
    section: str | None = None,
    t_start: float = 0.0,
    max_step: float = np.inf,
    max_steps: int = 1_000_000,
    progress: Progress | None = None,
) -> Trajectory:
    """Integrate x' = f(x, p) from x0 (n,) at t_start to t_end [s].

    p: (m,), default the system's values. method: "DOP853", "RK45", "Radau", "BDF" or "LSODA".
    rtol: relative tolerance of a step. atol: absolute ones, (n,) or a number, in the states'
        units; by default rtol times 1e-3 of the size each state reaches in the linearised motion
        from x0, since states of different units have no common tolerance.
    events: ``Crossing`` and ``ThresholdPair``.
    stop_when_settled: end at an equilibrium or a cycle reached within ``settle_tol``, relative to
        the largest state so far or to the cycle's amplitude; keep it above some 100 rtol.
    section: state whose local maxima are the returns of a cycle (default: the first).
    max_step: s. max_steps: a guard. progress: called with the fraction of time done.

    A piecewise smooth field is integrated region by region. Whatever happens, what was computed
    is returned; ``outcome`` says how it ended. Raises ValueError for an input that makes no sense.
    """
    checked_span(t_start, t_end)
    checked_options(method, rtol, max_step, settle_tol)
    x, parameters = checked_state(system, x0), checked_parameters(system, p)
    watches(events, system.state_names, x)
    index = checked_section(system, section)
    plan = Plan(
        system, parameters, method, rtol, np.empty(0), max_step, max_steps, tuple(events),
        stop_when_settled, settle_tol, index,
    )  # fmt: skip
    try:
        scaled = replace(plan, atol=checked_atol(system, parameters, x, rtol, atol))
        system.rhs(x, parameters)
    except (DomainLeft, NotFinite) as cause:
        return _nowhere(plan, t_start, x, cause)
    return _run(scaled, t_start, x, t_end, progress)


def extend(trajectory: Trajectory, t_end: float, progress: Progress | None = None) -> Trajectory:
    """The trajectory continued from its end to t_end [s]; a settled one goes on without stopping.

    Raises ValueError where it ended because it could not go on.
    """
    t, x = float(trajectory.t[-1]), trajectory.x[-1]
    checked_span(t, t_end)
    if isinstance(trajectory.outcome, LeftDomain | BecameNotFinite):
        raise ValueError(f"trajectory cannot be extended: {trajectory.outcome}")
    settled = isinstance(trajectory.outcome, SettledToEquilibrium | SettledToCycle)
    plan = replace(
        trajectory.plan, stop_when_settled=trajectory.plan.stop_when_settled and not settled
    )
    more = _run(plan, t, x, t_end, progress)
    return replace(
        more,
        t=np.concatenate([trajectory.t, more.t[1:]]),
        x=np.concatenate([trajectory.x, more.x[1:]]),
        events=trajectory.events + more.events,
        steps=trajectory.steps + more.steps,
    )


def _run(plan: Plan, t: float, x: Array, t_end: float, progress: Progress | None) -> Trajectory:
    watching = watches(plan.events, plan.system.state_names, x)
    settling = Settling(plan, t, np.abs(x)) if plan.stop_when_settled else None
    steps: list[Step] = []
    events: list[Event] = []
    outcome: Ending | None = None
    for item in _items(plan, t, x, t_end):
        if isinstance(item, Ending):
            outcome = item
            break
        steps.append(item)
        found = [e for watch in watching for e in watch.on(item)]
        events += _corner(item) + sorted(found, key=lambda e: e.t)
        if progress:
            progress((item.t1 - t) / (t_end - t))
        outcome = settling.after(item) if settling else None
        if outcome is None and len(steps) >= plan.max_steps:
            outcome = _too_long(plan, item)
        if outcome:
            break
    assert outcome is not None
    return _trajectory(plan, t, x, steps, events, outcome)


def _items(plan: Plan, t: float, x: Array, t_end: float) -> Iterator[Step | Ending]:
    if plan.system.field.switch:
        return piecewise_steps(plan, t, x, t_end)
    return smooth_steps(plan, plan.system, plan.p, t, x, t_end, None)


def _corner(step: Step) -> list[Event]:
    return [Event("corner", step.t0, step.x0, step.corner)] if step.corner else []


def _too_long(plan: Plan, step: Step) -> Ending:
    message = (
        f"more than max_steps = {plan.max_steps} steps; the problem may be stiff: "
        "choose method='Radau', a larger rtol, or a larger max_steps"
    )
    return SolverFailed(step.t1, step.x1, message)


def _trajectory(
    plan: Plan, t: float, x: Array, steps: list[Step], events: list[Event], outcome: Ending
) -> Trajectory:
    final = {SettledToEquilibrium: "settled", SettledToCycle: "settled", LeftDomain: "domain left"}
    kind = final.get(type(outcome))
    if kind:
        events = [*events, Event(kind, outcome.t, outcome.state, str(outcome))]
    times = np.array([t, *(s.t1 for s in steps)])
    states = np.array([x, *(s.x1 for s in steps)])
    return Trajectory(times, states, tuple(events), outcome, tuple(steps), plan)


def _nowhere(plan: Plan, t: float, x: Array, cause: DomainLeft | NotFinite) -> Trajectory:
    """The trajectory of one point that starts outside the domain."""
    ending = LeftDomain if isinstance(cause, DomainLeft) else BecameNotFinite
    return _trajectory(plan, t, x, [], [], ending(t, x, cause))  # type: ignore[arg-type]
