"""Which printed numbers a vehicle was fitted to, so that agreement there is not taken for proof."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd


@dataclass(frozen=True)
class Fit:
    """Numbers of ``quantities`` under names beginning with ``place`` went into ``vehicle``."""

    place: str
    quantities: tuple[str, ...]
    vehicle: str
    remark: str


_TABLE_2 = "Fitted: a1 and a3 of this case were chosen so that this row comes out."
_QUINTIC = (
    "Fitted: the wheel load of section 3 was chosen so that the two polynomial rows come out."
)
_TABLE_3 = "Fitted: the unprinted values were chosen on Table 3's Hopf speeds and coefficients."
_BOTH = ("hopf_speed", "flc")

FITS: tuple[Fit, ...] = (
    Fit("Table 2: case 1, none", _BOTH, "guo2021_case1", _TABLE_2),
    Fit("Table 2: case 2, none", _BOTH, "guo2021_case2", _TABLE_2),
    Fit("Table 2: case 1, exponential", _BOTH, "guo2021_case1", _TABLE_2),
    Fit("Table 2: case 2, exponential", _BOTH, "guo2021_case2", _TABLE_2),
    Fit("Table 2: case 1, polynomial", _BOTH, "guo2021_case1", _QUINTIC),
    Fit("Table 2: case 2, polynomial", _BOTH, "guo2021_case2", _QUINTIC),
    Fit("Table 3:", _BOTH, "guo2021", _TABLE_3),
    Fit("Table 3:", _BOTH, "guo2021_m2", _TABLE_3),
)


def with_fits(table: pd.DataFrame, vehicle: str) -> pd.DataFrame:
    """A comparison whose fitted rows say so first in their reason; others are left as they are."""
    marked = table.copy()
    for fit in FITS:
        if fit.vehicle == vehicle:
            rows = table["item"].str.startswith(fit.place) & table["quantity"].isin(fit.quantities)
            marked.loc[rows, "reason"] = (fit.remark + " " + table.loc[rows, "reason"]).str.strip()
    return marked


def is_fitted(table: pd.DataFrame) -> pd.Series:
    """Which rows of a marked comparison a vehicle was fitted to."""
    return table["reason"].fillna("").str.startswith("Fitted:")
