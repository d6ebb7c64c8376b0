"""Measured campaigns by Monte Carlo: every mileage of every campaign with noise of its own.

Samples are drawn by seeds of their own and computed in parts of a fixed size, so that results do
not depend on how many processes share the work.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.profiles import Profile
from wheelset.studies.on_profiles import OnProfiles, on_profiles, reach_of, searched, speeds_row
from wheelset.studies.reprofiling_contact import Neighbourhood, averaging, neighbourhood
from wheelset.studies.reprofiling_noise import Measurement, Smoother, aligned, smoother
from wheelset.studies.reprofiling_speeds import (
    FoldResponse,
    coefficients,
    fold_response,
    hopf_speeds,
    taylor,
)
from wheelset.vehicle import Vehicle

Array = NDArray[np.float64]

#: Samples computed together.
PART = 250

#: Why a sample has no Hopf speed or no contact.
ENDED = "the contact lies at the end of what was smoothed"

Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Plan:
    """What all mileages have in common. window: m/s; width [m]; limit: of the stiffness factor."""

    vehicle: Vehicle
    rail: Profile
    window: tuple[float, float]
    width: float
    limit: float
    measurement: Measurement
    seed: int


@dataclass(frozen=True, eq=False)
class Case:
    """A wheel at a mileage [1e4 km], and all that neighbouring wheels need.

    row: of ``speeds_row``; functions (3, Y) of the wheel itself; folds of its cycles.
    """

    mileage: float
    row: dict[str, Any]
    beside: Neighbourhood
    smoother: Smoother
    taylor: Array
    functions: Array
    folds: tuple[FoldResponse, ...]


def case(plan: Plan, mileage: float, wheel: Profile) -> Case:
    """The wheel as it is, computed in full."""
    contact = searched(wheel, plan.rail, plan.vehicle)
    run = on_profiles(plan.vehicle, contact, plan.window, plan.width)
    beside = neighbourhood(contact)
    average = averaging(beside.y, reach_of(contact), plan.width)
    functions, _ = beside.functions(np.zeros((3, 1, len(beside.u))))
    return Case(
        mileage, speeds_row(run), beside,
        smoother(wheel, beside.u, plan.measurement),
        taylor(average), functions[0],
        tuple(fold_response(run.found.system, fold, average) for fold in _turns(run)),
    )  # fmt: skip


def _turns(run: OnProfiles) -> list[Any]:
    """Folds at which the speed is least: those at which cycles end as the speed falls."""
    folds = run.folds
    v = [float(point.values[0]) for point in folds]
    hopf = np.inf if run.hopf is None else run.hopf.value
    lowest = [k for k, at in enumerate(v) if at <= min([*v[:k], hopf])]
    return [folds[k] for k in lowest]


def sampled(plan: Plan, known: Case, first: int, count: int, column: int) -> pd.DataFrame:
    """Speeds on measured wheels, a row a sample: sample, mileage, v_lin, v_limit (Hopf speeds with
    the suspension as it is and at the limit), v_non (lowest fold), power of v_non, m/s; words.
    """
    samples = range(first, first + count)
    functions, inside = known.beside.functions(_deviations(plan, known, samples, column))
    return _speeds(plan, known, functions, inside, samples)


def _speeds(
    plan: Plan, known: Case, functions: Array, inside: NDArray[np.bool_], samples: range
) -> pd.DataFrame:
    named = coefficients(known.taylor, functions)
    near = known.row["v_lin"] or plan.window[1] / 2
    speeds = [hopf_speeds(plan.vehicle, named, near * f**0.5, f) for f in (1.0, plan.limit)]
    lowest = _lowest(known.folds, functions - known.functions)
    words = [
        ENDED if not ok else "; ".join(str(o) for o in outcomes if o is not None)
        for ok, *outcomes in zip(inside, *(s.outcomes for s in speeds), strict=True)
    ]
    rows = {"sample": list(samples), "mileage": known.mileage}
    frame = pd.DataFrame({**rows, "v_lin": speeds[0].values, "v_limit": speeds[1].values, **lowest})
    return frame.assign(words=words)


def unmeasured(plan: Plan, known: Case) -> pd.DataFrame:
    """The wheel itself as a row of ``sampled``."""
    return _speeds(plan, known, known.functions[np.newaxis], np.array([True]), range(1))


def _deviations(plan: Plan, known: Case, samples: range, column: int) -> Array:
    """What is off in z, dz/du, d2z/du2: (3, samples, U)."""
    u, wheel = known.beside.u, known.beside.wheel
    seeds = (np.random.SeedSequence(plan.seed, spawn_key=(k, column)) for k in samples)
    draws = [
        plan.measurement.drawn(np.random.default_rng(seed), known.smoother.points) for seed in seeds
    ]
    off = known.smoother.deviations(np.array([noise for noise, _, _ in draws]))
    return off + np.stack([aligned(wheel, u, dy, turn) for _, dy, turn in draws], axis=1)


def _lowest(folds: Sequence[FoldResponse], changes: Array) -> dict[str, Array]:
    """Of every sample the speed of the lowest fold, and the power with which it stiffens."""
    if not folds:
        none = np.full(len(changes), np.nan)
        return {"v_non": none, "power": none}
    speeds = np.array([fold.speeds(changes) for fold in folds])
    least = speeds.argmin(axis=0)
    powers = np.array([fold.power for fold in folds])
    return {"v_non": speeds.min(axis=0), "power": powers[least]}


def cases(plan: Plan, wheels: Mapping[float, Profile], workers: Executor) -> tuple[Case, ...]:
    """The wheels as they are, by mileage [1e4 km]."""
    started = [workers.submit(case, plan, m, wheel) for m, wheel in wheels.items()]
    return tuple(future.result() for future in started)


def campaigns(
    plan: Plan,
    known: Sequence[Case],
    samples: int,
    workers: Executor,
    progress: Progress = lambda done, of: None,
) -> pd.DataFrame:
    """All rows of ``sampled``, in order of sample and mileage; progress is told parts done."""
    parts = [(first, min(PART, samples - first)) for first in range(0, samples, PART)]
    tasks = [
        workers.submit(sampled, plan, one, *part, column)
        for part in parts
        for column, one in enumerate(known)
    ]
    for done, _ in enumerate(as_completed(tasks), 1):
        progress(done, len(tasks))
    table = pd.concat([task.result() for task in tasks], ignore_index=True)
    return table.sort_values(["sample", "mileage"], ignore_index=True)


def workers(processes: int) -> Executor:
    """Processes that share the work; one: this process does it."""
    if processes == 1:
        return _Here()
    return ProcessPoolExecutor(processes, mp_context=get_context("spawn"))


class _Here(Executor):
    """Does the work at once, in this process."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future
