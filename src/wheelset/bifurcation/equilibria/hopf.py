"""Where an equilibrium changes stability along a parameter: Hopf and static points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import matrix_balance

from wheelset.bifurcation.equilibria.equilibrium import EquilibriumPath, equilibrium_path
from wheelset.bifurcation.equilibria.lyapunov import critical_pair, first_lyapunov
from wheelset.bifurcation.equilibria.roots import roots_in
from wheelset.bifurcation.outcomes import NoConvergence, NumericalOutcome, as_tuple
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: A coefficient below this magnitude is not signed: the point is called degenerate.
DEGENERATE = 1e-9
MAX_ITERATIONS = 30

#: First step of the secant method, and the step that ends it, relative to the parameter. The
#: error left is of the order of the last two steps' product.
SECANT_START, SECANT_END = 1e-3, 1e-9

#: A real part this small relative to its eigenvalue is zero to rounding.
ROUNDING = 1e-15


@dataclass(frozen=True)
class HopfPoint:
    """A pair of eigenvalues crosses the imaginary axis: a limit cycle is born.

    parameter, value: where, in the parameter's SI unit. frequency: rad/s. state: shape (n,).
    lyapunov: FLC in MATCONT's normalisation (SI state), None where the field is not smooth enough,
    ``reason`` then says why. unstable: number of unstable eigenvalues just below and above.
    """

    parameter: str
    value: float
    frequency: float
    state: tuple[float, ...]
    lyapunov: float | None
    unstable: tuple[int, int]
    reason: str = ""

    @property
    def kind(self) -> str:
        """Either H- supercritical, H+ subcritical, H0 degenerate, or H? where FLC is undefined."""
        if self.lyapunov is None:
            return "H?"
        if abs(self.lyapunov) < DEGENERATE:
            return "H0"
        return "H-" if self.lyapunov < 0 else "H+"

    @property
    def words(self) -> str:
        """What happens there, in a sentence."""
        below, above = self.unstable
        change = {(0, 2): "stability is lost", (2, 0): "stability is gained"}.get(
            (below, above), f"unstable eigenvalues go from {below} to {above}"
        )
        return f"Hopf, {_CYCLES[self.kind]}; {change} as {self.parameter} grows"


_CYCLES = {
    "H-": "supercritical: stable cycles of growing amplitude",
    "H+": "subcritical: unstable cycles below which only small disturbances die out",
    "H0": "degenerate: the first Lyapunov coefficient vanishes",
    "H?": "criticality undefined because the field is not smooth there",
}


@dataclass(frozen=True)
class StaticPoint:
    """A real eigenvalue crosses zero: the equilibrium diverges without oscillating."""

    parameter: str
    value: float
    state: tuple[float, ...]
    unstable: tuple[int, int]

    @property
    def kind(self) -> str:
        """Always S, for static."""
        return "S"

    @property
    def words(self) -> str:
        """What happens there, in a sentence."""
        below, above = self.unstable
        return (
            f"static divergence: a real eigenvalue crosses zero; unstable eigenvalues go from "
            f"{below} to {above} as {self.parameter} grows"
        )


StabilityChange = HopfPoint | StaticPoint


def instabilities(
    system: System,
    parameter: str,
    window: tuple[float, float],
    guess: ArrayLike | None = None,
) -> tuple[StabilityChange, ...]:
    """Every Hopf and static point of an equilibrium with the parameter in a window, increasing.

    Hopf points are zeros of the product of all pairwise sums of eigenvalues, static points of
    their product; both are smooth in the parameter, and all their zeros in the window are found.
    guess: where the equilibrium is sought (default: the origin).
    """
    low, high = _checked(window)
    path = equilibrium_path(system, parameter, guess)
    scale = _balancing(path.jacobian((low + high) / 2))
    points = [
        point
        for product, locate in ((_pair_sums, _hopf_point), (_eigenvalue_product, _static_point))
        for value in roots_in(_test(path, scale, product), low, high)
        if (point := locate(path, value)) is not None
    ]
    return tuple(sorted(points, key=lambda point: point.value))


def _checked(window: tuple[float, float]) -> tuple[float, float]:
    low, high = map(float, window)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise ValueError(f"window = {window}: needs two finite numbers, the lower one first")
    return low, high


def _balancing(jacobian: Array) -> Array:
    """Fixed scales of the state that even out the entries of the Jacobian."""
    _, (scale, _) = matrix_balance(jacobian, permute=False, separate=True)
    return np.asarray(scale)


Product = Callable[[NDArray[Any]], tuple[complex, int]]


def _pair_sums(eigenvalues: NDArray[Any]) -> tuple[complex, int]:
    """prod (l_i + l_j) over pairs, and the number of factors: zero at a pair +-iw or +-a."""
    sums = [a + b for a, b in combinations(eigenvalues, 2)]
    return complex(np.prod(sums)), len(sums)


def _eigenvalue_product(eigenvalues: NDArray[Any]) -> tuple[complex, int]:
    return complex(np.prod(eigenvalues)), len(eigenvalues)


def _test(path: EquilibriumPath, scale: Array, product: Product) -> Callable[[float], float]:
    """A product made dimensionless by the (smooth) Frobenius norm of the balanced Jacobian."""

    def value_at(value: float) -> float:
        balanced = path.jacobian(value) * scale[np.newaxis, :] / scale[:, np.newaxis]
        total, factors = product(path.eigenvalues(value))  # balancing is a similarity
        return float(total.real / np.linalg.norm(balanced) ** factors)

    return value_at


def hopf_point(
    system: System,
    parameter: str,
    near: float,
    frequency: float | None = None,
    guess: ArrayLike | None = None,
) -> HopfPoint:
    """The Hopf point beside a parameter value, by the secant method on the pair's real part.

    frequency: of the pair to follow [rad/s]; default: the oscillating pair nearest to the
    imaginary axis. Raises NoConvergence with the history of real parts.
    """
    path = equilibrium_path(system, parameter, guess)
    return _located(path, near, _leading(path, near) if frequency is None else frequency)


def _leading(path: EquilibriumPath, value: float) -> float:
    """Frequency of the oscillating pair nearest to the imaginary axis."""
    eigenvalues = path.eigenvalues(value)
    oscillating = eigenvalues[eigenvalues.imag > _tiny(eigenvalues)]
    if not len(oscillating):
        raise NoConvergence(f"no oscillating pair at {path.parameter} = {value:.6g}", ())
    return float(oscillating[np.argmin(np.abs(oscillating.real))].imag)


def _tiny(eigenvalues: NDArray[Any]) -> float:
    return 1e-9 * float(np.abs(eigenvalues).max())


def _hopf_point(path: EquilibriumPath, value: float) -> HopfPoint | None:
    """The Hopf point at a zero of the pair sums; None for a neutral saddle (a real pair +-a)."""
    eigenvalues = path.eigenvalues(value)
    first, second = min(combinations(eigenvalues, 2), key=lambda pair: abs(pair[0] + pair[1]))
    if min(abs(first.imag), abs(second.imag)) <= _tiny(eigenvalues):
        return None
    return _located(path, value, abs(first.imag))


def _located(path: EquilibriumPath, near: float, frequency: float) -> HopfPoint:
    value, frequency = _to_axis(path, near, frequency)
    lyapunov, reason = _criticality(path, value, frequency)
    return HopfPoint(
        path.parameter, value, frequency, as_tuple(path.state(value)), lyapunov,
        _unstable_around(path, value), reason,
    )  # fmt: skip


def _to_axis(path: EquilibriumPath, start: float, frequency: float) -> tuple[float, float]:
    """The secant method for Re(eigenvalue) = 0; returns the parameter and the frequency."""
    value, size = start, abs(start) + SECANT_START
    old = _nearest(path.eigenvalues(value), 1j * frequency)
    step, history = SECANT_START * size, [abs(old.real)]
    for _ in range(MAX_ITERATIONS):
        value += step
        new = _nearest(path.eigenvalues(value), 1j * old.imag)
        history.append(abs(new.real))
        if new.imag == 0.0:  # the pair has become real
            break
        if abs(step) <= SECANT_END * abs(value) or abs(new.real) <= ROUNDING * abs(new):
            return value, new.imag
        if new.real == old.real:
            break
        secant = step * new.real / (old.real - new.real)
        step, old = max(-size / 2, min(size / 2, secant)), new
    raise NoConvergence(f"Hopf point in {path.parameter} near {start:.6g}", tuple(history))


def _nearest(eigenvalues: NDArray[Any], target: complex) -> complex:
    return complex(eigenvalues[np.argmin(np.abs(eigenvalues - target))])


def _criticality(path: EquilibriumPath, value: float, frequency: float) -> tuple[float | None, str]:
    """The first Lyapunov coefficient, or None and the reason why there is none."""
    try:
        pair = critical_pair(path.jacobian(value), frequency)
        return first_lyapunov(path.system, path.state(value), path.p(value), pair), ""
    except NumericalOutcome as outcome:
        return None, str(outcome)


def _static_point(path: EquilibriumPath, value: float) -> StaticPoint:
    return StaticPoint(
        path.parameter, value, as_tuple(path.state(value)), _unstable_around(path, value)
    )


def _unstable_around(path: EquilibriumPath, value: float) -> tuple[int, int]:
    """Numbers of eigenvalues with positive real part just below and above a value."""
    width = 1e-5 * max(abs(value), 1e-5)
    below, above = (path.eigenvalues(value + side * width) for side in (-1, 1))
    return int((below.real > 0).sum()), int((above.real > 0).sum())
