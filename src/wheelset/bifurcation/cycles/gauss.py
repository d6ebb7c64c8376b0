"""Gauss collocation: nodes, Runge-Kutta coefficients and interpolation on one interval.

A polynomial of degree m on [0, 1] is kept as its value at 0 and at the m Gauss points: the values
x_j and X_j1 ... X_jm of one mesh interval. In the Runge-Kutta form of collocation

    X_i = x_j + h sum_l a_il f(X_l),   x_{j+1} = end x_j + sum_i d_i X_i,

the second line evaluates the polynomial at 1 (it equals x_j + h sum_l b_l f(X_l)).
Mesh values converge with order 2 m, values in between with order m + 1.
Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


#: Degree of a cycle's polynomials: mesh values converge with order 8.
DEGREE = 4


@dataclass(frozen=True, eq=False)
class Gauss:
    """The Gauss method of m stages.

    c (m,): nodes in (0, 1); a (m, m), b (m,): Runge-Kutta coefficients and quadrature weights;
    end, d (m,): the polynomial at 1 is ``end`` times its value at 0 plus d . stages.
    """

    c: Array
    a: Array
    b: Array
    end: float
    d: Array

    @property
    def m(self) -> int:
        """Number of stages, the degree of the polynomial."""
        return len(self.c)

    @cached_property
    def nodes(self) -> Array:
        """0 and the Gauss points, (m + 1,)."""
        return np.concatenate([[0.0], self.c])

    def basis(self, at: ArrayLike) -> Array:
        """Lagrange basis on (0, c_1, ..., c_m) at points of [0, 1], shape at.shape + (m + 1,)."""
        nodes = self.nodes
        points = np.asarray(at, dtype=np.float64)[..., np.newaxis]
        gaps = nodes[:, np.newaxis] - nodes
        columns = [
            np.prod((points - np.delete(nodes, i)) / np.delete(gaps[i], i), axis=-1)
            for i in range(len(nodes))
        ]
        return np.stack(columns, axis=-1)

    @cached_property
    def at_one(self) -> tuple[float, ...]:
        """Weights (m + 1,) of the values that give the polynomial at 1: end, d_1 .. d_m."""
        return self.end, *self.d.tolist()

    @cached_property
    def at_zero(self) -> Array:
        """Weights (m,) of the values at the Gauss points that extrapolate to 0."""
        products = [np.delete(-self.c, i) / np.delete(x - self.c, i) for i, x in enumerate(self.c)]
        return np.array([product.prod() for product in products])

    @cached_property
    def highest(self) -> Array:
        """Weights (m + 1,) of the values that give the derivative of order m."""
        nodes = self.nodes
        leading = [1 / np.prod(x - np.delete(nodes, i)) for i, x in enumerate(nodes)]
        return np.array(leading) * math.factorial(self.m)

    @cached_property
    def slopes(self) -> Array:
        """Derivative at the nodes, shape (m, m + 1): rows c_1..c_m, columns 0, c_1..c_m.

        [-b 1, b] with b = a^-1: stages obey sum_l b_il (X_l - x_j) = h f(X_i).
        """
        inverse = np.linalg.inv(self.a)
        return np.column_stack([-inverse.sum(axis=1), inverse])


@lru_cache(maxsize=8)
def gauss(m: int = DEGREE) -> Gauss:
    """The Gauss method of m stages (m >= 1)."""
    nodes, weights = np.polynomial.legendre.leggauss(m)
    c, b = (nodes + 1) / 2, weights / 2
    powers = np.arange(1, m + 1)
    vandermonde = c[:, np.newaxis] ** (powers - 1)
    columns = np.linalg.solve(vandermonde.T, (c[:, np.newaxis] ** powers / powers).T)
    a: Array = np.ascontiguousarray(columns.T, dtype=np.float64)
    d: Array = np.asarray(np.linalg.solve(a.T, b), dtype=np.float64)
    return Gauss(c, a, b, float(1 - d.sum()), d)
