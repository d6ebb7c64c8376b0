"""Which hidden values the printed numbers determine: singular values, and profiles of the cost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.studies.identification_fit import Fit, fit

Array = NDArray[np.float64]

#: Values for which a profile is drawn, and how far from the best one, in standard errors.
PROFILED, REACH = ("p0", "e0", "radius_offset"), 3.0

#: Points of a profile on each side of the best value.
SIDE = {"quick": 1, "paper": 4}

#: Where the fits of a profile stop, as a part of the cost.
STILL = 1e-3

#: A direction is called determined if its standard error is below this many typical changes.
DETERMINED = 0.5


@dataclass(frozen=True)
class Direction:
    """A combination of hidden values and its standard error, both in typical changes.

    weights: by name, of unit length.
    """

    error: float
    weights: dict[str, float]

    @property
    def determined(self) -> bool:
        """Whether the printed numbers fix it."""
        return self.error < DETERMINED


def directions(best: Fit) -> tuple[Direction, ...]:
    """The combinations of values at a fit, best determined first.

    From the singular values s of the Jacobian of the residuals (in tolerances) by the coordinates
    (in typical changes): the standard error is 1/s. Rows count as the soft loss weighs them.
    """
    base = best.problem.hopf(best.at)
    weight = (1 + best.problem.judged(base) ** 2) ** -0.25
    jacobian = best.problem.jacobian(best.at, base) * weight[:, np.newaxis]
    _, singular, rows = np.linalg.svd(jacobian, full_matrices=False)
    names = [one.name for one in best.problem.free]
    return tuple(
        Direction(float(1 / max(s, 1e-12)), dict(zip(names, _pointed(row), strict=True)))
        for s, row in zip(singular, rows, strict=True)
    )


def _pointed(row: Array) -> list[float]:
    """A direction with its greatest weight positive."""
    return [float(w) for w in row * np.sign(row[np.argmax(np.abs(row))])]


def direction_frame(found: tuple[Direction, ...]) -> pd.DataFrame:
    """One row a direction: number, error, determined, and a weight column for each name."""
    rows = [
        {"direction": k, "error": one.error, "determined": one.determined, **one.weights}
        for k, one in enumerate(found, 1)
    ]
    return pd.DataFrame(rows)


def error_of(best: Fit, name: str) -> float:
    """The standard error of one value, the others free, in typical changes."""
    return float(np.sqrt(sum((d.error * d.weights[name]) ** 2 for d in directions(best))))


def profile(best: Fit, name: str, side: int) -> pd.DataFrame:
    """The lowest cost with one value held, the others fitted again, on both sides of the best.

    Columns: name, value (SI), cost, excess (over the lowest).
    """
    free = {one.name: one for one in best.problem.free}
    k = list(free).index(name)
    middle, low, high = float(best.at[k]), *free[name].bounds
    reach = REACH * error_of(best, name) * np.linspace(0, 1, side + 1)[1:] ** 2
    rows = [(free[name].value(middle), best.cost)]
    for sign in (-1.0, 1.0):
        start = np.delete(best.at, k)
        for t in middle + sign * reach:
            if low < t < high:
                value = free[name].value(float(t))
                held = fit(best.problem.holding(name, value), [start], STILL)
                start = held.at
                rows.append((value, held.cost))
    frame = pd.DataFrame(sorted(rows), columns=["value", "cost"])
    return frame.assign(name=name, excess=frame["cost"] - frame["cost"].min())


def profiles(best: Fit, resolution: str) -> pd.DataFrame:
    """``profile`` of every value of ``PROFILED`` that is free."""
    names = [one.name for one in best.problem.free if one.name in PROFILED]
    names = names[:1] if resolution == "quick" else names
    frames = [profile(best, name, SIDE[resolution]) for name in names]
    columns = ["name", "value", "cost", "excess"]
    return pd.concat(frames)[columns] if frames else pd.DataFrame(columns=columns)
