"""Eqs. (5), (6), (10), (11) alone: the model's own expressions, or exact ones in their place."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from wheelset.studies.contact_formulas_exact import COEFFICIENTS, hertz_ellipse, kalker
from wheelset.vehicle import ModelOptions, Vehicle
from wheelset.vehicle import quantities as q
from wheelset.vehicle.contact import wheel_equations
from wheelset.vehicle.symbols import p as symbol

Array = NDArray[np.float64]

#: What stands in place of the paper's fits, in words.
Against = Literal["Hertz", "Kalker", "both"]

#: The symbols of what is compared, by the name it has in tables.
COMPARED = {"ab": q.patch, "b/a": q.ratio, "f11": q.f11, "f22": q.f22, "f23": q.f23}
KALKER = {name: getattr(q, name) for name in COEFFICIENTS}


def evaluate(
    wanted: sp.Symbol, given: Mapping[sp.Symbol, ArrayLike], options: ModelOptions
) -> Array:
    """A quantity of the wheel equations where others are given, shape as they broadcast.

    The model's own equations are put into each other until only given symbols are left.
    """
    expression = sp.sympify(wanted)
    for equation in reversed(wheel_equations(options)):
        if equation.symbol not in given:
            expression = expression.xreplace({equation.symbol: equation.expression})
    values = [np.asarray(value, float) for value in given.values()]
    shape = np.broadcast_shapes(*(value.shape for value in values))
    return np.broadcast_to(sp.lambdify(list(given), expression)(*values), shape)


def wheel(
    ratio: ArrayLike, vehicle: Vehicle, against: Against | None = None, nu: float = 0.28
) -> dict[str, Array]:
    """Everything ``COMPARED`` at A/B under the vehicle's load, A = 1/(2 r0).

    against: what is exact instead of Eq. (6), Eq. (11) or both; nu: Poisson's ratio of Kalker's
    table. Raises BeyondTable where the table has no such b/a.
    """
    values, options = vehicle.values, vehicle.options
    A = np.full(np.shape(ratio), 1 / (2 * values["r0"]))
    load = {s: values[s.name] for s in (symbol.E, symbol.nu, symbol.f23_factor)}
    given = {q.A: A, q.B: A / np.asarray(ratio), q.N: values["p0"], **load}
    if against in ("Hertz", "both"):
        patch, k = hertz_ellipse(given[q.A], given[q.B], values["p0"], values["E"], values["nu"])
        given |= {q.patch: patch, q.ratio: k}
    if against in ("Kalker", "both"):
        k = evaluate(q.ratio, given, options)
        given |= {KALKER[name]: kalker(name, k, nu) for name in ("C11", "C22", "C23")}
    return {name: evaluate(s, given, options) for name, s in COMPARED.items()}


def fitted(coefficient: str, k: ArrayLike) -> Array:
    """One of Kalker's coefficients by Eq. (11) at b/a = k; C33 by the model's own fit."""
    return evaluate(KALKER[coefficient], {q.ratio: k}, ModelOptions(spin_moment="fit"))
