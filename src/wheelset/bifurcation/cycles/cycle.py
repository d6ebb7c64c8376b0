"""A limit cycle: its polynomials, its multipliers, and measures chosen by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.cycles.floquet import Floquet
from wheelset.bifurcation.cycles.gauss import DEGREE, gauss

Array = NDArray[np.float64]

#: Points an interval on which extremes are sought before they are refined.
SAMPLES, NEWTON = 16, 4


@dataclass(frozen=True, eq=False)
class Cycle:
    """A periodic solution as piecewise polynomials of degree m in the phase t / T.

    state_names, parameters: names and all values, SI. period: T in s.
    mesh (N + 1,): from 0 to 1, of the full period or of its first half where ``signs`` are given:
    then u(t + T/2) = signs * u(t). nodes (N, m + 1, n): values at the left end and at the Gauss
    points of each interval. computed: eigenvalues of the monodromy matrix, or of
    signs * Phi(T/2) for half a period, complex (n,).
    """

    state_names: tuple[str, ...]
    parameters: Mapping[str, float]
    period: float
    mesh: Array
    nodes: Array
    signs: tuple[float, ...] | None
    computed: NDArray[Any]

    @property
    def measures(self) -> tuple[str, ...]:
        """Names a table shows unless others are asked for."""
        return ("period", *(f"amplitude {name}" for name in self.state_names))

    @property
    def symmetric(self) -> bool:
        """Whether the cycle was computed on half its period."""
        return self.signs is not None

    @property
    def multipliers(self) -> NDArray[Any]:
        """Floquet multipliers over the full period, largest first, complex (n,)."""
        return Floquet(self.computed, self.symmetric).multipliers

    @property
    def unstable(self) -> int:
        """Number of multipliers outside the unit circle, the trivial one left out."""
        return Floquet(self.computed, self.symmetric).unstable

    def at(self, phase: ArrayLike) -> Array:
        """State at phases t / T of the full period, shape phase.shape + (n,)."""
        turns = np.mod(np.asarray(phase, dtype=np.float64), 1.0)
        if self.signs is None:
            return evaluate(self.mesh, self.nodes, turns)
        second = turns >= 0.5
        first = evaluate(self.mesh, self.nodes, 2 * np.where(second, turns - 0.5, turns))
        return np.where(second[..., np.newaxis], np.array(self.signs) * first, first)

    def extremes(self, state: str) -> tuple[float, float]:
        """Least and greatest value of a state over the cycle, of the polynomials, refined."""
        index = self._index(state)
        least, most = _least(self.nodes[..., index]), -_least(-self.nodes[..., index])
        if self.signs is None:
            return least, most
        if self.signs[index] < 0:
            return min(least, -most), max(most, -least)
        return least, most

    def measure(self, name: str) -> float:
        """A number by name: a parameter, "period", "frequency" [Hz], "unstable", or one of "max",
        "min", "amplitude" (half the peak-to-peak value), "rms" (about the mean) and "mean" followed
        by a state: "amplitude y".
        """
        plain: dict[str, float] = {
            **self.parameters,
            "period": self.period,
            "frequency": 1 / self.period,
            "unstable": float(self.unstable),
        }
        if name in plain:
            return plain[name]
        kind, _, state = name.partition(" ")
        if kind not in _MEASURES or state not in self.state_names:
            raise ValueError(
                f"unknown measure {name!r}; there are {', '.join(plain)}, and "
                f"{', '.join(_MEASURES)} of {', '.join(self.state_names)}"
            )
        return _MEASURES[kind](self, state)

    def _index(self, state: str) -> int:
        return self.state_names.index(state)

    def _moments(self, state: str) -> tuple[float, float]:
        """Mean and mean square about it over the full period, by the Gauss quadrature."""
        index = self._index(state)
        values, weights = (
            self.nodes[:, 1:, index],
            np.diff(self.mesh)[:, None] * gauss(self.nodes.shape[1] - 1).b,
        )
        mean = 0.0 if self.signs and self.signs[index] < 0 else float((weights * values).sum())
        return mean, float((weights * (values - mean) ** 2).sum())


_MEASURES: dict[str, Callable[[Cycle, str], float]] = {
    "max": lambda cycle, state: cycle.extremes(state)[1],
    "min": lambda cycle, state: cycle.extremes(state)[0],
    "amplitude": lambda cycle, state: (cycle.extremes(state)[1] - cycle.extremes(state)[0]) / 2,
    "rms": lambda cycle, state: float(np.sqrt(cycle._moments(state)[1])),
    "mean": lambda cycle, state: cycle._moments(state)[0],
}


def evaluate(mesh: Array, nodes: Array, at: Array) -> Array:
    """Piecewise polynomials at points of [0, 1], shape at.shape + (n,)."""
    interval = np.clip(np.searchsorted(mesh, at, side="right") - 1, 0, len(nodes) - 1)
    inside = (at - mesh[interval]) / (mesh[interval + 1] - mesh[interval])
    basis = gauss(nodes.shape[1] - 1).basis(inside)
    return np.einsum("...k,...kn->...n", basis, nodes[interval])


def _least(values: Array) -> float:
    """Least value of polynomials given by values (N, m + 1) at 0 and the Gauss points.

    The interval with the least sample, and its neighbours, are refined by Newton's method.
    """
    rule = gauss(values.shape[1] - 1)
    samples = values @ _SAMPLED.T
    j, k = np.unravel_index(np.argmin(samples), samples.shape)
    polynomial = np.polynomial.Polynomial(
        np.linalg.solve(np.vander(np.concatenate([[0.0], rule.c]), increasing=True), values[j])
    )
    slope, place = polynomial.deriv(), float(_PLACES[k])
    bend = slope.deriv()
    for _ in range(NEWTON):
        curvature = bend(place)
        place -= slope(place) / curvature if curvature > 0 else 0.0
    if abs(place - _PLACES[k]) > 1 / SAMPLES:
        return float(samples[j, k])
    return min(float(polynomial(place)), float(samples[j, k]))


_PLACES = np.arange(SAMPLES) / SAMPLES
_SAMPLED = gauss(DEGREE).basis(_PLACES)
