"""Wheel and rail profiles, where they touch, and the conicity of EN 15302."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Self

import numpy as np
import pandas as pd
from pydantic import Field, model_validator

from wheelset.profiles import (
    EN_15302,
    EN_15302_GRID,
    Contact,
    Profile,
    Setup,
    conicity_table,
    contact_geometry,
    equivalent_conicity,
    load_profile,
    packaged,
)
from wheelset.profiles.conicity import ConicityTable
from wheelset.profiles.geometry import WIDTH
from wheelset.studies.on_profiles import searched
from wheelset.studies.parameters import VehicleName, WindowParameters
from wheelset.vehicle import Vehicle

#: Equivalent conicity by integration at an amplitude of 3 mm in EN 15302, by reference wheel, on
#: reference rail A.
EN_15302_AT_3_MM = {"EN15302-A": 0.188, "EN15302-B": 0.030}

#: Amplitudes of conicities, m, the one they are quoted at, and within which jumps are counted.
AMPLITUDES, AT, NEAR = np.arange(1.0, 8.5, 0.5) * 1e-3, 0.003, 0.008

JUMP = ["side", "y", "u_from", "u_to", "dr_step"]

#: Spacing of the points profiles are drawn through, m.
DRAWN = 2e-4

Name = Annotated[str, Field(min_length=1)]


class Parameters(WindowParameters):
    """Parameters of the studies of a vehicle on profiles."""

    vehicle: VehicleName = Field(
        default="guo2021_physical",
        description="Packaged vehicle or path of a file; its contact polynomials are not used.",
    )
    wheel: Name = Field(
        default="LMB10", description="Packaged wheel profile or path of a measured one."
    )
    rail: Name = Field(
        default="CHN60", description="Packaged rail profile or path of a measured one."
    )
    gauge: float = Field(default=1.435, ge=0.5, le=2.0, description="Track gauge, m.")
    cant: float = Field(default=0.025, ge=0.0, le=0.2, description="Inclination of the rails, rad.")
    back_to_back: float = Field(
        default=1.353, ge=0.5, le=2.0, description="Distance of the wheels' back faces, m."
    )
    width: float = Field(
        default=WIDTH, ge=5e-5, le=5e-3,
        description="Standard deviation of the average over the displacement, m.",
    )  # fmt: skip
    v_max: float = Field(default=300.0, gt=0, le=1000, description="Upper end of the window, m/s.")

    @model_validator(mode="after")
    def _profiles_can_be_read(self) -> Self:
        assert self.profiles
        return self

    @cached_property
    def profiles(self) -> tuple[Profile, Profile]:
        """Wheel and rail; ProfileError, which is a ValueError, says what is wrong with one."""
        return load_profile(self.wheel, "wheel"), load_profile(self.rail, "rail")

    @property
    def track(self) -> Setup:
        """The track, without the vehicle's radius and base."""
        return Setup(gauge=self.gauge, cant=self.cant, back_to_back=self.back_to_back)

    @property
    def loaded(self) -> Vehicle:
        """The vehicle."""
        return self.load(self.vehicle)


def contact_of(p: Parameters) -> Contact:
    """The contact of the vehicle's wheelset with these profiles on this track."""
    return searched(*p.profiles, p.loaded, p.track)


def shapes(p: Parameters) -> dict[str, pd.DataFrame]:
    """By name of wheel and rail: y m, z m (down), curvature 1/m (positive where convex)."""
    return {profile.name: shape(profile) for profile in p.profiles}


def shape(profile: Profile) -> pd.DataFrame:
    """Points of a profile: y m, z m (down), curvature 1/m."""
    y, z = profile.points(DRAWN)
    return pd.DataFrame({"y": y, "z": z, "curvature": profile.curvature(y)})


def conicities(contact: Contact) -> ConicityTable:
    """Equivalent conicity by amplitude, as far as the contacts go."""
    room = 0.98 * min(-float(contact.y[0]), float(contact.y[-1]))
    return conicity_table(contact, AMPLITUDES[room >= AMPLITUDES])


def reference_conicities() -> pd.DataFrame:
    """The standard's conicities at 3 mm beside ours: wheel, printed, integration, limit.

    limit: the standard's tolerance, the smaller of 0.05 and half the value.
    """
    y = np.arange(-100, 101) * EN_15302_GRID
    rows = []
    for wheel, printed in EN_15302_AT_3_MM.items():
        contact = contact_geometry(packaged(wheel), packaged("EN15302-RailA"), EN_15302, y)
        ours = equivalent_conicity(contact, AT).integration
        limit = min(0.05, 0.5 * printed)
        rows.append({"wheel": wheel, "printed": printed, "integration": ours, "limit": limit})
    return pd.DataFrame(rows)


def pairs(p: Parameters) -> pd.DataFrame:
    """The packaged pairs on this track: wheel, rail, c0 rad and curvature sum rho 1/m of the
    centred wheelset, conicity at 3 mm, jumps within 8 mm.
    """
    rows = []
    for wheel in ("LMB10", "LMA", "S1002"):
        for rail in ("CHN60", "60E1"):
            contact = searched(packaged(wheel), packaged(rail), p.loaded, p.track)
            rows.append({"wheel": wheel, "rail": rail, **centred(contact)})
    return pd.DataFrame(rows)


def centred(contact: Contact) -> dict[str, float]:
    """c0 rad, rho 1/m of the left wheel at y = 0; conicity at 3 mm; jumps within 8 mm."""
    at = int(abs(contact.y).argmin())
    return {
        "c0": float(contact.left.delta[at]),
        "rho": float(contact.left.rho[at]),
        "conicity": equivalent_conicity(contact, AT).integration,
        "jumps": len([jump for jump in contact.jumps if abs(jump.y) < NEAR]),
    }


def jumps(contact: Contact) -> pd.DataFrame:
    """The contact's jumps: side, y m, u_from and u_to m on the wheel, dr_step m."""
    return pd.DataFrame([vars(jump) for jump in contact.jumps], columns=JUMP)
