"""What one linearisation with its solution costs: against intervals, and against the size."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.auto07p import Case
from benchmarks.engine.clock import Clock, Clocked
from benchmarks.engine.study import (
    EQUAL_MESH,
    FIRST,
    HALF_20,
    LONGEST,
    Curves,
    Form,
    curves,
    walk,
)
from tests.exact_systems import van_der_pol
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_from_cycle,
    cycle_from_guess,
    cycle_from_hopf,
    cycle_from_orbit,
)
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.studies.example_cycles import on_mesh, solved

INTERVALS = (10, 20, 40, 80, 160, 320, 640)
COUNTS = (2, 4, 8, 16)

#: Intervals of the half period in the comparison of sizes.
HALF = 20

FIXED = Meshing(0, None)


#: Rounds of measurement, and how long one lasts at least, s.
ROUNDS, LEAST = 15, 0.02


def milliseconds(calls: Sequence[Callable[[], object]]) -> list[list[float]]:
    """Of one call each, round by round, all in turns, so that a machine whose speed drifts drifts
    for all.
    """
    counts = [_enough(call) for call in calls]
    times: list[list[float]] = [[] for _ in calls]
    for _ in range(ROUNDS):
        for call, count, found in zip(calls, counts, times, strict=True):
            found.append(1e3 * _seconds(call, count) / count)
    return times


def _enough(call: Callable[[], object]) -> int:
    """How many calls last long enough."""
    _seconds(call, 1)
    return max(1, round(LEAST / _seconds(call, 1)))


def _seconds(call: Callable[[], object], count: int) -> float:
    start = perf_counter()
    for _ in range(count):
        call()
    return perf_counter() - start


def newton(starts: Sequence[Start]) -> list[dict[str, float]]:
    """Linearisation (f, Jacobian, condensation) and solution of one Newton step each, in ms:
    medians, and the least of both together.
    """
    calls = [call for start in starts for call in _parts(start)]
    times = milliseconds(calls)
    return [
        {
            "linearised": statistics.median(linearised),
            "solved": statistics.median(solved),
            "least": min(linearised) + min(solved),
        }
        for linearised, solved in zip(times[::2], times[1::2], strict=True)
    ]


def _parts(start: Start) -> tuple[Callable[[], object], Callable[[], object]]:
    problem, u = start.problem, start.u
    row, linearisation = problem.metric * start.tangent, problem.linearised(u)
    return partial(problem.linearised, u), partial(linearisation.newton, row)


def against_intervals(case: Case) -> list[dict[str, Any]]:
    """Newton steps of cycles and of folds of a case, the full period."""
    done = curves(case, HALF_20)
    first = case.free[0]
    widths = tuple(case.scales[name] for name in case.free)
    ordinary, fold = done.cycles.points[-1].solution, done.fold.solution
    starts: list[Start] = []
    for count in INTERVALS:
        cycle, critical = (on_mesh(one, count, half=False) for one in (ordinary, fold))
        starts += [
            cycle_from_cycle(case.system, cycle, first, widths[0], FIXED),
            lpc_from_cycle(case.system, critical, case.free, widths, FIXED),
        ]
    names = [{"of": of, "intervals": count} for count in INTERVALS for of in ("cycle", "fold")]
    return [name | times for name, times in zip(names, newton(starts), strict=True)]


def line(rows: list[dict[str, Any]], of: str) -> dict[str, Any]:
    """The straight line through the least costs: ms for nothing, ms an interval, and the greatest
    relative distance from it; exponent: over the three finest meshes.
    """
    chosen = [row for row in rows if row["of"] == of]
    N = np.array([row["intervals"] for row in chosen], dtype=float)
    cost = np.array([row["least"] for row in chosen])
    slope, start = np.polyfit(N, cost, 1, w=1 / cost)
    exponent, _ = np.polyfit(np.log(N[-3:]), np.log(cost[-3:]), 1)
    return {
        "of": of,
        "ms_for_nothing": float(start),
        "ms_an_interval": float(slope),
        "greatest_distance": float(np.abs((start + slope * N) / cost - 1).max()),
        "exponent": float(exponent),
    }


def against_size() -> list[dict[str, Any]]:
    """Chains of van der Pol's oscillators, all in phase; n is twice their number."""
    single = van_der_pol(1.0)
    orbit = integrate(single, [2.0, 0.0], 40.0)
    cycle = solved(cycle_from_orbit(single, "mu", orbit, discretisation=Discretisation(HALF, True)))
    how = Discretisation(HALF, True, FIXED)
    starts = [
        cycle_from_guess(
            van_der_pol(1.0, count), "mu", partial(_alike, cycle, count), cycle.period, 1.0, how
        )
        for count in COUNTS
    ]
    return [{"n": 2 * count, **times} for count, times in zip(COUNTS, newton(starts), strict=True)]


def _alike(cycle: Cycle, count: int, phases: np.ndarray) -> np.ndarray:
    return np.tile(cycle.at(phases), count)


def breakdown(case: Case, form: Form) -> dict[str, dict[str, float]]:
    """Of the walks along cycles and folds: ms a step by what is done, and calls a step."""
    control = StepControl(first=FIRST, most=LONGEST)
    done = curves(case, form)
    parts = {}
    for name, (start, ways, windows) in _walks(case, done, form).items():
        clock = Clock()
        branch = _clocked(ways, start, clock, windows, control)
        steps = len(branch) - 1
        parts[name] = {
            **{f"{what}_ms": 1e3 * seconds / steps for what, seconds in clock.stop().items()},
            **{f"{what}_calls": calls / steps for what, calls in clock.calls.items()},
        }
    return parts


def _clocked(ways, start: Start, clock: Clock, windows, control: StepControl):
    clocked = Start(Clocked(start.problem, clock), start.u, start.tangent)
    return walk(ways, clocked, windows, control)


def _walks(case: Case, done: Curves, form: Form):
    first, second = case.free
    widths = case.scales[first], case.scales[second]
    hopf = hopf_point(case.system, first, sum(case.start) / 2)
    how = Discretisation(form.intervals, form.half, EQUAL_MESH)
    cycles = cycle_from_hopf(case.system, hopf, widths[0], discretisation=how)
    folds = lpc_from_cycle(case.system, done.fold.solution, case.free, widths, EQUAL_MESH)
    return {
        "cycles": (cycles, follow, {first: case.window}),
        "lpc_curve": (folds, both_ways, {second: case.curve}),
    }
