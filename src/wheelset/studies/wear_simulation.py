"""Wear of a wheel, simulated: what the laws and the assumed operation make of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import pandas as pd
from pydantic import Field

from wheelset.profiles import conicity_table, equivalent_conicity, packaged
from wheelset.profiles.worn import LAWS, WornCurve, worn_header, worn_profiles
from wheelset.studies.on_profiles import on_profiles, searched, speeds_row
from wheelset.studies.parameters import StudyParameters, VehicleName
from wheelset.wear import (
    WEAR_LAWS,
    Operation,
    Simulation,
    Stepping,
    Strips,
    WearHistory,
    evolve,
    history_of,
    wear_law,
)

#: The pair whose wear is simulated, and the window in which Hopf points are looked for, m/s.
WHEEL, RAIL, WINDOW = "LMB10", "CHN60", (5.0, 300.0)

#: Conditions drawn, and the largest step and its error, m: coarser than for the packaged wheels,
#: with the conicity at the end the same to three digits.
COUNT, STEPPING = {"paper": 128, "quick": 32}, Stepping(6e-5, 4e-6)

#: Amplitudes at which conicities are compared, and the small one that is told, m.
AMPLITUDES, SMALL = np.arange(0.5, 8.01, 0.25) * 1e-3, 0.001

Law = Literal["archard_kth", "usfd", "zobory"]


class Parameters(StudyParameters):
    """Parameters of the study of simulated wear."""

    vehicle: VehicleName = Field(
        default="guo2021_physical",
        description="Packaged vehicle or path of a file: wheel load, radius, critical speeds.",
    )
    law: Law = Field(default="archard_kth", description="Law for which the operation is varied.")
    mileage: float = Field(default=18.5, gt=0, le=100, description="Mileage, 1e4 km.")
    field_rate: float = Field(
        default=0.055, gt=1e-4, le=1.0,
        description="Greatest wear over mileage, mm per 1e4 km.",
    )  # fmt: skip
    seed: int = Field(default=1, ge=0, description="Seed of the conditions drawn.")


@dataclass(frozen=True)
class Variant:
    """What is changed: the law, fields of the operation, the smoothing [m]."""

    law: str
    operation: Mapping[str, Any]
    smoothing: float = Strips().smoothing


@dataclass(frozen=True, eq=False)
class Outcome:
    """A variant's history, and the table of what it leads to at the last mileage."""

    name: str
    history: WearHistory
    conicity: pd.Series
    row: dict[str, object]


def variants(p: Parameters) -> dict[str, Variant]:
    """By name: all laws, then the law of the page under another operation."""
    laws = {law: Variant(law, {}) for law in WEAR_LAWS}
    changed = {
        "scatter 1.2 mm": Variant(p.law, {"displacement": 1.2e-3}),
        "scatter 2 mm": Variant(p.law, {"displacement": 2e-3}),
        "wheelset steers half": Variant(p.law, {"difference_share": 0.5}),
        "lateral creepage doubled": Variant(p.law, {"yaw": 2 * Operation().yaw}),
        "friction 0.4": Variant(p.law, {"friction": 0.4}),
        "smoothing 4 mm": Variant(p.law, {}, 4e-3),
    }
    every = {**laws, **changed}
    quick = (p.law, "scatter 2 mm")
    return {n: v for n, v in every.items() if p.resolution == "paper" or n in quick}


def outcomes(p: Parameters) -> tuple[Outcome, ...]:
    """Every variant simulated to the mileage, and put under the vehicle."""
    return tuple(_outcome(p, name, variant) for name, variant in variants(p).items())


def _outcome(p: Parameters, name: str, variant: Variant) -> Outcome:
    vehicle = p.load(p.vehicle)
    operation = Operation(**{"load": vehicle.values["p0"], **variant.operation})
    simulation = Simulation(
        packaged(WHEEL),
        packaged(RAIL),
        wear_law(variant.law),
        mileages=(p.mileage,),
        field_rate=p.field_rate,
        operation=operation,
        strips=Strips(smoothing=variant.smoothing),
        stepping=STEPPING,
        count=COUNT[p.resolution],
        seed=p.seed,
    )
    history = history_of(simulation, evolve(simulation))
    ((_, wheel),) = history.profiles()
    contact = searched(wheel, packaged(RAIL), vehicle)
    conicity = conicity_table(contact, AMPLITUDES).to_frame()["integration"]
    speeds = speeds_row(on_profiles(vehicle, contact, WINDOW))
    row: dict[str, object] = {
        "variant": name,
        "factor": history.factor,
        **{str(k): value for k, value in history.summary().iloc[0].items()},
        "conicity_1mm": equivalent_conicity(contact, SMALL).integration,
        **{key: speeds[key] for key in ("v_lin", "v_non", "amplitude")},
    }
    return Outcome(name, history, conicity, row)


def table(found: tuple[Outcome, ...]) -> pd.DataFrame:
    """A row a variant: factor; depths, band, conicity (mm, ``WearHistory.summary``); v_lin, v_non
    m/s, amplitude m.
    """
    return pd.DataFrame([outcome.row for outcome in found])


def depths(found: tuple[Outcome, ...]) -> pd.DataFrame:
    """Depth m at the mileage over y m (index), a column a variant."""
    y = pd.Index(found[0].history.y, name="y")
    return pd.DataFrame({one.name: one.history.depth[-1] for one in found}, index=y)


def conicities(found: tuple[Outcome, ...]) -> pd.DataFrame:
    """Equivalent conicity over the amplitude m (index), a column a variant."""
    return pd.DataFrame({one.name: one.conicity for one in found})


def packaged_depths() -> dict[str, pd.DataFrame]:
    """By law: depth m of the packaged worn wheels over y m (index), a column a mileage, 1e4 km."""
    y = np.linspace(-0.042, 0.030, 289)
    found = {}
    for law in LAWS:
        curves = {mileage: wheel.curve for mileage, wheel in worn_profiles(law).items()}
        removed = {m: c.removed(y) for m, c in curves.items() if isinstance(c, WornCurve)}
        found[law] = pd.DataFrame(removed, index=pd.Index(y, name="y"))
    return found


def provenance() -> dict[str, tuple[str, ...]]:
    """By law: how the packaged wheels were made, in lines."""
    return {law: worn_header(law) for law in LAWS}
