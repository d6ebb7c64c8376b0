"""Numerical failure as named outcomes: what happened, where, and what can be done about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


class NumericalOutcome(ArithmeticError):
    """Base of every numerical outcome that is not a number."""


@dataclass(eq=False)
class DomainLeft(NumericalOutcome):
    """A formula was asked for a value outside its domain.

    quantity, where: what left its domain and on which part ("sum of curvatures", "left wheel").
    value, least: its value and the value it has to exceed, in ``unit``.
    state: the state at which it happened, shape (n,), SI units, named by ``state_names``.
    """

    quantity: str
    where: str
    value: float
    least: float
    unit: str
    state: tuple[float, ...]
    state_names: tuple[str, ...]

    def __str__(self) -> str:
        place = f", {self.where}" if self.where else ""
        at = ", ".join(f"{n} = {v:.6g}" for n, v in zip(self.state_names, self.state, strict=True))
        return (
            f"domain left: {self.quantity}{place} = {self.value:.6g} {self.unit} "
            f"must exceed {self.least:.6g} at {at}"
        )


@dataclass(eq=False)
class NotFinite(NumericalOutcome):
    """An evaluation overflowed or is undefined although no declared domain was left."""

    what: str
    state: tuple[float, ...]
    state_names: tuple[str, ...]

    def __str__(self) -> str:
        at = ", ".join(f"{n} = {v:.6g}" for n, v in zip(self.state_names, self.state, strict=True))
        return f"not finite: {self.what} at {at}"


@dataclass(eq=False)
class NoConvergence(NumericalOutcome):
    """An iteration did not converge; ``residuals`` is its history, one norm a step."""

    what: str
    residuals: tuple[float, ...]

    def __str__(self) -> str:
        history = ", ".join(f"{r:.2e}" for r in self.residuals[-6:])
        return f"no convergence: {self.what}; last residual norms {history}"


def as_tuple(x: Sequence[float] | NDArray[np.float64]) -> tuple[float, ...]:
    """A state as plain floats, for messages."""
    return tuple(float(v) for v in np.ravel(np.asarray(x)).real)
