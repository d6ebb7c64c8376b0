"""Eigenvalues of small matrices, and the functions of them that vanish at bifurcations."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgeev

from wheelset.bifurcation.outcomes import NoConvergence

Array = NDArray[np.float64]
Spectrum = NDArray[Any]

#: An imaginary part this small, relative to the largest eigenvalue, is zero.
REAL = 1e-9


def eigenvalues(matrix: Array) -> Spectrum:
    """Eigenvalues, always complex; LAPACK directly, since small matrices are mostly overhead."""
    real, imaginary, _, _, info = dgeev(matrix, compute_vl=False, compute_vr=False)
    if info:
        raise NoConvergence("the eigenvalues of a Jacobian", ())
    return np.asarray(real + 1j * imaginary)


def pair_sums(values: Spectrum) -> float:
    """prod (l_i + l_j) / (|l_i| + |l_j|) over all pairs: zero at a pair +-iw, and at a pair +-a.

    1 for fewer than two eigenvalues.
    """
    i, j = _pairs(len(values))
    size = np.abs(values)
    factors = (values[i] + values[j]) / np.maximum(size[i] + size[j], np.finfo(float).tiny)
    return float(factors.prod().real)


def product(values: Spectrum, size: float) -> float:
    """prod l / (|l| + size): zero where an eigenvalue is; size: of a typical one, positive."""
    return float((values / (np.abs(values) + size)).prod().real)


@lru_cache(maxsize=64)
def _pairs(count: int) -> tuple[NDArray[Any], NDArray[Any]]:
    i, j = np.triu_indices(count, 1)
    return i, j


def closest_to_opposite(values: Spectrum) -> tuple[complex, complex]:
    """The two eigenvalues whose sum is smallest, relative to their size."""
    one, other = min(combinations(values, 2), key=_relative_sum)
    return complex(one), complex(other)


def _relative_sum(pair: tuple[complex, complex]) -> float:
    size = abs(pair[0]) + abs(pair[1])
    return abs(pair[0] + pair[1]) / size if size else 0.0


def is_real(value: complex, values: Spectrum) -> bool:
    """Whether an eigenvalue is real, to rounding relative to the largest one."""
    return bool(abs(value.imag) <= REAL * np.abs(values).max())
