"""Every number of the paper's tables and of the results in its text, typed once.

Speeds in m/s; first and second Lyapunov coefficients (FLC, SLC) in MATCONT's normalisation in the
SI state (y, psi, dy/dt, dpsi/dt); normal form coefficients (NFC) as MATCONT prints them. None
stands where the paper prints nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class PrintedParameter:
    """A row of Table 1, or a flange coefficient. ``si``: the SI value of one printed unit."""

    symbol: str
    meaning: str
    value: float
    unit_printed: str
    decimals: int = 0
    si: float = 1.0

    @property
    def si_value(self) -> float:
        """The printed value in SI units."""
        return self.value * self.si


@dataclass(frozen=True)
class FlangeHopf:
    """A row of Table 2: Hopf speed and FLC of a case under a flange model."""

    case: int
    flange: str
    hopf_speed: float
    flc: float


@dataclass(frozen=True)
class GeometryRow:
    """A row of Table 3: ``parameter`` = ``value``, all others as in section 5 (a3 = 200)."""

    parameter: str
    value: float
    hopf_speed: float
    flc: float
    lpc_speed: float | None = None
    nfc: float | None = None


@dataclass(frozen=True)
class WornProfile:
    """A row of Table 4: mileage in 10^4 km."""

    mileage: float
    hopf_speed: float
    flc: float


@dataclass(frozen=True)
class CyclePoint:
    """A bifurcation of limit cycles named in section 3's text, pp. 996-997."""

    case: int
    flange: str
    point: str
    speed: float
    nfc: float | None = None
    speed_decimals: int = 2
    nfc_decimals: int = 2


@dataclass(frozen=True)
class GeneralizedHopf:
    """A point where the FLC vanishes along ``parameter``: text of sections 4 and 5."""

    section: int
    parameter: str
    value: float
    slc: float | None = None
    value_decimals: int = 2
    slc_decimals: int = 2


@dataclass(frozen=True)
class Claim:
    """A quantitative statement of the text that is in no table."""

    section: int
    page: int
    quantity: str
    value: float
    unit: str
    decimals: int
    words: str


# fmt: off
TABLE_1: tuple[PrintedParameter, ...] = (  # p. 995
    PrintedParameter("mw", "Wheelset mass", 1550, "kg"),
    PrintedParameter("Iwz", "Yaw moment of inertia of wheelset", 990, "kg m2"),
    PrintedParameter("Kpx", "Longitudinal stiffness of primary suspension", 1, "MN/m", si=1e6),
    PrintedParameter("Kpy", "Lateral stiffness of primary suspension", 1, "MN/m", si=1e6),
    PrintedParameter("Cpx", "Longitudinal damping of primary suspension", 0, "kN s/m", si=1e3),
    PrintedParameter("Cpy", "Lateral damping of primary suspension", 0, "kN s/m", si=1e3),
    PrintedParameter("r0", "Wheel radius", 0.46, "m", 2),
    PrintedParameter("b", "Half of rolling radius lateral spacing", 0.75, "m", 2),
    PrintedParameter("wp", "Half of primary suspension lateral spacing", 1.0, "m", 1),
    PrintedParameter("a1", "Linear term of rolling radius", 0.23, "/m", 2),
    PrintedParameter("a3", "Cubic term of rolling radius", -499.40, "/m3", 2),
    PrintedParameter("c1", "Linear term of contact angle", 14.45, "/m", 2),
    PrintedParameter("c3", "Cubic term of contact angle", -44745.28, "/m3", 2),
    PrintedParameter(
        "e1", "Linear term of the nonlinear radius of curvature of wheel profile", 9.14, "/m", 2),
    PrintedParameter(
        "e3", "Cubic term of the nonlinear radius of curvature of wheel profile",
        -125311.23, "/m3", 2),
    PrintedParameter(
        "f1", "Linear term of the nonlinear radius of curvature of rail profile", 381.83, "/m", 2),
    PrintedParameter(
        "f3", "Cubic term of the nonlinear radius of curvature of rail profile",
        6616287.34, "/m3", 2),
)

FLANGE_COEFFICIENTS: tuple[PrintedParameter, ...] = (  # pp. 995-996; d1, d2: signs lost in print
    PrintedParameter("k0", "Piecewise flange stiffness (Eq. 24)", 1.617e7, "N/m", -4),
    PrintedParameter("eta", "Flange clearance (Eq. 24)", 0.00923, "m", 5),
    PrintedParameter("d1", "Quintic flange cubic coefficient (Eq. 25; magnitude)",
                     1.6e11, "N/m3", -10),
    PrintedParameter("d2", "Quintic flange quintic coefficient (Eq. 25; magnitude)",
                     1.6e15, "N/m5", -14),
    PrintedParameter("p1", "Exponential flange (Eq. 26)", 0.0003906, "N", 7),
    PrintedParameter("q1", "Exponential flange (Eq. 26)", -1645, "1/m"),
    PrintedParameter("p2", "Reciprocal flange (Eq. 27)", -1, "N m"),
    PrintedParameter("q2", "Reciprocal flange (Eq. 27)", 0.0112, "m", 4),
)

