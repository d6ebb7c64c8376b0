"""Every root of a smooth scalar function in a window, by piecewise Chebyshev interpolation.

The window is halved until the interpolant's last coefficients say that the function is resolved;
its roots are then the eigenvalues of a companion matrix, none of which can be missed between grid
points as with sign changes on a grid. Each root is finally polished on the function itself.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.optimize import brentq

from wheelset.bifurcation.outcomes import NoConvergence

Array = NDArray[np.float64]
Function = Callable[[float], float]

DEGREE = 16
RESOLVED = 1e-8
MAX_DEPTH = 14
NODES = chebyshev.chebpts1(DEGREE + 1)


def roots_in(f: Function, low: float, high: float, depth: int = 0) -> tuple[float, ...]:
    """All roots of odd multiplicity of f in [low, high], increasing, to machine accuracy.

    Raises NoConvergence, with the interpolation error on each level, where f is not smooth.
    """
    middle, half = (low + high) / 2, (high - low) / 2
    values = np.array([f(middle + half * node) for node in NODES])
    coefficients = chebyshev.chebfit(NODES, values, DEGREE)
    scale = np.abs(coefficients).max()
    error = np.abs(coefficients[-3:]).max() / scale if scale > 0 else 0.0
    if error <= RESOLVED:
        return _roots_of(f, coefficients, middle, half)
    if depth == MAX_DEPTH:
        raise NoConvergence(
            f"Chebyshev interpolation of a test function near {middle:.6g}", (error,)
        )
    lower = roots_in(f, low, middle, depth + 1)
    upper = roots_in(f, middle, high, depth + 1)
    return (*lower, *(r for r in upper if not lower or r > lower[-1] + 1e-12 * abs(r)))


def _roots_of(f: Function, coefficients: Array, middle: float, half: float) -> tuple[float, ...]:
    if not coefficients.any():
        return ()
    candidates = chebyshev.chebroots(chebyshev.chebtrim(coefficients))
    margin = 1e-6
    real = [z.real for z in candidates if abs(z.imag) < margin and abs(z.real) <= 1 + margin]
    polished = (_polish(f, middle + half * z, half) for z in sorted(real))
    inside = (r for r in polished if r is not None and abs(r - middle) <= half * (1 + 1e-12))
    return tuple(dict.fromkeys(inside))


def _polish(f: Function, root: float, half: float) -> float | None:
    """The root of f beside an interpolated one; None if f does not change sign there."""
    for width in (1e-7, 1e-5, 1e-4):
        a, b = root - width * half, root + width * half
        fa, fb = f(a), f(b)
        if fa == 0.0:
            return a
        if fa * fb < 0:
            return float(brentq(f, a, b, xtol=4e-15 * abs(root) + 1e-300, rtol=1e-14))
    return None
