"""Systems with known answers, shared by the tests of the mathematics."""

from __future__ import annotations

import math
from collections.abc import Sequence

import sympy as sp

from wheelset.bifurcation.system import System

#: Toy wheelset: values on which closed form, MATCONT and AUTO-07p agree (a3 in 1/m2, SI).
TOY_HOPF = {"v": 50.22920722319, "frequency": 40.96847524544, "flc_at_a3_100": 3.453997012555}
#: Folds of its cycles by a3: v [m/s], T [s], b [1/s]; AUTO-07p and MATCONT to their print.
TOY_LPC = {
    100.0: (49.744661148, 0.153081670254, 82.99819),
    50.0: (50.01611031, 0.153229031, 77.451776),
}
#: Its generalised Hopf point: a3 [1/m2] and SLC.
TOY_GH = (0.0234438188506, -0.130504562189)
TOY = {
    "m": 1550.0, "I": 990.0, "Ky": 1e6, "Kx": 1e6, "r0": 0.46, "b": 0.75, "wp": 1.0,
    "a1": 0.23, "f11": 8e6, "f22": 8e6, "p1": 3.906e-4, "q": 1645.0,
}  # fmt: skip


def toy_wheelset(a3: float = 100.0, v: float = 50.0) -> System:
    """A wheelset with constant creep coefficients and the exponential flange."""
    scales = {"y": 1e-3, "psi": 1e-3, "yd": 4e-2, "psid": 4e-2}
    values = {**TOY, "a3": a3, "v": v}
    return System.from_function(_toy_field, ("y", "psi", "yd", "psid"), values, scales)


def _toy_field(x: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> list[sp.Expr]:
    y, psi, yd, psid = x
    m, inertia, Ky, Kx, r0, b, wp, a1, f11, f22, p1, q, a3, v = p
    flange = p1 * (sp.exp(q * y) - sp.exp(-q * y))
    lateral = -2 * Ky * y - 2 * f22 * (yd / v - psi) - flange
    yaw = (
        -2 * Kx * wp**2 * psi - 2 * f11 * b**2 * psid / v - 2 * f11 * b / r0 * (a1 * y + a3 * y**3)
    )
    return [yd, psid, lateral / m, yaw / inertia]


def closed_form_critical_speed(
    values: dict[str, float], flange_stiffness: float = 0.0
) -> tuple[float, float]:
    """(v [m/s], w [rad/s]) of a linear wheelset without contact stiffness; v nan: always stable.

    With k1 = 2 Ky + flange, k2 = 2 Kx wp^2, D1 = 2 f22, D2 = 2 f11 b^2:
    w^2 = (D1 k2 + D2 k1)/(m D2 + I D1),
    v^2 = w^2 D1 D2 / [4 f11 f22 b a1/r0 + (I w^2 - k2)(m w^2 - k1)].
    """
    m, inertia, a1 = values["m"], values["I"], values["a1"]
    k1, k2 = 2 * values["Ky"] + flange_stiffness, 2 * values["Kx"] * values["wp"] ** 2
    d1, d2 = 2 * values["f22"], 2 * values["f11"] * values["b"] ** 2
    w2 = (d1 * k2 + d2 * k1) / (m * d2 + inertia * d1)
    coupling = 4 * values["f11"] * values["f22"] * values["b"] * a1 / values["r0"]
    v2 = w2 * d1 * d2 / (coupling + (inertia * w2 - k2) * (m * w2 - k1))
    return (math.sqrt(v2) if v2 > 0 else math.nan), math.sqrt(w2)


def hopf_normal_form(
    mu: float = 0.0, omega: float = 2.0, a: float = -1.0, b: float = 0.5
) -> System:
    """r' = mu r + a r^3, phi' = omega + b r^2: Hopf at mu = 0, w = omega, cycle r^2 = -mu/a."""

    def f(x: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> list[sp.Expr]:
        (x1, x2), (m, w, c, d) = x, p
        r2 = x1**2 + x2**2
        return [m * x1 - w * x2 + r2 * (c * x1 - d * x2), w * x1 + m * x2 + r2 * (d * x1 + c * x2)]

    return System.from_function(f, ("x1", "x2"), {"mu": mu, "omega": omega, "a": a, "b": b})
