"""What the paper does not print: a search for the hidden values and structures behind its numbers.

Source of the numbers: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from pydantic import Field

from wheelset.hunting import hunting_system
from wheelset.studies.first_fold import SECTION_5, first_fold
from wheelset.studies.identification_data import SECTION_4, TABLE_3
from wheelset.studies.identification_fit import STANDS, Fit, fit, starts, unfitted
from wheelset.studies.identification_predict import predictions
from wheelset.studies.identification_problem import problem, problem_of
from wheelset.studies.identification_variants import REVERSED, UNCORRECTED, Variant, variants
from wheelset.studies.parameters import VehicleName, WindowParameters
from wheelset.studies.table_3 import TABLE_3_ROWS

#: So many of the best fits are refined, and fitted again from so many more starts.
AGAIN = {"quick": (1, 0), "paper": (3, 2)}

#: Zeros far outside what a wheelset has, which a fit would follow to the exclusion of the rest.
FAR = tuple(
    f"Section 4: GH {place}" for place in ("c1=1137.95", "e1=21023.16", "a1=11.14", "a1=38.14")
)

#: Rows of Table 3 whose fold of cycles is predicted.
FOLDS = {"quick": 1, "paper": 10}


#: Rows for which Table 3 prints no fold: their Hopf points are supercritical.
NO_FOLD = (("a3", -500.0), ("c1", -200.0))


class Parameters(WindowParameters):
    """Parameters of the search for the hidden values."""

    vehicle: VehicleName = Field(
        default="guo2021",
        description="Vehicle whose printed values are taken and whose hidden ones are sought.",
    )
    vehicle_second: VehicleName = Field(
        default="guo2021_m2", description="A second reading, judged beside the fits."
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical", description="The physically consistent reading."
    )
    vehicle_section_3: VehicleName = Field(
        default="guo2021_case1", description="Vehicle of section 3, whose load is sought."
    )


def group(data: pd.DataFrame, name: str) -> pd.DataFrame:
    """The observations of a group."""
    return data[data["group"] == name].reset_index(drop=True)


def search(p: Parameters, data: pd.DataFrame) -> list[tuple[Variant, Fit]]:
    """Every structure fitted to Table 3's Hopf points, the lowest cost first."""
    printed = group(data, TABLE_3)
    problems = [(one, problem(p, p.vehicle, one, printed)) for one in variants(p.resolution)]
    first = [(one, fit(of, starts(of, 1))) for one, of in problems]
    first.sort(key=lambda pair: pair[1].cost)
    best, more = AGAIN[p.resolution]
    again = [(one, _refined(found, more)) for one, found in first[:best]]
    return sorted([*again, *first[best:]], key=lambda pair: pair[1].cost)


def _refined(found: Fit, more: int) -> Fit:
    """A fit from where it ended, or a better one from more starts."""
    others = starts(found.problem, 1 + more)[1:]
    return fit(found.problem, [found.at, *others], STANDS)


def ranking(found: list[tuple[Variant, Fit]]) -> pd.DataFrame:
    """One row a structure: words, signs, corrected (whether corrections of f23 are free), cost, the
    worst speed and FLC in tolerances and in units of the last digit, the fitted values, unnatural.
    """
    return pd.DataFrame([{"words": one.words, **_numbers(one, best)} for one, best in found])


def _numbers(one: Variant, best: Fit) -> dict[str, object]:
    residuals = np.abs(best.problem.residuals(best.at))
    units = residuals * best.problem.tolerances / (2 * best.problem.data["half_unit"].to_numpy())
    speeds = (best.problem.data["quantity"] == "hopf_speed").to_numpy()
    return {
        "signs": "reversed" if REVERSED in one.choices else "physical",
        "corrected": "f23_factor" in best.values,
        "cost": best.cost,
        "speed": residuals[speeds].max(),
        "flc": residuals[~speeds].max(),
        "speed_units": units[speeds].max(),
        "flc_units": units[~speeds].max(),
        **best.values,
        "unnatural": ", ".join(best.unnatural),
    }


def honest(found: list[tuple[Variant, Fit]]) -> list[tuple[Variant, Fit]]:
    """The fits without corrections."""
    return [(one, best) for one, best in found if "f23_factor" not in best.values]


def vehicle_fit(p: Parameters, vehicle: str, data: pd.DataFrame) -> Fit:
    """A vehicle as it is filed, as a fit in which nothing is free."""
    return unfitted(problem_of(hunting_system(p.load(vehicle)), (), data))


def residual_table(fits: Mapping[str, Fit], data: pd.DataFrame) -> pd.DataFrame:
    """Every observation by every reading: ``predictions`` with a column reading."""
    frames = [
        predictions(problem_of(one.problem.system, one.problem.free, data), one.at).assign(
            reading=name
        )
        for name, one in fits.items()
    ]
    return pd.concat(frames, ignore_index=True)


def beside(table: pd.DataFrame, column: str = "computed") -> pd.DataFrame:
    """A residual table with one row an observation and one column a reading."""
    readings = {name: part.reset_index() for name, part in table.groupby("reading", sort=False)}
    first = next(iter(readings.values()))[["item", "quantity", "printed"]]
    return first.assign(**{str(name): part[column] for name, part in readings.items()})


def fitted_to_section_4(p: Parameters, one: Variant, data: pd.DataFrame) -> Fit:
    """A structure fitted to section 4's numbers instead of Table 3's, its far zeros left out."""
    rows = group(data, SECTION_4)
    of = problem(p, p.vehicle, one, rows[~rows["item"].isin(FAR)].reset_index(drop=True))
    return fit(of, starts(of, 1 + AGAIN[p.resolution][1]))


def folds(p: Parameters, one: Variant, best: Fit) -> pd.DataFrame:
    """The folds of cycles of Table 3's rows with fitted values, which no fit has used.

    Columns: item, quantity (lpc_speed), computed m/s (None: no fold), words.
    """
    rows = []
    for name, value in [row for row in TABLE_3_ROWS if row not in NO_FOLD][: FOLDS[p.resolution]]:
        given = (*UNCORRECTED, *one.overrides, *SECTION_5)
        vehicle = p.load(p.vehicle, given=given, rows={**best.values, name: value})
        found = first_fold(vehicle, p.window)
        speed = None if found.fold is None else float(found.fold.values[0])
        item = f"Table 3: {name}={value:g}"
        rows.append(
            {"item": item, "quantity": "lpc_speed", "computed": speed, "words": found.words}
        )
    return pd.DataFrame(rows)
