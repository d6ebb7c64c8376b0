"""Events along a trajectory, and what to ask for: levels crossed, thresholds entered and left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Direction = Literal["up", "down", "both"]


@dataclass(frozen=True, eq=False)
class Event:
    """Something that happened at t [s] in ``state`` (n,).

    kind: "crossing", "entered", "left", "corner", "settled" or "domain left". what: the words.
    """

    kind: str
    t: float
    state: Array
    what: str

    def __str__(self) -> str:
        return f"t = {self.t:.9g} s: {self.what}"


@dataclass(frozen=True)
class Crossing:
    """``of`` crosses ``level``: a state by its name, or any smooth function of the state (n,)."""

    name: str
    of: str | Callable[[Array], float]
    level: float = 0.0
    direction: Direction = "both"


@dataclass(frozen=True)
class ThresholdPair:
    """|state| rises above ``level`` > 0 (``entered``) or falls below it (``left``)."""

    state: str
    level: float
    entered: str
    left: str


EventSpec = Crossing | ThresholdPair
