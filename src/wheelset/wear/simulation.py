"""Evolution of a wheel's profile over mileage: what is simulated, and the run itself.

Calibration. Depth depends on the product of mileage and factor only, so that one run of the
unscaled law, to the depth of the field at the last mileage, gives the factor: its distance over
that mileage. Every mileage asked for is then the end of a step from the state before it. The
greatest depth at the last mileage is put in; its shape, growth and the width of the band are not.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from wheelset.profiles import Profile, Setup
from wheelset.profiles.worn import worn
from wheelset.wear.creep import CELLS
from wheelset.wear.errors import NoWear
from wheelset.wear.laws import WearLaw, coefficients
from wheelset.wear.operation import Operation
from wheelset.wear.patch import NU, E
from wheelset.wear.ranges import within
from wheelset.wear.rolling import Rolling, Strips
from wheelset.wear.stepping import (
    Rate,
    State,
    Stepping,
    begin,
    go,
    next_state,
    reach_depth,
)
from wheelset.wear.store import NOWHERE, Stage, Store

#: Mileages of the paper's worn profiles, 1e4 km, and the unit, m.
MILEAGES, MILEAGE = (0.2, 4.8, 6.8, 9.4, 11.7, 14.5, 18.5), 1e7

#: Tread wear of Chinese trains in service, mm per 1e4 km (0.05 to 0.06 on the harsher lines).
FIELD_RATE = 0.055

#: Accuracy to which the depth of the field is met.
MET = 1e-9


@dataclass(frozen=True, eq=False)
class Simulation:
    """What is simulated; both wheels are alike and the rails stay new.

    law: with its published coefficients. mileages: ascending, 1e4 km. field_rate: greatest depth
    at the last mileage over that mileage, mm per 1e4 km; None leaves the law unscaled. count, seed:
    of the conditions drawn. Raises ValueError naming what is out of range.
    """

    wheel: Profile
    rail: Profile
    law: WearLaw
    mileages: tuple[float, ...] = MILEAGES
    field_rate: float | None = FIELD_RATE
    operation: Operation = field(default_factory=Operation)
    setup: Setup = field(default_factory=Setup)
    strips: Strips = field(default_factory=Strips)
    stepping: Stepping = field(default_factory=Stepping)
    count: int = 256
    seed: int = 1

    def __post_init__(self) -> None:
        ascending = all(a < b for a, b in zip(self.mileages, self.mileages[1:], strict=False))
        if not self.mileages or not ascending:
            raise ValueError(f"mileages = {self.mileages}: give ascending numbers, in 1e4 km")
        within("first mileage", self.mileages[0], 1e-3, 1e3, "x 1e4 km")
        within("last mileage", self.mileages[-1], 1e-3, 1e3, "x 1e4 km")
        if self.field_rate is not None:
            within("field rate", self.field_rate, 1e-4, 1.0, "mm per 1e4 km")
        within("count", self.count, 8, 2**16, "conditions")

    @property
    def target(self) -> float:
        """The greatest depth of the field at the last mileage, m."""
        return (self.field_rate or 0.0) * 1e-3 * self.mileages[-1]

    def rolling(self) -> Rolling:
        """Everything but the wheel's shape."""
        operation = self.operation
        return Rolling(
            self.setup.laid(self.rail),
            self.setup,
            operation.draw(self.count, self.seed),
            self.law,
            self.strips,
            operation.speed,
            operation.friction,
            operation.difference_share,
        )

    def settings(self) -> dict[str, Any]:
        """All that the numbers depend on, for files."""
        return {
            "wheel": _identity(self.wheel),
            "rail": _identity(self.rail),
            "law": {"name": self.law.name, **coefficients(self.law)},
            "mileages": list(self.mileages),
            "field_rate": self.field_rate,
            "operation": self.operation.to_dict(),
            "setup": asdict(self.setup),
            "strips": asdict(self.strips),
            "stepping": asdict(self.stepping),
            "steel": {"E": E, "nu": NU},
            "count": self.count,
            "seed": self.seed,
            "cells": CELLS,
        }


def _identity(profile: Profile) -> dict[str, str]:
    y, z = profile.points(1e-3)
    digest = hashlib.sha256(np.round(np.stack([y, z]), 10).tobytes()).hexdigest()
    return {"name": profile.name, "shape": digest[:16]}


@dataclass(frozen=True, eq=False)
class Progress:
    """A state on the way, and the share done; stage: of the run, or at a mileage asked for."""

    stage: Stage
    state: State
    done: float


def evolve(simulation: Simulation, store: Store = NOWHERE) -> Iterator[Progress]:
    """Every accepted state, those kept in the store first; the store keeps the others.

    Distances are those of the unscaled law. Raises a WearOutcome or a ContactOutcome where
    the simulation cannot go on.
    """
    rate, run = _rate(simulation), []
    for state in _run(simulation, rate, store):
        run.append(state)
        yield Progress("run", state, _share(simulation, state))
    kept = store.kept("asked")
    factor = run[-1].distance / (simulation.mileages[-1] * MILEAGE)
    for k, mileage in enumerate(simulation.mileages):
        if k < len(kept):
            state = kept[k]
        else:
            state = replace(_at(rate, run, factor * mileage * MILEAGE), number=k)
            store.keep("asked", state)
        yield Progress("asked", state, 1.0)


def _rate(simulation: Simulation) -> Rate:
    """Depth per distance of the unscaled law, of a depth."""
    rolling, y = simulation.rolling(), simulation.strips.y
    return lambda depth: rolling.rate(worn(simulation.wheel, y, depth))


def _share(simulation: Simulation, state: State) -> float:
    if simulation.field_rate is None:
        return state.distance / (simulation.mileages[-1] * MILEAGE)
    return state.greatest / simulation.target


def _run(simulation: Simulation, rate: Rate, store: Store) -> Iterator[State]:
    """States from the new wheel to the depth of the field, or to the last mileage."""
    kept = store.kept("run")
    if not kept:
        kept = [begin(rate, np.zeros_like(simulation.strips.y))]
        store.keep("run", kept[0])
    if not kept[0].rate.any():
        raise NoWear(simulation.law.name)
    yield from kept
    state = kept[-1]
    stop = math.inf if simulation.field_rate else simulation.mileages[-1] * MILEAGE
    while state.distance < stop and not _met(simulation, state):
        before = state
        state = next_state(rate, before, stop, simulation.stepping)
        if simulation.field_rate and state.greatest > simulation.target:
            state = reach_depth(rate, before, state, simulation.target)
        store.keep("run", state)
        yield state


def _met(simulation: Simulation, state: State) -> bool:
    """Whether the depth of the field is reached."""
    field_rate = simulation.field_rate
    return field_rate is not None and state.greatest >= simulation.target * (1 - MET)


def _at(rate: Rate, run: list[State], distance: float) -> State:
    """The state at a distance: a step from the one before."""
    after = next((s for s in run if s.distance >= distance), run[-1])
    return after if distance >= after.distance else go(rate, run[after.number - 1], distance)
