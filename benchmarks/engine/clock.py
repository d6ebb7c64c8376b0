"""Where the time of a walk goes: a zero problem whose methods are clocked."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable
from contextlib import contextmanager
from time import perf_counter
from typing import Any

#: Methods of zero problems and of their linearisations, by what they are for.
CLOCKED = {
    "linearised": "linearise",
    "newton": "solve",
    "determinant": "solve",
    "tests": "tests",
    "solution": "solution",
    "ended": "tests",
    "classify": "special points",
    "renewed": "renewal",
}

#: What is in none of them: the continuer itself.
WALK = "walk"


class Clock:
    """Seconds by name; what runs inside another is taken off it."""

    def __init__(self) -> None:
        self.seconds: Counter[str] = Counter()
        self.calls: Counter[str] = Counter()
        self._name, self._since = WALK, perf_counter()

    @contextmanager
    def running(self, name: str):
        outer = self._switched(name)
        try:
            yield
        finally:
            self._switched(outer)

    def _switched(self, name: str) -> str:
        now, old = perf_counter(), self._name
        self.seconds[old] += now - self._since
        self._name, self._since = name, now
        return old

    def stop(self) -> dict[str, float]:
        self._switched(WALK)
        return dict(self.seconds)


class Clocked:
    """A zero problem or a linearisation, the same but for the clock."""

    def __init__(self, inner: Any, clock: Clock) -> None:
        self._inner, self._clock = inner, clock

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._inner, name)
        return self._timed(name, value) if name in CLOCKED else value

    def _timed(self, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            self._clock.calls[CLOCKED[name]] += 1
            with self._clock.running(CLOCKED[name]):
                result = method(*arguments)
            if name == "linearised":
                return Clocked(result, self._clock)
            if name == "renewed":
                return dataclasses.replace(result, problem=Clocked(result.problem, self._clock))
            return result

        return call
