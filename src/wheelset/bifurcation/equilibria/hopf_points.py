"""What a point of a Hopf curve is: criticality, degeneracies, and what a branch keeps of it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import Finding, Point
from wheelset.bifurcation.equilibria.lyapunov import CriticalPair, critical_pair, first_lyapunov
from wheelset.bifurcation.equilibria.second_lyapunov import second_lyapunov
from wheelset.bifurcation.equilibria.spectrum import (
    closest_to_opposite,
    eigenvalues,
    is_real,
    pair_sums,
    product,
)
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: A frequency below this, relative to the largest eigenvalue, has no first Lyapunov coefficient.
SLOW = 1e-5

#: A product of the other eigenvalues, each relative to the largest, below which one is zero.
ZERO = 1e-7


@dataclass(frozen=True, eq=False)
class HopfCurvePoint:
    """A Hopf point, or a neutral saddle beyond a Bogdanov-Takens point.

    state (n,), values (2,) of the parameters, SI. k = w^2 in 1/s^2, negative at a neutral saddle.
    lyapunov: FLC in MATCONT's normalisation, None where ``reason`` says why. others (n - 2,): the
    eigenvalues beside the pair, 1/s.
    """

    state: Array
    values: Array
    k: float
    lyapunov: float | None
    reason: str
    others: NDArray[Any]
    state_names: tuple[str, ...]

    @property
    def kind(self) -> str:
        """Hopf or neutral saddle."""
        return "Hopf" if self.k > 0 else "neutral saddle"

    @property
    def frequency(self) -> float:
        """rad/s; 0 at a neutral saddle."""
        return math.sqrt(max(self.k, 0.0))

    @property
    def measures(self) -> tuple[str, ...]:
        """What a table shows by default."""
        return ("frequency", "FLC")

    @property
    def unstable(self) -> int:
        """Number of eigenvalues with a positive real part beside the pair."""
        return int((self.others.real > 0).sum())

    def measure(self, name: str) -> float:
        """``frequency`` in rad/s, ``FLC`` (nan: missing in a table where there is none), ``k``, or
        a state by its name.
        """
        if name in self.state_names:
            return float(self.state[self.state_names.index(name)])
        missing = math.nan if self.lyapunov is None else self.lyapunov
        known = {"frequency": self.frequency, "FLC": missing, "k": self.k}
        if name not in known:
            names = ", ".join((*known, *self.state_names))
            raise ValueError(f"unknown measure {name!r}; there are {names}")
        return known[name]


@dataclass(frozen=True, eq=False)
class Examined:
    """A point of a Hopf curve with what its test functions need; rate: a typical frequency."""

    system: System
    p: Array
    rate: float
    pair: CriticalPair | None
    solution: HopfCurvePoint


@lru_cache(maxsize=4)
def examined(point: Point) -> Examined:
    """Eigenvalues and first Lyapunov coefficient at a point of a Hopf problem."""
    problem = point.problem
    system, u = problem.system, point.u
    x, p, k = u[: system.n], problem.p(u), float(u[-1])
    jacobian = system.jacobian(x, p)
    spectrum = eigenvalues(jacobian)
    pair, flc, reason = _criticality(system, x, p, jacobian, k, float(np.abs(spectrum).max()))
    solution = HopfCurvePoint(
        x, problem.values(u), k, flc, reason, _without_pair(spectrum, k), system.state_names
    )
    return Examined(system, p, problem.rate, pair, solution)


def _criticality(
    system: System, x: Array, p: Array, jacobian: Array, k: float, size: float
) -> tuple[CriticalPair | None, float | None, str]:
    """The critical pair with FLC, or why there is none."""
    if k <= (SLOW * size) ** 2:
        return None, None, "no oscillating pair" if k < 0 else "the frequency falls to zero"
    try:
        pair = critical_pair(jacobian, math.sqrt(k))
        return pair, first_lyapunov(system, x, p, pair), ""
    except NumericalOutcome as outcome:
        return None, None, str(outcome)


def _without_pair(spectrum: NDArray[Any], k: float) -> NDArray[Any]:
    """The eigenvalues beside +-sqrt(-k)."""
    left, root = spectrum, np.sqrt(complex(-k))
    for target in (root, -root):
        left = np.delete(left, np.argmin(np.abs(left - target)))
    return left


# --- what is watched, and what its zeros are -----------------------------------------------------


def watched(at: Examined) -> Mapping[str, float]:
    """BT: k; at Hopf points also ZH: the product of the other eigenvalues, HH: of their pairs'
    sums, and GH: FLC times the former, since FLC may have a pole at a zero-Hopf point.
    """
    here = at.solution
    found = {"BT": here.k / at.rate**2}
    if here.k <= 0.0:
        return found
    found["ZH"] = _others(here)
    found["HH"] = pair_sums(here.others)
    if here.lyapunov is not None:
        found["GH"] = here.lyapunov * found["ZH"]
    return found


def _others(here: HopfCurvePoint) -> float:
    size = float(np.abs(here.others).max(initial=0.0)) + here.frequency
    return product(here.others, size)


def classified(test: str, at: Examined) -> Finding:
    """What the zero of a test function is."""
    rules = {"BT": _bogdanov_takens, "ZH": _zero_hopf, "HH": _double_hopf, "GH": _generalized}
    return rules[test](at)


def _bogdanov_takens(at: Examined) -> Finding:
    words = "Bogdanov-Takens: the frequency falls to zero, the curve goes on as neutral saddles"
    return Finding("BT", words)


def _zero_hopf(at: Examined) -> Finding:
    return Finding("ZH", "zero-Hopf: a real eigenvalue is zero too", _frequency(at))


def _double_hopf(at: Examined) -> Finding:
    one, _ = closest_to_opposite(at.solution.others)
    if is_real(one, at.solution.others):
        words = "a neutral saddle beside the Hopf pair: no bifurcation"
        return Finding("HH", words, _frequency(at), artefact=True)
    found = _frequency(at) | {"second frequency": abs(one.imag)}
    return Finding("HH", "Hopf-Hopf: a second pair of eigenvalues is on the axis", found)


def _generalized(at: Examined) -> Finding:
    assert at.pair is not None
    if abs(_others(at.solution)) < ZERO:
        words = "FLC keeps its sign or has a pole: another eigenvalue is zero, see ZH"
        return Finding("GH", words, artefact=True)
    words, found = "generalized Hopf: FLC changes sign", _frequency(at)
    try:
        slc = second_lyapunov(at.system, at.solution.state, at.p, at.pair)
    except NumericalOutcome as outcome:
        return Finding("GH", f"{words}; SLC undefined: {outcome}", found)
    outer = "stable" if slc < 0 else "unstable"
    return Finding("GH", f"{words}; the outer cycles are {outer}", found | {"SLC": slc})


def _frequency(at: Examined) -> dict[str, float]:
    return {"frequency": at.solution.frequency}
