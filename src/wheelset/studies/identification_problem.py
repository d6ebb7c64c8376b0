"""Printed Hopf points as a function of the hidden values of one structure.

Every residual, and every column of its Jacobian, is one row of a single batch of Hopf points.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch, hopf_batch
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.identification_data import changes_of, tolerance
from wheelset.studies.identification_variants import UNCORRECTED, Free, Variant
from wheelset.studies.parameters import StudyParameters

Array = NDArray[np.float64]

#: Where a Hopf point is sought: the printed default one, and v^2 a1 kept.
NEAR = (51.7, 0.2266)

#: Residual of a row without a Hopf point, in tolerances; and the step of the differences.
CEILING, STEP = 1e3, 1e-4


@dataclass(frozen=True, eq=False)
class Problem:
    """Printed numbers as a function of hidden values.

    data: observations. rows (k, m): a parameter vector for each different set of changes; which
    (observations,) says whose. columns: of the free values in a row; held (k, free): where a row's
    own change stands instead. tolerances (observations,).
    """

    system: System
    data: pd.DataFrame
    free: tuple[Free, ...]
    rows: Array
    which: NDArray[np.intp]
    held: NDArray[np.bool_]
    tolerances: Array

    @property
    def columns(self) -> list[int]:
        """Places of the free values in a row."""
        return [self.system.index(one.name) for one in self.free]

    def rows_at(self, t: Array) -> Array:
        """The parameter rows at coordinates t (free,)."""
        rows = self.rows.copy()
        values = np.array([one.value(ti) for one, ti in zip(self.free, t, strict=True)])
        rows[:, self.columns] = np.where(self.held, rows[:, self.columns], values)
        return near_rows(self.system, rows)

    def hopf(self, t: Array, near: HopfBatch | None = None) -> HopfBatch:
        """The Hopf points of the rows, sought beside others where there are any."""
        rows = self.rows_at(t)
        return hopf_batch(
            self.system, "v", rows if near is None else _from(near, self.system, rows)
        )

    def residuals(self, t: Array) -> Array:
        """``judged`` at coordinates t."""
        return self.judged(self.hopf(t))

    def judged(self, batch: HopfBatch) -> Array:
        """Computed less printed in tolerances, (observations,); ``CEILING`` at most."""
        computed = self._computed(batch)
        wanted = np.where(self.data["quantity"] == "gh_value", 0.0, self.data["printed"])
        found = batch.found[self.which]
        apart = np.where(found, computed - wanted, CEILING * self.tolerances) / self.tolerances
        return np.clip(apart, -CEILING, CEILING)

    def _computed(self, batch: HopfBatch) -> Array:
        speeds = self.data["quantity"] == "hopf_speed"
        return np.where(speeds, batch.values[self.which], batch.lyapunov[self.which])

    def jacobian(self, t: Array, base: HopfBatch) -> Array:
        """Forward differences of the residuals, (observations, free), from one batch; ``base`` are
        the Hopf points at t.
        """
        steps = np.diag(np.where(t + STEP > self.bounds[1], -STEP, STEP))
        moved = [_from(base, self.system, self.rows_at(t + step)) for step in steps]
        batch = hopf_batch(self.system, "v", np.concatenate(moved))
        parts = [self.judged(_part(batch, k, len(self.rows))) for k in range(len(steps))]
        apart = np.array(parts) - self.judged(base)
        return np.asarray((apart / steps.diagonal()[:, np.newaxis]).T)

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Intervals of the coordinates: lower and upper ends, (free,) each."""
        low, high = np.array([one.bounds for one in self.free]).reshape(-1, 2).T
        return low, high

    def holding(self, name: str, value: float) -> Problem:
        """The same problem with one free value fixed."""
        k = [one.name for one in self.free].index(name)
        rows = self.rows.copy()
        own = self.held[:, k]
        rows[:, self.columns[k]] = np.where(own, rows[:, self.columns[k]], value)
        free = (*self.free[:k], *self.free[k + 1 :])
        return replace(self, free=free, rows=rows, held=np.delete(self.held, k, axis=1))


def near_rows(system: System, rows: Array) -> Array:
    """Rows of parameters with the speed set to where a Hopf point is sought."""
    out = rows.copy()
    a1 = np.maximum(out[:, system.index("a1")], 1e-3)
    out[:, system.index("v")] = NEAR[0] * np.sqrt(NEAR[1] / a1)
    return out


def _from(base: HopfBatch, system: System, rows: Array) -> Array:
    """Rows of parameters that start at the Hopf points of a batch, where it has them."""
    out, column = rows.copy(), system.index("v")
    out[:, column] = np.where(base.found, base.values, rows[:, column])
    return out


def _part(batch: HopfBatch, k: int, size: int) -> HopfBatch:
    part = np.s_[k * size : (k + 1) * size]
    return HopfBatch(
        batch.parameter,
        batch.values[part],
        batch.frequencies[part],
        batch.lyapunov[part],
        batch.states[part],
        batch.outcomes[part],
    )


def problem(p: StudyParameters, vehicle: str, variant: Variant, data: pd.DataFrame) -> Problem:
    """The problem of fitting a vehicle, in a structure, to observations.

    What a reader changes is no longer free.
    """
    loaded = p.load(vehicle, given=(*UNCORRECTED, *variant.overrides))
    changed = {text.split("=")[0].strip() for text in p.changes.split(",") if text.strip()}
    free = tuple(one for one in variant.free if one.name not in changed)
    return problem_of(hunting_system(loaded), free, data)


def problem_of(system: System, free: tuple[Free, ...], data: pd.DataFrame) -> Problem:
    """The problem for a system whose parameters are a vehicle's."""
    texts = list(dict.fromkeys(data["changes"]))
    changes = [changes_of(text) for text in texts]
    rows = np.array([system.p(**change) for change in changes])
    held = np.array([[one.name in change for one in free] for change in changes], dtype=bool)
    which = np.array([texts.index(text) for text in data["changes"]])
    return Problem(system, data, free, rows, which, held.reshape(len(texts), -1), tolerance(data))


def coordinates(problem: Problem, values: Mapping[str, float]) -> Array:
    """Coordinates of given values, (free,)."""
    return np.array([one.coordinate(values[one.name]) for one in problem.free])
