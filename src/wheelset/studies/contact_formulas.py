"""How far the model's formulas of the contact are from what they stand for.

Eq. (6) beside Hertz's ellipse, Eq. (11) beside Kalker's table. Errors are relative: the formula
over what is exact, less 1.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
import pandas as pd
from pydantic import Field, field_validator
from scipy.optimize import minimize_scalar

from wheelset.profiles import load_profile
from wheelset.studies.contact_formulas_exact import (
    COEFFICIENTS,
    POISSON,
    Array,
    table_ratios,
    tabulated,
)
from wheelset.studies.contact_formulas_model import Against, fitted, wheel
from wheelset.studies.parameters import VehicleName, WindowParameters

_POINTS = {"quick": 61, "paper": 301}

#: What is compared: the reading of Eq. (6)'s shape factor, against what, and which quantities. The
#: axis ratio does not depend on the reading, and the ellipse not on Kalker's table.
CASES: tuple[tuple[str, Against, tuple[str, ...]], ...] = (
    ("inside", "Hertz", ("ab", "b/a", "f11", "f22", "f23")),
    ("outside", "Hertz", ("ab", "f11", "f22", "f23")),
    ("inside", "both", ("f11", "f22", "f23")),
)


class Parameters(WindowParameters):
    """Parameters of the study of the contact formulas."""

    vehicle: VehicleName = Field(
        default="guo2021", description="Name of a packaged vehicle or path of a vehicle file."
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical", description="The physically consistent reading."
    )
    wheel: str = Field(
        default="LMB10", description="Name of a packaged wheel profile or path of a profile file."
    )
    rail: str = Field(
        default="CHN60", description="Name of a packaged rail profile or path of a profile file."
    )
    reach: float = Field(
        default=0.006,
        gt=0.0,
        le=0.02,
        description="Largest displacement whose contacts are marked, m; up to 0.02.",
    )
    widest: float = Field(
        default=20.0,
        gt=1.0,
        le=30.0,
        description="Greatest A/B of Hertz's formulas, dimensionless; the least is its inverse; "
        "up to 30.",
    )
    nu: float = Field(
        default=0.28,
        ge=0.0,
        le=0.5,
        description="Poisson's ratio at which Kalker's table is taken, dimensionless; between "
        "the columns 0, 1/4 and 1/2 by the parabola through them.",
    )

    @property
    def vehicles(self) -> tuple[str, ...]:
        """Both vehicles, or the one that both are."""
        return tuple(dict.fromkeys((self.vehicle, self.vehicle_physical)))

    @field_validator("wheel")
    @classmethod
    def _is_wheel(cls, name: str) -> str:
        load_profile(name, "wheel")
        return name

    @field_validator("rail")
    @classmethod
    def _is_rail(cls, name: str) -> str:
        load_profile(name, "rail")
        return name


def hertz_errors(p: Parameters) -> pd.DataFrame:
    """Errors of Eq. (6), and of the creep coefficients that come from it, for ``CASES``.

    Columns: reading (of the shape factor: inside, outside the power 2/3), against (Hertz; both:
    Hertz and Kalker's table at nu), quantity (ab, b/a, f11, f22, f23), ratio (A/B), error.
    """
    ratio = np.geomspace(1 / p.widest, p.widest, _POINTS[p.resolution])
    frames = []
    for reading, against, names in CASES:
        vehicle = p.load(p.vehicle, rows={"shape_exponent": reading})
        exact, ours = wheel(ratio, vehicle, against, p.nu), wheel(ratio, vehicle)
        for name in names:
            columns = {"ratio": ratio, "error": ours[name] / exact[name] - 1}
            who = {"reading": reading, "against": against, "quantity": name}
            frames.append(pd.DataFrame({**who, **columns}))
    return pd.concat(frames, ignore_index=True)


def kalker_points(p: Parameters) -> pd.DataFrame:
    """Kalker's table: coefficient, nu (0, 1/4, 1/2 and the study's), k (b/a), value, error (of the
    fit).
    """
    frames = []
    for name in COEFFICIENTS:
        k, fit = table_ratios(), fitted(name, table_ratios())
        for nu in sorted({*POISSON, p.nu}):
            value = tabulated(name, nu).to_numpy()
            rows = {"coefficient": name, "nu": nu, "k": k, "value": value, "error": fit / value - 1}
            frames.append(pd.DataFrame(rows))
    return pd.concat(frames, ignore_index=True)


def kalker_curves(p: Parameters) -> pd.DataFrame:
    """The fits over the table's range: coefficient, k (b/a), value."""
    ends = table_ratios()
    k = np.geomspace(ends[0], ends[-1], _POINTS[p.resolution])
    frames = [
        pd.DataFrame({"coefficient": name, "k": k, "value": fitted(name, k)})
        for name in COEFFICIENTS
    ]
    return pd.concat(frames, ignore_index=True)


def poisson(p: Parameters) -> pd.DataFrame:
    """Root mean square of the fits' errors over the table: coefficient, nu, rms."""
    grid = np.linspace(*POISSON[::2], _POINTS[p.resolution])
    frames = [
        pd.DataFrame({"coefficient": name, "nu": grid, "rms": [rms(nu) for nu in grid]})
        for name, rms in _mean_errors().items()
    ]
    return pd.concat(frames, ignore_index=True)


def best_poisson() -> pd.DataFrame:
    """The Poisson's ratio that each fit stands for, by least squares: coefficient, nu, rms."""
    rows = []
    for name, rms in _mean_errors().items():
        found = minimize_scalar(rms, bounds=POISSON[::2])
        rows.append({"coefficient": name, "nu": float(found.x), "rms": float(found.fun)})
    return pd.DataFrame(rows)


def _mean_errors() -> dict[str, Callable[[float], float]]:
    """By coefficient, the root mean square of its fit's errors as a function of nu."""
    return {name: partial(_mean_error, name, fitted(name, table_ratios())) for name in COEFFICIENTS}


def _mean_error(coefficient: str, fit: Array, nu: float) -> float:
    return float(np.sqrt(np.mean((fit / tabulated(coefficient, nu).to_numpy() - 1) ** 2)))


def thin_limits(p: Parameters) -> pd.DataFrame:
    """Far beyond the table, b/a -> infinity, where rolling is plane: coefficient, exact, fit.

    Kalker (1990): C11 -> pi2 / (4 (1 - nu)), C22 -> pi2 / 4, C23 -> 0 as the root of a/b.
    """
    exact = {"C11": np.pi**2 / (4 * (1 - p.nu)), "C22": np.pi**2 / 4, "C23": 0.0}
    rows = [
        {"coefficient": name, "exact": value, "fit": float(fitted(name, np.inf))}
        for name, value in exact.items()
    ]
    return pd.DataFrame(rows)
