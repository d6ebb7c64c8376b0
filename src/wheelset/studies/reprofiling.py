"""When a wheel has to be re-profiled: the mileage at which a margin of speed is exhausted.

Three margins: the Hopf speed over a required one, the nonlinear critical speed (the lowest fold of
cycles) over another, and the suspension, which may be stiffened up to a limit to hold either. What
measurement noise leaves open is told by campaigns measured again and again. Mileages in 1e4 km.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from pydantic import Field, model_validator

from wheelset.profiles import Profile, load_profile, packaged
from wheelset.profiles.worn import WHEEL, worn_profiles
from wheelset.studies.parameters import Speed
from wheelset.studies.reprofiling_campaigns import Case, Plan, Progress, campaigns, cases, workers
from wheelset.studies.reprofiling_noise import Measurement
from wheelset.studies.reprofiling_speeds import coefficients, hopf_speeds
from wheelset.studies.worn_profiles import WearParameters

Array = NDArray[np.float64]

#: Ways to measure that are compared with that of the study, on fewer campaigns.
VARIANTS: dict[str, dict[str, float]] = {
    "average of 4 measurements": {"repeats": 4},
    "average of 16 measurements": {"repeats": 16},
    "and set off sideways by 0.1 mm": {"offset": 1e-4},
    "and tilted by 0.5 mrad": {"tilt": 5e-4},
}

#: Campaigns of a variant, and the most of a quick look.
VARIANT_SAMPLES, QUICK_SAMPLES = {"paper": 60, "quick": 20}, 100

#: Mileages of a quick look are every second one; steps towards a factor on the stiffnesses.
QUICK_STRIDE, STEPS = 2, 8


class Parameters(WearParameters):
    """Parameters of the study of re-profiling."""

    measured: str = Field(
        default="",
        description='Wheels of your own instead of simulated ones, by mileage in 1e4 km: "0=new.whl'
        ', 5=a.whl", packaged names or full paths; law is not used then.',
    )
    v_linear: Speed = Field(
        default=70.0, description="Hopf speed that has to be kept, m/s; the paper's 70."
    )
    v_nonlinear: Speed = Field(
        default=50.0,
        description="Nonlinear critical speed that has to be kept, m/s; the speed of operation "
        "with its margin.",
    )
    stiffness_limit: float = Field(
        default=1.5, ge=0.1, le=10.0,
        description="Largest factor on Kpx and Kpy that is allowed, dimensionless; 0.1 to 10.",
    )  # fmt: skip
    noise: float = Field(
        default=5e-6, ge=1e-7, le=1e-4,
        description="Noise of measured heights, white, standard deviation, m; 1e-7 to 1e-4.",
    )  # fmt: skip
    spacing: float = Field(
        default=2e-4, ge=5e-5, le=5e-4, description="Spacing of measured points, m; 5e-5 to 5e-4."
    )
    offset: float = Field(
        default=0.0, ge=0.0, le=1e-3,
        description="Standard deviation of a profile's place sideways, m; 0 to 1e-3.",
    )  # fmt: skip
    tilt: float = Field(
        default=0.0, ge=0.0, le=0.01,
        description="Standard deviation of a profile's tilt, rad; 0 to 0.01.",
    )  # fmt: skip
    samples: int = Field(
        default=1000, ge=10, le=100000, description="Campaigns drawn; quick: at most 100."
    )
    seed: int = Field(default=2021, ge=0, description="Of the random numbers.")
    processes: int = Field(default=2, ge=1, le=64, description="Processes that share the work.")

    @model_validator(mode="after")
    def _wheels_are_read(self) -> Parameters:
        if self.measured:
            assert self.wheels
        return self

    @cached_property
    def wheels(self) -> dict[float, Profile]:
        """By mileage, ascending: your own, or the new wheel and the simulated ones."""
        if self.measured:
            return _read(self.measured)
        known = {0.0: packaged(WHEEL), **worn_profiles(self.law)}
        stride = QUICK_STRIDE if self.resolution == "quick" else 1
        return dict(list(known.items())[::stride])

    @property
    def measurement(self) -> Measurement:
        """How the wheels are measured."""
        return Measurement(self.noise, self.spacing, self.offset, self.tilt)

    @property
    def campaigns(self) -> int:
        """How many are drawn."""
        return min(self.samples, QUICK_SAMPLES) if self.resolution == "quick" else self.samples


def _read(text: str) -> dict[float, Profile]:
    """Wheels by mileage from ``0=new.whl, 5=a.whl``."""
    wheels: dict[float, Profile] = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        mileage, found, name = part.partition("=")
        try:
            at = float(mileage)
        except ValueError:
            at = np.nan
        if not found or not 0 <= at <= 1e4 or at in wheels:
            raise ValueError(
                f'measured: "{part}" is not mileage=wheel with a mileage of its own between 0 and '
                "1e4, in 1e4 km; write 0=new.whl, 5=a.whl"
            )
        wheels[at] = load_profile(name.strip(), "wheel")
    if len(wheels) < 2:
        raise ValueError(f'measured: "{text}" holds {len(wheels)} wheels; give two or more')
    return dict(sorted(wheels.items()))


@dataclass(frozen=True, eq=False)
class Found:
    """The wheels as they are, all measured campaigns, and those of other ways to measure."""

    plan: Plan
    cases: tuple[Case, ...]
    table: pd.DataFrame
    variants: Mapping[str, pd.DataFrame]

    @property
    def mileages(self) -> Array:
        """In 1e4 km, ascending."""
        return np.array([case.mileage for case in self.cases])


def found(p: Parameters, progress: Progress = lambda done, of: None) -> Found:
    """Everything computed; the same for any number of processes."""
    vehicle, rail = p.load(p.vehicle, given=("flange_law=none",)), load_profile(p.rail, "rail")
    plan = Plan(vehicle, rail, p.window, p.width, p.stiffness_limit, p.measurement, p.seed)
    with workers(p.processes) as pool:
        known = cases(plan, p.wheels, pool)
        table = campaigns(plan, known, p.campaigns, pool, progress)
        others = {
            words: campaigns(_measured(plan, changes), known, VARIANT_SAMPLES[p.resolution], pool)
            for words, changes in VARIANTS.items()
        }
    return Found(plan, known, table, others)


def _measured(plan: Plan, changes: Mapping[str, float]) -> Plan:
    """Otherwise measured, smoothed alike."""
    return replace(plan, measurement=replace(plan.measurement, **changes))  # type: ignore[arg-type]


def speeds(p: Parameters, all_found: Found) -> pd.DataFrame:
    """One row a mileage.

    mileage; v_lin and v_non m/s of the wheel itself, amplitude m of its lowest fold; stiffness_lin,
    stiffness_non: factors on Kpx and Kpy that keep the required speeds; of the measured ones mean
    and standard deviation: lin_mean, lin_std, non_mean, non_std m/s; failed: samples without a Hopf
    speed. Missing for what there is not.
    """
    measured = all_found.table.groupby("mileage")
    stats = {
        f"{name}_{what}": getattr(measured[f"v_{name}"], what)()
        for name in ("lin", "non")
        for what in ("mean", "std")
    }
    failed = measured["words"].agg(lambda words: int((words != "").sum()))
    rows = pd.DataFrame([_row(p, all_found.plan, case) for case in all_found.cases])
    return rows.set_index("mileage").assign(**stats, failed=failed).reset_index()


def _row(p: Parameters, plan: Plan, case: Case) -> dict[str, float]:
    lowest = min(case.folds, key=lambda fold: fold.speed, default=None)
    return {
        "mileage": case.mileage,
        "v_lin": case.row["v_lin"] or np.nan,
        "v_non": lowest.speed if lowest else np.nan,
        "amplitude": lowest.amplitude if lowest else np.nan,
        "stiffness_lin": linear_stiffness(plan, case, p.v_linear),
        "stiffness_non": (p.v_nonlinear / lowest.speed) ** (1 / lowest.power) if lowest else np.nan,
    }


def linear_stiffness(plan: Plan, case: Case, required: float) -> float:
    """The factor on Kpx and Kpy with which the Hopf speed is the required one; NaN without one."""
    if case.row["v_lin"] is None:
        return np.nan
    named = coefficients(case.taylor, case.functions[np.newaxis])
    factor, near = 1.0, float(case.row["v_lin"])
    for _ in range(STEPS):
        point = hopf_speeds(plan.vehicle, named, near, factor)
        if not point.found[0]:
            return np.nan
        near = float(point.values[0])
        factor *= (required / near) ** 2  # speeds go about with the root of the stiffness
    return factor
