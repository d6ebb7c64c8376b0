"""Section 6: wheels worn over a mileage, and the contact geometry they make, Figs 9 and 10.

The paper's measured profiles are not public. The wheels here are simulated (``wheelset.wear``) by
published laws from a stated operation, at the paper's mileages; nothing in them was fitted to a
number of the paper. Mileages are in 1e4 km, as in the paper.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 6, Figs 9 and 10.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from pydantic import AfterValidator, Field

from wheelset.profiles import Contact, Profile, load_profile, packaged
from wheelset.profiles.conicity import conicity_table
from wheelset.profiles.geometry import WIDTH
from wheelset.profiles.worn import WHEEL, worn_profiles
from wheelset.studies.on_profiles import searched
from wheelset.studies.parameters import VehicleName, WindowParameters

Array = NDArray[np.float64]

#: The wear laws whose worn wheels are packaged.
Law = Literal["archard_kth", "usfd"]

#: Mileages of Figs 9, 10 and 11, in 1e4 km; Table 4 has all that are packaged.
FIGURE_MILEAGES = (0.2, 4.8, 11.7, 14.5, 18.5)

#: Mileages of a quick look.
QUICK = (0.2, 11.7, 18.5)

#: Cycles of this amplitude come to the flange, m, where what they do hangs on the averaging width.
AT_THE_FLANGE = 9e-3

#: Amplitudes at which the equivalent conicity is computed, m, and the usual one.
AMPLITUDES, USUAL = np.arange(1, 20) * 0.5e-3, 3e-3


def _rail(name: str) -> str:
    load_profile(name, "rail")
    return name


class WearParameters(WindowParameters):
    """Parameters of the studies of section 6."""

    vehicle: VehicleName = Field(
        default="guo2021_physical",
        description="Vehicle on the profiles: packaged name or path of a vehicle file.",
    )
    rail: Annotated[str, AfterValidator(_rail)] = Field(
        default="CHN60", description="Rail: packaged name or path of a profile, new all the time."
    )
    law: Law = Field(
        default="archard_kth", description="Wear law of the wheels: archard_kth or usfd."
    )
    width: float = Field(
        default=WIDTH, ge=5e-5, le=5e-3,
        description="Width over which the contact is averaged for the model, m.",
    )  # fmt: skip

    @property
    def mileages(self) -> tuple[float, ...]:
        """Those computed: all, or a few for a quick look."""
        return tuple(worn_profiles(self.law)) if self.resolution == "paper" else QUICK


class Parameters(WearParameters):
    """Parameters of the study of Figs 9 and 10 and Table 4."""

    law_second: Law = Field(default="usfd", description="A second wear law, for comparison.")


def contacts(p: WearParameters, law: str | None = None) -> dict[float, Contact]:
    """The contact of the vehicle's wheelset on worn wheels, by mileage; both wheels are alike."""
    wheels, rail = worn_profiles(law or p.law), load_profile(p.rail, "rail")
    vehicle = p.load(p.vehicle)
    return {m: searched(wheels[m], rail, vehicle) for m in p.mileages}


# --- Fig. 9 ---------------------------------------------------------------------------------------


def profile_frame(law: str, half: float, spacing: float = 2e-4) -> pd.DataFrame:
    """Profiles at the figures' mileages within ``half`` [m]: mileage, y m, z m, depth m.

    The mileage 0 is the new wheel; depth is what wear has taken off its height.
    """
    worn = worn_profiles(law)
    wheels = {0.0: packaged(WHEEL), **{m: worn[m] for m in FIGURE_MILEAGES}}
    return pd.concat(
        [_profile_rows(m, wheel, wheels[0.0], half, spacing) for m, wheel in wheels.items()],
        ignore_index=True,
    )


def _profile_rows(
    mileage: float, wheel: Profile, new: Profile, half: float, spacing: float
) -> pd.DataFrame:
    y, z = wheel.points(spacing)
    inside = abs(y) <= half + 1e-12
    y, z = y[inside], z[inside]
    return pd.DataFrame({"mileage": mileage, "y": y, "z": z, "depth": new.z(y) - z})


# --- Fig. 10 --------------------------------------------------------------------------------------


def contact_frame(found: Mapping[float, Contact]) -> pd.DataFrame:
    """One wheel's contact over the wheelset's displacement towards its side.

    Columns: mileage, y m, r m (less what the radius at y = 0 has lost), delta rad, curvature 1/m of
    the wheel, rail_curvature 1/m.
    """
    return pd.concat([_contact_rows(*item) for item in found.items()], ignore_index=True)


def _contact_rows(mileage: float, contact: Contact) -> pd.DataFrame:
    left = contact.left
    lost = contact.setup.r0 - float(np.interp(0.0, contact.y, left.r))
    return pd.DataFrame(
        {
            "mileage": mileage,
            "y": contact.y,
            "r": left.r + lost,
            "delta": left.delta,
            "curvature": left.wheel_curvature,
            "rail_curvature": left.rail_curvature,
        }
    )


def conicity_frame(found: Mapping[float, Contact]) -> pd.DataFrame:
    """Equivalent conicity by amplitude: mileage, amplitude m, conicity; no row without a wave."""
    frames = []
    for mileage, contact in found.items():
        rows = conicity_table(contact, AMPLITUDES).to_frame()
        conicity = rows["integration"].to_numpy(float)
        columns = {"mileage": mileage, "amplitude": rows.index, "conicity": conicity}
        frames.append(pd.DataFrame(columns))
    return pd.concat(frames, ignore_index=True)


def conicity_at(conicity: pd.DataFrame, amplitude: float = USUAL) -> pd.Series:
    """The conicity at an amplitude [m], indexed by mileage."""
    found = conicity[np.isclose(conicity["amplitude"], amplitude)]
    return found.set_index("mileage")["conicity"]


def jump_frame(found: Mapping[float, Contact]) -> pd.DataFrame:
    """How often the contact of one wheel jumps: mileage, jumps, first (smallest |y|, m), largest (m
    of rolling radius); None without a jump.
    """
    return pd.DataFrame([_jumps(*item) for item in found.items()])


def _jumps(mileage: float, contact: Contact) -> dict[str, object]:
    mine = [jump for jump in contact.jumps if jump.side == "left"]
    return {
        "mileage": mileage,
        "jumps": len(mine),
        "first": min((abs(jump.y) for jump in mine), default=None),
        "largest": max((abs(jump.dr_step) for jump in mine), default=None),
    }
