"""What the model's contact formulas stand for: Hertz's ellipse, and Kalker's table.

a: semi-axis along rolling, b: across; A, B: half the sums of curvatures in these directions.
Sources: Johnson, Contact Mechanics (1985), chapter 4; Kalker, Three-Dimensional Elastic Bodies in
Rolling Contact (1990).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from scipy.special import elliprd, elliprg

from wheelset.bifurcation.outcomes import NumericalOutcome

Array = NDArray[np.float64]

#: Kalker's coefficients, and the Poisson's ratios of his table.
COEFFICIENTS = ("C11", "C22", "C23", "C33")
POISSON = (0.0, 0.25, 0.5)


def curvature_ratio(k: ArrayLike) -> Array:
    """A/B of the ellipse with k = b/a, by complete elliptic integrals in Carlson's form.

    Hertz's pressure bends the surface by A ~ R_D(0, b2, a2) and B ~ R_D(0, a2, b2); these do not
    cancel near the circle as K - E does.
    """
    k2 = np.square(np.asarray(k, float))
    return np.asarray(elliprd(0, k2, 1) / elliprd(0, 1, k2))


def axis_ratio(ratio: ArrayLike) -> Array:
    """k = b/a of Hertz's ellipse for A/B > 0, the inverse of ``curvature_ratio``.

    Raises ValueError where A/B is not positive and finite.
    """
    wanted = np.asarray(ratio, float)
    if not (np.isfinite(wanted).all() and (wanted > 0).all()):
        raise ValueError(f"A/B = {wanted}: Hertz's ellipse needs finite values above 0")
    return np.reshape([_axis_ratio(q) for q in np.log(wanted).ravel()], wanted.shape)


def _axis_ratio(logarithm: float) -> float:
    # k lies between (A/B)^(1/2), of a line contact, and A/B
    low, high = sorted((0.5 * logarithm, logarithm))
    root = brentq(
        lambda x: float(np.log(curvature_ratio(np.exp(x)))) - logarithm,
        low - 1e-6,
        high + 1e-6,
        xtol=1e-14,
    )
    return float(np.exp(root))


def hertz_ellipse(A: ArrayLike, B: ArrayLike, N: float, E: float, nu: float) -> tuple[Array, Array]:
    """a b [m2] and b/a of two bodies of one material pressed together by N [N], exact.

    (a b)^(3/2) = 3 N (1 - nu2) / (pi E (A + B)) 2 R_G(0, k2, 1) / sqrt(k), where 2 R_G is the
    complete integral of the second kind for k <= 1. A, B in 1/m, E in Pa.
    """
    A, B = np.asarray(A, float), np.asarray(B, float)
    k = axis_ratio(A / B)
    integral = 2 * elliprg(0, np.square(k), 1) / np.sqrt(k)
    cube = 3 * N * (1 - nu**2) / (np.pi * E * (A + B)) * integral
    return cube ** (2 / 3), k


@cache
def kalker_table() -> pd.DataFrame:
    """Kalker's table: coefficient, k (b/a), and a column a Poisson's ratio; k ascends."""
    with files("wheelset.data").joinpath("kalker.csv").open(encoding="utf-8") as file:
        table = pd.read_csv(file, comment="#")
    tenths = table["tenths"] / 10
    table["k"] = tenths.where(table["axes"] == "b/a", 1 / tenths)
    table = table.rename(columns=dict(zip(("nu_0", "nu_25", "nu_50"), POISSON, strict=True)))
    return table[["coefficient", "k", *POISSON]].sort_values(["coefficient", "k"])


@cache
def table_ratios() -> Array:
    """The axis ratios k = b/a of Kalker's table, ascending."""
    return np.unique(kalker_table()["k"])


def tabulated(coefficient: str, nu: float) -> pd.Series:
    """A column of Kalker's table, indexed by k = b/a: the parabola in nu through its three values.

    Raises ValueError unless 0 <= nu <= 0.5.
    """
    if not 0 <= nu <= 0.5:
        raise ValueError(f"nu = {nu:g} is out of range; Kalker's table goes from 0 to 0.5")
    return pd.Series(_columns(coefficient) @ _weights(nu), table_ratios(), name=coefficient)


@cache
def _columns(coefficient: str) -> Array:
    """A coefficient by axis ratio and Poisson's ratio, shape (19, 3)."""
    rows = kalker_table()["coefficient"] == coefficient
    return kalker_table().loc[rows, list(POISSON)].to_numpy()


def _weights(nu: float) -> Array:
    """Lagrange's weights of the table's three Poisson's ratios."""
    u = nu / 0.25
    return np.array([(u - 1) * (u - 2) / 2, u * (2 - u), u * (u - 1) / 2])


@dataclass(eq=False)
class BeyondTable(NumericalOutcome):
    """An axis ratio that Kalker's table does not hold."""

    k: float

    def __str__(self) -> str:
        return f"b/a = {self.k:.3g} lies beyond Kalker's table, which goes from 0.1 to 10"


def kalker(coefficient: str, k: ArrayLike, nu: float) -> Array:
    """A coefficient between the table's axis ratios, by a cubic spline in logarithms.

    Raises BeyondTable outside 0.1 <= k <= 10.
    """
    at, column = np.asarray(k, float), tabulated(coefficient, nu)
    outside = (at < column.index[0]) | (at > column.index[-1])
    if outside.any():
        raise BeyondTable(float(at[outside].flat[0]))
    spline = CubicSpline(np.log(column.index), np.log(column))
    return np.asarray(np.exp(spline(np.log(at))))
