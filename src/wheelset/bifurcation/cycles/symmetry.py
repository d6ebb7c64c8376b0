"""Symmetry under a change of signs, f(S x) = S f(x): found by checking, never assumed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.outcomes import NumericalOutcome, as_tuple
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: States at which the symmetry is checked, and the relative difference that counts as rounding.
SAMPLES, ROUNDING = 64, 1e-11

#: Sizes tried, in turn, where the field is not defined at the states drawn.
SHRINK = (1.0, 0.1, 1e-2, 1e-3)


@dataclass(eq=False)
class NotSymmetric(NumericalOutcome):
    """Half a period was asked for, but the field lacks the symmetry.

    signs: of S. state: where f(S x) differs most from S f(x). defect: by how much, relative to f.
    """

    signs: tuple[float, ...]
    state: tuple[float, ...]
    state_names: tuple[str, ...]
    defect: float

    def __str__(self) -> str:
        at = ", ".join(f"{n} = {v:.4g}" for n, v in zip(self.state_names, self.state, strict=True))
        return (
            f"not symmetric: f(S x) and S f(x) differ by {self.defect:.2g} of |f| at {at} for "
            f"S = diag{self.signs}; use the full period"
        )


def symmetry_defect(
    system: System, p: Array, signs: ArrayLike, scales: Array, about: Array
) -> tuple[float, Array]:
    """The greatest |f(S x) - S f(x)| relative to |f| over states around ``about``, and where.

    The states are always the same ones, with sizes from a hundredth of ``scales`` to them, or
    smaller where the field is not defined so far out.
    """
    random = np.random.default_rng(20210)
    away = scales * 10 ** random.uniform(-2, 0, (SAMPLES, 1))
    away = away * random.standard_normal((SAMPLES, system.n))
    S = np.asarray(signs)
    for shrink in SHRINK:
        try:
            x = about + shrink * away
            f, mirrored = system.rhs(x, p), system.rhs(S * x, p)
            break
        except NumericalOutcome:
            if shrink == SHRINK[-1]:
                raise
    differences = np.linalg.norm((mirrored - S * f) / scales, axis=1)
    relative = differences / np.linalg.norm(f / scales, axis=1)
    worst = int(np.argmax(relative))
    return float(relative[worst]), x[worst]


def has_symmetry(system: System, p: Array, signs: ArrayLike, scales: Array, about: Array) -> bool:
    """Whether f(S x) = S f(x) to rounding, and S leaves the point ``about`` in its place."""
    still = np.abs(np.asarray(signs) * about - about) <= ROUNDING * scales
    return bool(still.all()) and symmetry_defect(system, p, signs, scales, about)[0] <= ROUNDING


def require_symmetry(system: System, p: Array, signs: Array, scales: Array, about: Array) -> None:
    """Raise NotSymmetric unless the field has the symmetry."""
    defect, where = symmetry_defect(system, p, signs, scales, about)
    if not defect <= ROUNDING:
        raise NotSymmetric(as_tuple(signs), as_tuple(where), system.state_names, defect)
