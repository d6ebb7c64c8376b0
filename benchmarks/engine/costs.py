"""What one linearisation with its solution costs: against intervals, and against the size."""

from __future__ import annotations

import statistics
from collections.abc import Callable
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


def milliseconds(call: Callable[[], object], rounds: int = 15, least: float = 0.02) -> list[float]:
    """Of one call, round by round; a round has enough of them to last ``least`` seconds."""
    call()
    start = perf_counter()
    call()
    inner = max(1, round(least / (perf_counter() - start)))
    times = []
    for _ in range(rounds):
        start = perf_counter()
        for _ in range(inner):
            call()
        times.append(1e3 * (perf_counter() - start) / inner)
    return times


def newton(start: Start) -> dict[str, float]:
    """Linearisation (f, Jacobian, condensation) and solution of one Newton step, in ms: medians,
    and the least of both together.
    """
    problem, u = start.problem, start.u
    row, linearisation = problem.metric * start.tangent, problem.linearised(u)
    linearised = milliseconds(lambda: problem.linearised(u))
    solved = milliseconds(lambda: linearisation.newton(row))
    return {
        "linearised": statistics.median(linearised),
        "solved": statistics.median(solved),
        "least": min(linearised) + min(solved),
    }


def against_intervals(case: Case) -> list[dict[str, Any]]:
    """Newton steps of cycles and of folds of a case, the full period."""
    done = curves(case, HALF_20)
    first = case.free[0]
    widths = tuple(case.scales[name] for name in case.free)
    ordinary, fold = done.cycles.points[-1].solution, done.fold.solution
    rows = []
    for count in INTERVALS:
        cycle = on_mesh(ordinary, count, half=False)
        starts = {
            "cycle": cycle_from_cycle(case.system, cycle, first, widths[0], FIXED),
            "fold": lpc_from_cycle(
                case.system, on_mesh(fold, count, half=False), case.free, widths, FIXED
            ),
        }
        rows += [{"of": name, "intervals": count, **newton(at)} for name, at in starts.items()]
    return rows


def line(rows: list[dict[str, Any]], of: str) -> dict[str, Any]:
    """The straight line through the least costs: ms for nothing, ms an interval, and the greatest
    relative distance from it; exponent: between the two finest meshes.
    """
    chosen = [row for row in rows if row["of"] == of]
    N = np.array([row["intervals"] for row in chosen], dtype=float)
    cost = np.array([row["least"] for row in chosen])
    slope, start = np.polyfit(N, cost, 1, w=1 / cost)
    exponent = np.log(cost[-1] / cost[-2]) / np.log(N[-1] / N[-2])
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
    rows = []
    for count in COUNTS:
        how = Discretisation(HALF, True, FIXED)
        alike = partial(_alike, cycle, count)
        system = van_der_pol(1.0, count)
        start = cycle_from_guess(system, "mu", alike, cycle.period, 1.0, how)
        rows.append({"n": 2 * count, **newton(start)})
    return rows


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