TABLE_2: tuple[FlangeHopf, ...] = (  # p. 996
    FlangeHopf(1, "none", 52.29, -11.17),
    FlangeHopf(1, "polynomial", 52.29, 278.45),
    FlangeHopf(1, "exponential", 52.29, -11.17),
    FlangeHopf(1, "reciprocal", 52.36, -11.42),
    FlangeHopf(2, "none", 52.29, 10.68),
    FlangeHopf(2, "polynomial", 52.29, 300.28),
    FlangeHopf(2, "exponential", 52.29, 10.68),
    FlangeHopf(2, "reciprocal", 52.36, 10.04),
)

SECTION_3_CYCLES: tuple[CyclePoint, ...] = (  # pp. 996-997
    CyclePoint(1, "reciprocal", "PD", 57.5, speed_decimals=1),
    CyclePoint(2, "none", "LPC", 50.40, 4914.921, nfc_decimals=3),
    CyclePoint(2, "none", "BPC", 50.40),
    CyclePoint(2, "none", "PD", 53.35, -2.36),
    CyclePoint(2, "polynomial", "LPC", 30.23, 942.21),
    CyclePoint(2, "polynomial", "BPC", 52.29),
    CyclePoint(2, "exponential", "LPC", 50.99, -9065.48),
    CyclePoint(2, "exponential", "BPC", 50.86),
    CyclePoint(2, "reciprocal", "LPC", 50.74, 44424.47),
    CyclePoint(2, "reciprocal", "BPC", 50.74),
    CyclePoint(2, "reciprocal", "BPC", 52.36),
    CyclePoint(2, "reciprocal", "PD", 51.37, -84.69),
)

SECTION_4_HOPF = GeometryRow("default", -499.40, 51.70, -28.01)  # p. 998; value is that of a3

GENERALIZED_HOPF: tuple[GeneralizedHopf, ...] = (  # pp. 998-999, the last one p. 1001
    GeneralizedHopf(4, "a1", 11.14),
    GeneralizedHopf(4, "a1", 38.14),
    GeneralizedHopf(4, "a3", 102.47, -30.01),
    GeneralizedHopf(4, "c1", 164.23, 82.46),
    GeneralizedHopf(4, "c1", 1137.95, 3.47e10, slc_decimals=-8),
    GeneralizedHopf(4, "e1", 21023.16),
    GeneralizedHopf(4, "e1", -2152.34),
    GeneralizedHopf(4, "f1", 21395.85),
    GeneralizedHopf(4, "f1", -1779.70),
    GeneralizedHopf(5, "c1", 1140.8416, value_decimals=4),
)

TABLE_3: tuple[GeometryRow, ...] = (  # p. 1001; a3 = 200 1/m2 but in its own rows (p. 1000)
    GeometryRow("a1", 0.05, 120.67, 30.91, 104.20, 61.77),
    GeometryRow("a1", 0.15, 64.34, 11.52, 62.16, 71.43),
    GeometryRow("a1", 0.25, 49.11, 6.55, 48.22, 90.92),
    GeometryRow("a1", 0.35, 41.25, 4.29, 40.74, 100.98),
    GeometryRow("a3", -500, 51.70, -25.22),
    GeometryRow("a3", 200, 51.70, 7.36, 50.65, 87.41),
    GeometryRow("a3", 500, 51.70, 21.32, 48.50, 102.12),
    GeometryRow("a3", 5000, 51.70, 230.72, 31.22, 141.01),
    GeometryRow("c1", -200, 52.62, -19.71),
    GeometryRow("c1", -50, 51.97, 8.01, 50.78, 90.17),
    GeometryRow("c1", 0, 51.76, 7.38, 50.69, 87.99),
    GeometryRow("c1", 200, 50.98, 59.72, 38.76, -57.78),
)

TABLE_4: tuple[WornProfile, ...] = (  # p. 1002
    WornProfile(0.2, 65.91, -0.81),
    WornProfile(4.8, 68.26, -0.82),
    WornProfile(6.8, 71.50, -0.84),
    WornProfile(9.4, 62.55, 0.73),
    WornProfile(11.7, 67.04, 0.85),
    WornProfile(14.5, 62.77, -0.18),
    WornProfile(18.5, 60.25, 0.70),
)

CLAIMS: tuple[Claim, ...] = (
    Claim(3, 996, "amplitude", 13, "mm", 0, "largest amplitude in Fig. 6, case 1 without flange"),
    Claim(5, 1001, "lpc_drop", 40.34, "%", 2, "fall of the LPC speed as a1 goes from 0.05 to 0.15"),
    Claim(5, 1001, "lpc_change", 0.1, "m/s", 1, "fall of the LPC speed over c3 from -1e5 to 1e5"),
    Claim(6, 1003, "stiffness_spread", 25, "%", 0, "largest variation of the stiffness in Fig. 11"),
)
# fmt: on


def frame(records: Sequence[Any]) -> pd.DataFrame:
    """The records (dataclass instances of one kind) as a table, one row each."""
    import pandas as pd

    return pd.DataFrame([asdict(record) for record in records])
