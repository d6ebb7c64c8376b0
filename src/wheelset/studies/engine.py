"""How the errors of cycles and of their folds fall as the mesh is refined.

Three systems, on the full and on half the period. The reference of every error is the same
quantity on ``FINEST`` intervals a period, four times the finest mesh compared.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from pydantic import AfterValidator, Field

from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.hunting import hunting_system
from wheelset.studies.example_cycles import (
    Example,
    computed,
    fold_value,
    oscillator_cycle,
    toy_wheelset,
    wheelset_cycle,
)
from wheelset.studies.parameters import StudyParameters, VehicleName
from wheelset.vehicle import load_vehicle

Array = NDArray[np.float64]

#: Mesh intervals a period that are compared, and the reference's.
INTERVALS = {"quick": (10, 20, 40, 80), "paper": (10, 16, 20, 32, 40, 64, 80)}
FINEST = 320

#: The order by theory: degree m = 4 gives 2 m at the mesh points, m + 1 between them.
ORDERS = {"mesh points": 8, "period": 8, "multiplier": 8, "fold speed": 8, "between them": 5}

#: How the vehicle departs from its file, as in the paper's section 5: cycles need a flange, and
#: the fold needs a subcritical Hopf point.
OVERRIDES = ("flange_law=exponential", "a3=200")

#: Parts of an interval at which polynomials are compared between the mesh points.
INSIDE = np.linspace(0, 1, 9)[1:-1]

#: An order is read off so many errors, at least, that are not rounding.
ROUNDING, LEAST = 1e-12, 3


def _can_be_followed(name: str) -> str:
    load_vehicle(name, overrides=list(OVERRIDES))
    return name


class Parameters(StudyParameters):
    """Parameters of the engine's convergence study."""

    vehicle: Annotated[VehicleName, AfterValidator(_can_be_followed)] = Field(
        default="guo2021",
        description="Name of a packaged vehicle or path of a vehicle file; taken with the "
        "exponential flange and a3 = 200 m⁻².",
    )


def examples(p: Parameters) -> Iterator[Example]:
    """The toy wheelset, the vehicle, and van der Pol's oscillator."""
    yield wheelset_cycle("toy wheelset", toy_wheelset())
    vehicle = p.load(p.vehicle, OVERRIDES)
    yield wheelset_cycle(p.vehicle, hunting_system(vehicle))
    yield oscillator_cycle()


def convergence(p: Parameters) -> pd.DataFrame:
    """Errors of every example on every mesh.

    Columns: system, form (full, half), intervals (a period), quantity, error. Quantities: period
    and fold speed, relative; multiplier (the greatest but the trivial one), absolute; mesh points
    and between them, the greatest of all states, relative to the state's greatest modulus.
    """
    rows = [
        {"system": example.name, "form": form, "intervals": count, "quantity": name, "error": error}
        for example in examples(p)
        for form in ("full", "half")
        for finest in [_Finest.of(example, form == "half")]
        for count in INTERVALS[p.resolution]
        for name, error in finest.errors(count).items()
    ]
    return pd.DataFrame(rows)


@dataclass(frozen=True, eq=False)
class _Finest:
    """An example whose cycle is the one on the finest mesh, and where its fold is there."""

    example: Example
    half: bool
    fold: float | None

    @classmethod
    def of(cls, example: Example, half: bool) -> _Finest:
        best = replace(example, cycle=computed(example, FINEST, half))
        return cls(best, half, fold_value(example, FINEST, half))

    def errors(self, intervals: int) -> dict[str, float]:
        cycle, best = computed(self.example, intervals, self.half), self.example.cycle
        points = np.arange(len(cycle.mesh) - 1) / intervals
        found = {
            "mesh points": _apart(cycle, best, points),
            "between them": _apart(cycle, best, points[:, np.newaxis] + INSIDE / intervals),
            "period": abs(cycle.period / best.period - 1),
            "multiplier": abs(_greatest(cycle) - _greatest(best)),
        }
        fold = fold_value(self.example, intervals, self.half)
        if fold is None or self.fold is None:
            return found
        return {**found, "fold speed": abs(fold / self.fold - 1)}


def _apart(one: Cycle, other: Cycle, phases: Array) -> float:
    size = np.abs(other.nodes).max(axis=(0, 1))
    return float((np.abs(one.at(phases) - other.at(phases)) / size).max())


def _greatest(cycle: Cycle) -> complex:
    """The greatest Floquet multiplier but for the trivial one."""
    values = cycle.multipliers
    others = np.delete(values, np.abs(values - 1).argmin())
    return complex(others[np.abs(others).argmax()])


def summary(errors: pd.DataFrame) -> pd.DataFrame:
    """One row a system and quantity, of the half period: errors on 20, 40 and 80 intervals a
    period, the order they fall with, and the order by theory.

    Columns: system, quantity, at 20, at 40, at 80, order (missing where nearly all are
    rounding), theory.
    """
    half = errors[errors["form"] == "half"]
    rows = []
    for (system, quantity), group in half.groupby(["system", "quantity"], sort=False):
        error = group.set_index("intervals")["error"]
        at = {f"at {count}": error[count] for count in (20, 40, 80)}
        orders = {"order": _order(error), "theory": ORDERS[str(quantity)]}
        rows.append({"system": system, "quantity": quantity, **at, **orders})
    return pd.DataFrame(rows)


def _order(error: pd.Series) -> float | None:
    """Slope of the errors over their intervals, both logarithmic."""
    kept = error[error > ROUNDING]
    if len(kept) < LEAST:
        return None
    return float(-np.polyfit(np.log(kept.index), np.log(kept), 1)[0])


def forms_apart(errors: pd.DataFrame) -> float:
    """The greatest difference between an error of the full and the same one of the half period."""
    keys = ["system", "intervals", "quantity"]
    by = errors.pivot_table(index=keys, columns="form", values="error")
    return float((by["full"] - by["half"]).abs().max())
