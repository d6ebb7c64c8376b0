"""The named structural choices in which readings of the paper differ.

They are options of one model, not copies of it. Every default is what physics
and the printed equations say; a vehicle file sets them in its ``[model]`` table.
"""

from __future__ import annotations

from typing import Literal, get_args

from pydantic import BaseModel, ConfigDict, Field

ContactAngleSign = Literal["physical", "reversed"]
LateralCreepageCosine = Literal["included", "omitted"]
NormalForce = Literal["vertical", "constant"]
ShapeExponent = Literal["inside", "outside"]
TransverseCurvature = Literal["half", "full"]
CreepLaw = Literal["linear", "shen_hedrick_elkins"]
SpinMoment = Literal["none", "fit"]
LateralSpinMoment = Literal["plus", "minus"]
FlangeLaw = Literal["none", "piecewise_linear", "quintic", "exponential", "reciprocal"]
FlangeWheels = Literal[1, 2]


class ModelOptions(BaseModel):
    """Structural options of the wheelset model; s = +1 left, -1 right, g = delta + s phi."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    contact_angle_sign: ContactAngleSign = Field(
        default="physical",
        description=(
            "Sign of the contact-angle terms in Eq. (8) and in the spin creepage of Eq. (9). "
            "physical: Fyn = -s p0 tan(g), xi_s = -s sin(g)/r0 + ...; gravity centres the "
            "wheelset. reversed: both terms with +s, which the printed numbers want."
        ),
    )
    lateral_creepage_cosine: LateralCreepageCosine = Field(
        default="included",
        description=(
            "Factor of the lateral creepage in Eq. (9). included: xi_y = (y'/v - psi) cos(g). "
            "omitted: xi_y = y'/v - psi."
        ),
    )
    normal_force: NormalForce = Field(
        default="vertical",
        description=(
            "What the wheel load p0 is. vertical: the vertical part of the contact force, "
            "N = p0 / cos(g), Fyn of size p0 tan(g), Eqs. (7) and (8). constant: the normal force "
            "itself, N = p0, Fyn of size p0 sin(g)."
        ),
    )
    shape_exponent: ShapeExponent = Field(
        default="inside",
        description=(
            "Where the factor [(1 + A/B) / (2 sqrt(A/B))]^0.63 of Eq. (6) stands. inside: under "
            "the power 2/3, as printed. outside: beside it."
        ),
    )
    transverse_curvature: TransverseCurvature = Field(
        default="half",
        description=(
            "B of Eq. (5) from the sum of curvatures rho. half: B = rho / 2, as printed. "
            "full: B = rho."
        ),
    )
    creep_law: CreepLaw = Field(
        default="linear",
        description=(
            "Creep forces. linear: Eq. (10) alone, as in all bifurcation work of the paper. "
            "shen_hedrick_elkins: saturated at mu N by Eqs. (12) and (13); needs mu."
        ),
    )
    spin_moment: SpinMoment = Field(
        default="none",
        description=(
            "Kalker's C33 in Eq. (10), which Eq. (11) leaves out. none: C33 = 0. "
            "fit: C33 = 0.3501 + 0.8051 k + 0.0596/(1 + k), k = eb/ea."
        ),
    )
    lateral_spin_moment: LateralSpinMoment = Field(
        default="plus",
        description=(
            "Sign of the lateral creepage's moment in Eq. (10). plus: Mz = f23 xi_y - f33 xi_s, as "
            "printed. minus: Mz = -f23 xi_y - f33 xi_s."
        ),
    )
    flange_law: FlangeLaw = Field(
        default="none",
        description=(
            "Flange force Ft(y). none: no force. piecewise_linear: Eq. (24), needs k0, eta. "
            "quintic: Eq. (25), needs d1, d2. exponential: Eq. (26), needs p1, q1. "
            "reciprocal: Eq. (27), needs p2, q2."
        ),
    )
    flange_wheels: FlangeWheels = Field(
        default=1,
        description=(
            "How many times the force of Eqs. (24)-(27) acts on the wheelset. 1: once. "
            "2: once for each wheel."
        ),
    )


def option_names() -> tuple[str, ...]:
    """Names of the options, in the order of the class."""
    return tuple(ModelOptions.model_fields)


def allowed_values(option: str) -> tuple[str | int, ...]:
    """Values which ``option`` may take; KeyError if there is no such option."""
    return get_args(ModelOptions.model_fields[option].annotation)


def option_meaning(option: str) -> str:
    """What ``option`` chooses and what each of its values means."""
    return ModelOptions.model_fields[option].description or ""
