"""One accepted step of an integration, as a polynomial in time, and the zeros of functions on it.

Within a step the dense output of every method is a polynomial. Its Chebyshev coefficients bound a
function on the step (no zero if |c0| exceeds the sum of the others) and their companion matrix
gives all zeros at once, so that neither several crossings nor a grazing pair inside one step are
missed; each is then located on the dense output itself by Brent's method.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.integrate import DenseOutput
from scipy.optimize import brentq

Array = NDArray[np.float64]

#: Degree of the polynomial: enough for DOP853 (7), RK45 (4), Radau (3) and BDF (5) to be exact.
DEGREE = 8
NODES = chebyshev.chebpts2(DEGREE + 1)  # both ends included
FROM_VALUES = np.linalg.inv(chebyshev.chebvander(NODES, DEGREE))
ROUNDING = 4 * np.finfo(np.float64).eps
#: A companion root this far off the real axis may still be one of a grazing pair.
OFF_AXIS = 1e-3


@dataclass(frozen=True, eq=False)
class Step:
    """An accepted step from t0 to t1 [s], states x0, x1 (n,), and x(t) between them.

    corner: words for the corner of a piecewise smooth field crossed at t0, if one was.
    """

    t0: float
    t1: float
    x0: Array
    x1: Array
    dense: DenseOutput
    corner: str = ""

    def __call__(self, t: float) -> Array:
        """State (n,) at t0 <= t <= t1."""
        if t == self.t0:
            return self.x0
        return self.x1 if t == self.t1 else np.asarray(self.dense(t))

    @cached_property
    def times(self) -> Array:
        """Chebyshev points of the step, both ends included."""
        inner = self.t0 + (self.t1 - self.t0) * (NODES + 1) / 2
        inner[0], inner[-1] = self.t0, self.t1
        return inner

    @cached_property
    def samples(self) -> Array:
        """States at ``times``, shape (DEGREE + 1, n)."""
        states = np.array(self.dense(self.times).T)
        states[0], states[-1] = self.x0, self.x1
        return states

    @cached_property
    def coefficients(self) -> Array:
        """Chebyshev coefficients of every state on the step, shape (DEGREE + 1, n)."""
        return FROM_VALUES @ self.samples

    def rates(self, state: int) -> Array:
        """Chebyshev coefficients of dx[state]/dt on the step."""
        slopes = chebyshev.chebder(self.coefficients[:, state])
        return np.asarray(slopes * 2 / (self.t1 - self.t0), dtype=np.float64)


@dataclass(frozen=True)
class SignChange:
    """A function changed sign at t, upward (+1) or downward (-1)."""

    t: float
    direction: int


def sign_changes(
    step: Step, g: Callable[[float], float], coefficients: Array, before: int, size: float
) -> tuple[tuple[SignChange, ...], int]:
    """All sign changes of g on a step, in order, and the sign it leaves with.

    coefficients: Chebyshev coefficients of g on the step. before: last sign of g before the step
    (0: not known yet; a function that starts on its level has not crossed it). size: magnitude
    of the numbers g is the difference of; below its rounding g counts as zero.
    """
    small = ROUNDING * size
    scale = np.abs(coefficients)
    if scale[0] > scale[1:].sum() + small:
        probes = [(step.t0, int(np.sign(coefficients[0])))]
    else:
        probes = [(t, _sign(g(t), small)) for t in _probe_times(step, coefficients)]
    changes, at = [], step.t0
    for t, sign in probes:
        if sign and before and sign != before:
            changes.append(SignChange(_located(g, at, t), sign))
        if sign:
            before, at = sign, t
    return tuple(changes), before


def _sign(value: float, small: float) -> int:
    return 0 if abs(value) <= small else int(np.sign(value))


def _probe_times(step: Step, coefficients: Array) -> list[float]:
    """Both ends, and a time between any two neighbouring zeros of the polynomial."""
    significant = 1e-15 * np.abs(coefficients).max()
    trimmed = chebyshev.chebtrim(coefficients, significant)
    roots = chebyshev.chebroots(trimmed) if len(trimmed) > 1 else np.empty(0)
    near = roots.real[(np.abs(roots.imag) < OFF_AXIS) & (np.abs(roots.real) < 1)]
    ends = np.concatenate([[-1.0], np.sort(near), [1.0]])
    middles = step.t0 + (step.t1 - step.t0) * ((ends[1:] + ends[:-1]) / 2 + 1) / 2
    return [step.t0, *(float(t) for t in middles), step.t1]


def _located(g: Callable[[float], float], a: float, b: float) -> float:
    """The zero of g in [a, b]; a itself where g vanishes there or the change came before a."""
    if a == b or g(a) * g(b) >= 0:
        return a
    return float(brentq(g, a, b, xtol=ROUNDING * max(abs(a), abs(b)), rtol=ROUNDING))
