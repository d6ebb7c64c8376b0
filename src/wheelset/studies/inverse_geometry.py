"""Section 6, asked backwards: which contact geometries have Table 4's speeds and coefficients?

In the model with cubic polynomials the Hopf speed is governed by a1, and the first Lyapunov
coefficient (FLC) is linear in a3. So every printed pair is reached by one a1 and one a3, given the
rest of the geometry; what else could have changed is told by how far both move with it.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 6, Table 4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from pydantic import Field

from wheelset.bifurcation.equilibria.hopf import HopfPoint, instabilities
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.parameters import StudyParameters, VehicleName
from wheelset.studies.stiffness_curves import first_point, hopf_stiffness
from wheelset.studies.stiffness_tables import required

#: Values of a1 between which the Hopf point is sought: a cone of a thousandth to one of a half.
A1 = (0.001, 0.5)

#: A second a3, 1/m2: FLC is linear in it, so that any one will do.
OTHER_A3 = 1000.0

#: The physical vehicle's printed curvature terms make its sum of curvatures vanish at a millimetre.
CONSTANT_CURVATURE = ("e1=0", "f1=0", "e3=0", "f3=0")

#: The speed of Fig. 11, m/s.
KEPT = 70.0

#: Other things a printed coefficient could be: name, and what ours is to be multiplied by, given
#: the frequency in rad/s. A state in mm multiplies |x|^-2 by 1e-6.
READINGS: tuple[str, ...] = ("as MATCONT prints it", "divided by the frequency", "state in mm")


class Parameters(StudyParameters):
    """Parameters of the study of the inverse question."""

    vehicle: VehicleName = Field(
        default="guo2021", description="Name of a packaged vehicle or path of a vehicle file."
    )
    vehicle_physical: VehicleName = Field(
        default="guo2021_physical",
        description="The physically consistent reading, with constant curvatures.",
    )

    def given(self, vehicle: str) -> tuple[str, ...]:
        """What the study gives a vehicle."""
        return CONSTANT_CURVATURE if vehicle == self.vehicle_physical else ()


@dataclass(frozen=True)
class Inverse:
    """The a1 with a printed Hopf speed and the a3 with a printed FLC.

    frequency: rad/s. slope: dFLC/da3, m2/s. neutral: the a3 at which FLC vanishes (GH), 1/m2.
    """

    a1: float
    frequency: float
    slope: float
    neutral: float

    def a3(self, flc: float, reading: str = READINGS[0]) -> float:
        """The a3 [1/m2] at which the coefficient so read has a value."""
        return self.neutral + flc / (self.slope * factor(reading, self.frequency))


def factor(reading: str, frequency: float) -> float:
    """What MATCONT's coefficient is multiplied by in one of ``READINGS``."""
    return dict(zip(READINGS, (1.0, 1 / frequency, 1e-6), strict=True))[reading]


def inverse(system: System, speed: float) -> Inverse | None:
    """The geometry with its Hopf point at a speed [m/s]; None if no a1 has it there."""
    first, second = (_at(system, speed, a3) for a3 in (0.0, OTHER_A3))
    if first is None or second is None:
        return None
    assert first.lyapunov is not None and second.lyapunov is not None
    slope = (second.lyapunov - first.lyapunov) / OTHER_A3
    return Inverse(first.value, first.frequency, slope, -first.lyapunov / slope)


def _at(system: System, speed: float, a3: float) -> HopfPoint | None:
    """The Hopf point of least a1 at a speed: with less conicity the wheelset is stable there."""
    points = instabilities(system.with_values(v=speed, a3=a3), "a1", A1)
    return next((q for q in points if isinstance(q, HopfPoint)), None)


def inverse_frame(
    p: Parameters,
    vehicle: str,
    printed: Sequence[tuple[float, float, float]],
    rows: Sequence[str] = (),
) -> pd.DataFrame:
    """The geometry of every printed row (mileage 1e4 km, Hopf speed m/s, FLC).

    rows: further changes to the vehicle. Columns: mileage, v m/s, flc, a1, frequency rad/s, slope
    m2/s, neutral 1/m2, and the a3 of every reading of the FLC, named by it; NaN where no a1 has
    the speed.
    """
    system = hunting_system(p.load(vehicle, given=p.given(vehicle), rows=rows))
    return pd.DataFrame([_row(system, *row) for row in printed]).astype(float)


def _row(system: System, mileage: float, speed: float, flc: float) -> dict[str, float | None]:
    row: dict[str, float | None] = {"mileage": mileage, "v": speed, "flc": flc}
    found = inverse(system, speed)
    if found is None:
        return {**row, **dict.fromkeys(("a1", "frequency", "slope", "neutral", *READINGS))}
    numbers = {
        name: float(getattr(found, name)) for name in ("a1", "frequency", "slope", "neutral")
    }
    return {**row, **numbers, **{r: found.a3(flc, r) for r in READINGS}}


def forward_frame(p: Parameters, vehicle: str, table: pd.DataFrame, reading: str) -> pd.DataFrame:
    """Hopf speed [m/s] and FLC (read so) computed from the a1 and a3 of ``inverse_frame``.

    Columns: mileage, v, flc: the printed numbers again.
    """
    system = hunting_system(p.load(vehicle, given=p.given(vehicle)))
    rows = []
    for row in table.dropna(subset=["a1"]).to_dict("records"):
        there = system.with_values(a1=row["a1"], a3=row[reading])
        points = instabilities(there, "v", (0.5 * row["v"], 1.5 * row["v"]))
        hopf = next(q for q in points if isinstance(q, HopfPoint))
        flc = np.nan if hopf.lyapunov is None else hopf.lyapunov
        rows.append((row["mileage"], hopf.value, flc * factor(reading, hopf.frequency)))
    return pd.DataFrame(rows, columns=["mileage", "v", "flc"])


def readings_frame(table: pd.DataFrame, compared: tuple[float, float]) -> pd.DataFrame:
    """What each reading of the FLC asks of a3.

    compared: the range of a3 that section 5 goes through, 1/m2. Columns: reading, least and
    greatest a3, tuned (largest distance from a3's neutral value over that range's width), inside
    (rows within the range, as a part).
    """
    rows = []
    for reading in READINGS:
        a3 = table[reading]
        tuned = float((a3 - table["neutral"]).abs().max() / (compared[1] - compared[0]))
        rows.append((reading, a3.min(), a3.max(), tuned, float(a3.between(*compared).mean())))
    return pd.DataFrame(rows, columns=["reading", "least", "greatest", "tuned", "inside"])


def stiffness_frame(p: Parameters, vehicle: str, table: pd.DataFrame, reading: str) -> pd.DataFrame:
    """The stiffness that keeps the Hopf speed at 70 m/s on the geometries of ``inverse_frame``.

    Columns: mileage, alike and longitudinal N/m (see ``stiffness_curves.required``).
    """
    system = hunting_system(p.load(vehicle, given=p.given(vehicle)))
    rows = []
    for row in table.dropna(subset=["a1"]).to_dict("records"):
        found = first_point(system.with_values(a1=row["a1"], a3=row[reading], v=KEPT))
        curve = None if found is None else hopf_stiffness(*found)
        rows.append({"mileage": row["mileage"], **required(curve)})
    return pd.DataFrame(rows).astype(float)
