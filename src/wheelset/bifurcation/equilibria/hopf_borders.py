"""The minimally augmented condition of a Hopf point: A^2 + k has a plane of null vectors, k = w^2.

[[A^2 + k, W], [V^T, 0]] [q; g] = [0; c] gives g (2,), which vanishes where and only where A has the
eigenvalues +-sqrt(-k): a Hopf point for k > 0, a Bogdanov-Takens point for k = 0, a neutral saddle
for k < 0, and nothing special happens to the equations in between.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgetrf, dgetrs

from wheelset.bifurcation.curves.zero_problem import SingularSystem

Array = NDArray[np.float64]

#: det [c, R c] = c . turn R c in the plane.
TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])


@dataclass(frozen=True, eq=False)
class Borders:
    """left W and right V (n, 2), near the null vectors; c (2,) chooses q in their plane."""

    left: Array
    right: Array
    c: Array


class Condition(NamedTuple):
    """g (2,) with q (n,) and left null vectors psi (n, 2), dg = -psi^T d(A^2 + k) q."""

    g: Array
    q: Array
    psi: Array


def borders_at(A: Array, k: float) -> Borders:
    """Borders from the singular vectors of A^2 + k, with q as far from an eigenvector as can be.

    The latter keeps the condition regular at a Bogdanov-Takens point, where the plane holds one
    eigenvector only: c makes |det [c, R c]| largest, R the restriction of A to the plane.
    """
    left, _, right = np.linalg.svd(A @ A + k * np.eye(len(A)))
    plane = right[-2:].T
    form = TURN @ (plane.T @ A @ plane)
    sizes, vectors = np.linalg.eigh(form + form.T)
    return Borders(left[:, -2:], plane, vectors[:, np.argmax(np.abs(sizes))])


def condition(A: Array, k: float, borders: Borders) -> Condition:
    """Solve the bordered system and its transpose."""
    n = len(A)
    matrix = np.zeros((n + 2, n + 2), order="F")
    matrix[:n, :n] = A @ A
    matrix[range(n), range(n)] += k
    matrix[:n, n:], matrix[n:, :n] = borders.left, borders.right.T
    lu, pivots, info = dgetrf(matrix, overwrite_a=1)
    if info:
        raise SingularSystem("the bordered A^2 + w^2: another pair has the same frequency")
    units = np.eye(n + 2)[n:]
    q, _ = dgetrs(lu, pivots, borders.c @ units)
    # one right-hand side at a time: for two, OpenBLAS starts threads and waits for them
    psi = np.array([dgetrs(lu, pivots, unit, trans=1)[0][:n] for unit in units]).T
    return Condition(q[n:], q[:n], psi)
