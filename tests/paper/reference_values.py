"""Values that an independent code gave for the packaged vehicles (identification of 2026).

Not the paper's numbers: those are in wheelset.published. Speeds in m/s; first Lyapunov
coefficients in 1/s, MATCONT's normalisation; every number to its last given digit.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Reference:
    """A row of Table 3 computed for one vehicle; a3 = 200 unless a3 is the parameter.

    lpc_speed: with the exponential flange law counted once; None where none was found or asked.
    """

    parameter: str
    value: float
    hopf_speed: float
    flc: float
    lpc_speed: float | None = None
    flc_decimals: int = 2


@dataclass(frozen=True)
class Evaluation:
    """dx/dt at ``speed`` [m/s] and ``state`` (m, rad, m/s, 1/s) under a contact-angle sign."""

    contact_angle_sign: str
    speed: float
    state: tuple[float, float, float, float]
    derivative: tuple[float, float, float, float]


# fmt: off
M1: tuple[Reference, ...] = (
    Reference("a1", 0.05, 120.67, 30.47, 104.39),
    Reference("a1", 0.15, 64.33, 11.53, 62.21),
    Reference("a1", 0.25, 49.11, 6.60, 48.24),
    Reference("a1", 0.35, 41.25, 4.33, 40.78),
    Reference("a3", -500, 51.71, -23.28),
    Reference("a3", 200, 51.71, 7.41, 50.67),
    Reference("a3", 500, 51.71, 20.56, 48.57),
    Reference("a3", 5000, 51.71, 217.83, 31.48),
    Reference("c1", -200, 52.60, -19.57),
    Reference("c1", -50, 51.97, 8.04, 50.82),
    Reference("c1", 0, 51.77, 7.24, 50.75),
    Reference("c1", 200, 50.95, 86.72, 25.67),
)

M2: tuple[Reference, ...] = (
    Reference("a1", 0.05, 120.67, 31.40, 103.94),
    Reference("a1", 0.15, 64.33, 11.68, 62.20),
    Reference("a1", 0.25, 49.11, 6.58, 48.24),
    Reference("a1", 0.35, 41.24, 4.26, 40.78),
    Reference("a3", -500, 51.70, -23.83),
    Reference("a3", 200, 51.70, 7.41, 50.66),
    Reference("a3", 500, 51.70, 20.80, 48.56),
    Reference("a3", 5000, 51.70, 221.6, 31.49, flc_decimals=1),
    Reference("c1", -200, 52.62, -19.61),
    Reference("c1", -50, 51.97, 7.38, 50.93),
    Reference("c1", 0, 51.76, 7.28, 50.73),
    Reference("c1", 200, 50.98, 60.85),
)

ROWS: dict[str, tuple[Reference, ...]] = {"guo2021": M1, "guo2021_m2": M2}

# guo2021, no flange, linear creep
STATE = (0.003, 0.002, 0.05, -0.03)
EVALUATIONS: tuple[Evaluation, ...] = (
    Evaluation("reversed", 50.0, STATE, (0.05, -0.03, -1.31997941176, -6.9067249432)),
    Evaluation("physical", 50.0, STATE, (0.05, -0.03, -1.35450898455, -6.90663066338)),
)

# guo2021 at x = 0, v = 50 m/s: rows of the accelerations
JACOBIAN_ROWS: tuple[tuple[float, ...], ...] = (
    (-1284.476021, 2530.874021, -50.555442, -0.064907),
    (-1417.404280, -2025.306379, 0.101622, -43.471223),
)

HOPF_SPEED = 51.70606841  # m/s, guo2021
HOPF_FREQUENCY = 40.97664584  # rad/s
FLC_DEFAULT = -23.255255  # a3 = -499.40
FLC_SECTION_5 = 7.405071  # a3 = 200
# fmt: on
