"""Finds events on the steps of a trajectory: each watched function's changes of sign."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.integration.events import Crossing, Event, EventSpec, ThresholdPair
from wheelset.bifurcation.integration.step import FROM_VALUES, Step, sign_changes

Array = NDArray[np.float64]
Words = tuple[str, str]  # kind of event, what happened


@dataclass
class Watch:
    """One function of the state whose sign is followed from step to step.

    of: index of a state, or a function of the state. rising, falling: what to report, if anything.
    """

    of: int | Callable[[Array], float]
    level: float
    rising: Words | None
    falling: Words | None
    sign: int = field(default=0)

    def value(self, x: Array) -> float:
        """Height of the watched function above its level."""
        return (float(x[self.of]) if isinstance(self.of, int) else float(self.of(x))) - self.level

    def on(self, step: Step) -> tuple[Event, ...]:
        """Events on the next step."""
        coefficients = self._coefficients(step)
        size = abs(self.level) + float(np.abs(coefficients).sum())
        changes, self.sign = sign_changes(
            step, lambda t: self.value(step(t)), coefficients, self.sign, size
        )
        words = {1: self.rising, -1: self.falling}
        found = ((c.t, words[c.direction]) for c in changes)
        return tuple(Event(w[0], t, step(t), w[1]) for t, w in found if w)

    def _coefficients(self, step: Step) -> Array:
        if not isinstance(self.of, int):
            return FROM_VALUES @ np.array([self.value(x) for x in step.samples])
        coefficients = step.coefficients[:, self.of].copy()
        coefficients[0] -= self.level
        return coefficients


def watches(specs: Sequence[EventSpec], state_names: Sequence[str], x0: Array) -> tuple[Watch, ...]:
    """One watch a level; ValueError, naming the field, for an event that makes no sense."""
    found = tuple(w for spec in specs for w in _watches(spec, list(state_names)))
    for watch in found:
        watch.sign = int(np.sign(watch.value(x0)))
    return found


def _watches(spec: EventSpec, names: list[str]) -> tuple[Watch, ...]:
    _check(spec, names)
    if isinstance(spec, ThresholdPair):
        i = names.index(spec.state)
        entered, left = ("entered", spec.entered), ("left", spec.left)
        return Watch(i, spec.level, entered, left), Watch(i, -spec.level, left, entered)
    words = ("crossing", spec.name)
    of = names.index(spec.of) if isinstance(spec.of, str) else spec.of
    rising = words if spec.direction in ("up", "both") else None
    falling = words if spec.direction in ("down", "both") else None
    return (Watch(of, spec.level, rising, falling),)


def _check(spec: EventSpec, names: list[str]) -> None:
    state = spec.state if isinstance(spec, ThresholdPair) else spec.of
    if isinstance(state, str) and state not in names:
        raise ValueError(f"event of state {state!r}: unknown; the states are {', '.join(names)}")
    if not np.isfinite(spec.level) or (isinstance(spec, ThresholdPair) and not spec.level > 0):
        allowed = "positive" if isinstance(spec, ThresholdPair) else "finite"
        raise ValueError(f"event level = {spec.level!r}: has to be {allowed}; give one in SI units")
    if isinstance(spec, Crossing) and spec.direction not in ("up", "down", "both"):
        raise ValueError(
            f"event direction = {spec.direction!r}: allowed are 'up', 'down', 'both'; choose one"
        )
