"""What a set of hidden values gives for each printed number, fitted or not."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import brentq

from wheelset.bifurcation.equilibria.hopf_batch import hopf_batch
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System
from wheelset.studies.identification_problem import Problem, near_rows

Array = NDArray[np.float64]

#: A zero is sought between these multiples of the printed place, so that a near one is not taken
#: for a far one (a3: between wider ones, since it has only one), on so many points; a root is one
#: if the FLC there is this small beside the bracket's ends.
REACH, REACH_OF_A3, POINTS, SMALL = (0.4, 3.0), (-1.0, 3.0), 61, 1e-6


def predictions(problem: Problem, at: Array) -> pd.DataFrame:
    """The observations with what the values at the coordinates ``at`` give.

    Columns of the observations and computed (None where there is nothing), off (computed less
    printed in units of the last digit), words (why there is nothing).
    """
    batch, rows = problem.hopf(at), problem.rows_at(at)
    records = []
    for (_, row), k in zip(problem.data.iterrows(), problem.which, strict=True):
        if row["quantity"] == "gh_value":
            value, words = zero_near(
                problem.system, rows[k], str(row["parameter"]), float(row["printed"])
            )
        else:
            numbers = batch.values if row["quantity"] == "hopf_speed" else batch.lyapunov
            value, words = float(numbers[k]), str(batch.outcomes[k] or "")
        records.append(_record(row, None if words else value, words))
    return pd.DataFrame(records)


def _record(row: pd.Series, value: float | None, words: str) -> dict[str, object]:
    unit = 2 * float(row["half_unit"])
    off = None if value is None else (value - float(row["printed"])) / unit
    known = {str(name): number for name, number in row.items()}
    return {**known, "computed": value, "off": off, "words": words}


def zero_near(
    system: System, row: Array, parameter: str, printed: float
) -> tuple[float | None, str]:
    """The zero of the FLC nearest to a printed one along a parameter, from one row of parameters.

    None, and the reason in words, where there is none in the search.
    """
    reach = REACH_OF_A3 if parameter == "a3" else REACH
    low, high = sorted(printed * factor for factor in reach)
    flc = lyapunov_along(system, row, parameter)
    grid = np.linspace(low, high, POINTS)
    found = [x for a, b in _brackets(grid, flc(grid)) if (x := _root(flc, a, b)) is not None]
    if not found:
        return None, f"FLC has no zero at {parameter} = {low:.6g} to {high:.6g}"
    return min(found, key=lambda x: abs(x - printed)), ""


def lyapunov_along(system: System, row: Array, parameter: str) -> Callable[[Array], Array]:
    """The FLC at values of a parameter; NaN where a row has no Hopf point."""

    def flc(values: Array) -> Array:
        rows = np.tile(row, (len(values), 1))
        rows[:, system.index(parameter)] = values
        return hopf_batch(system, "v", near_rows(system, rows)).lyapunov

    return flc


def _brackets(grid: Array, values: Array) -> list[tuple[float, float]]:
    """Neighbours between which a function changes sign; gaps (NaN) are none."""
    ends = zip(grid, grid[1:], values, values[1:], strict=False)
    return [(float(a), float(b)) for a, b, fa, fb in ends if fa * fb < 0]


def _root(flc: Callable[[Array], Array], low: float, high: float) -> float | None:
    """The root in a bracket; None for a pole, or where the Hopf point is lost inside."""
    size = float(np.abs(flc(np.array([low, high]))).max())

    def at(value: float) -> float:
        result = float(flc(np.array([value]))[0])
        if np.isnan(result):
            raise NoConvergence("the Hopf point is lost inside a bracket", ())
        return result

    try:
        root = float(brentq(at, low, high, xtol=1e-10 * max(abs(low), abs(high))))
        return root if abs(at(root)) <= SMALL * size else None
    except NoConvergence:
        return None
