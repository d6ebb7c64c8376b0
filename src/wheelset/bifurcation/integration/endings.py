"""How an integration ends, in words and numbers: never a NaN, never a lost trajectory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.outcomes import DomainLeft, NotFinite

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Ending:
    """Base of every ending: at time t [s], in the last accepted state (n,)."""

    kind: ClassVar[str] = ""
    t: float
    state: Array

    def __str__(self) -> str:
        return f"{self.kind} at t = {self.t:.6g} s{self._details()}"

    def _details(self) -> str:
        return ""


class ReachedEnd(Ending):
    """The time asked for was reached."""

    kind = "reached the end"


@dataclass(frozen=True, eq=False)
class SettledToEquilibrium(Ending):
    """The state stays at an equilibrium.

    equilibrium: its state (n,). distance: what is left to it, the largest over the states in
    units of each one's largest value so far. decay_rate: -max Re of the eigenvalues there, 1/s;
    negative for rest in an unstable equilibrium.
    """

    kind = "settled to equilibrium"
    equilibrium: Array
    distance: float
    decay_rate: float

    def _details(self) -> str:
        return f": relative distance {self.distance:.1e}, decay rate {self.decay_rate:.4g} 1/s"


@dataclass(frozen=True, eq=False)
class SettledToCycle(Ending):
    """Successive returns agree: a periodic motion.

    period: s. lowest, highest: of each state over the last period, (n,), in the state's units.
    error: estimated distance from the cycle, relative to the amplitude, the sum of the geometric
    series the last returns suggest. contraction: their ratio a period, 0 when the returns
    agree to what the integrator can tell. turns: local maxima of the section state in one period.
    """

    kind = "settled to a cycle"
    period: float
    lowest: Array
    highest: Array
    error: float
    contraction: float
    turns: int

    @property
    def amplitude(self) -> Array:
        """Half the peak-to-peak motion of each state, (n,)."""
        return (self.highest - self.lowest) / 2

    def _details(self) -> str:
        return f": period {self.period:.6g} s, relative error {self.error:.1e}"


@dataclass(frozen=True, eq=False)
class LeftDomain(Ending):
    """The solution reached the boundary of the field's domain.

    t, state: the last state inside, within 1e-9 of a step of the boundary. cause: which quantity,
    where, which value.
    """

    kind = "domain left"
    cause: DomainLeft

    def _details(self) -> str:
        return f": {str(self.cause).removeprefix('domain left: ')}"


@dataclass(frozen=True, eq=False)
class BecameNotFinite(Ending):
    """The field overflows or is undefined beyond this state although no declared domain ended."""

    kind = "not finite"
    cause: NotFinite

    def _details(self) -> str:
        return f": {str(self.cause).removeprefix('not finite: ')}"


@dataclass(frozen=True, eq=False)
class StepBelowMinimum(Ending):
    """The tolerance asks for steps below the spacing of floating-point numbers: a singularity."""

    kind = "step below minimum"

    def _details(self) -> str:
        return "; the solution is singular here or rtol is too small"


@dataclass(frozen=True, eq=False)
class Sliding(Ending):
    """A piecewise smooth field points at a corner from both sides: no solution crosses it."""

    kind = "sliding along a corner"
    what: str

    def _details(self) -> str:
        return f": {self.what}; the field points at it from both sides"


@dataclass(frozen=True, eq=False)
class SolverFailed(Ending):
    """The solver gave up; ``message`` is its own."""

    kind = "solver failed"
    message: str

    def _details(self) -> str:
        return f": {self.message}"
