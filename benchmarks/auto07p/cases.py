"""The models of the comparison, with the windows of the study and the sizes AUTO is told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tests.systems import toy_wheelset
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle

Interval = tuple[float, float]

#: Typical sizes of a wheelset's states in SI: mm, mrad and, at 40 rad/s, their rates.
STATES = {"y": 1e-3, "psi": 1e-3, "yd": 4e-2, "psid": 4e-2}


@dataclass(frozen=True)
class Case:
    """A study: the equilibrium over ``start`` of the first free parameter to its first Hopf point,
    the cycles born there over ``window`` of it, their fold curve over ``curve`` of the second.

    scales: typical sizes of states and free parameters, for the arclength.
    """

    name: str
    system: System
    free: tuple[str, str]
    scales: Mapping[str, float]
    start: Interval
    window: Interval
    curve: Interval


def toy(a3: float = 100.0) -> Case:
    """The toy wheelset; fold curve in v and a3."""
    scales = {**STATES, "v": 1.0, "a3": 50.0}
    return Case(
        "toy", toy_wheelset(a3), ("v", "a3"), scales, (40.0, 60.0), (45.0, 54.0), (10.0, 500.0)
    )


def paper(second: str = "a3") -> Case:
    """The paper's wheelset with the exponential flange at a3 = 200 / m2, where the Hopf point is
    subcritical; fold curve in v and a3 or a1. The window in v ends where |y| nears the 11.65 mm at
    which the sum of curvatures vanishes: AUTO takes the NaN beyond for converged.
    """
    vehicle = load_vehicle("guo2021", overrides=["flange_law=exponential"])
    system = hunting_system(vehicle).with_values(a3=200.0)
    size, curve = {"a3": (50.0, (90.0, 1000.0)), "a1": (0.01, (0.08, 0.4))}[second]
    scales = {**STATES, "v": 1.0, second: size}
    return Case("paper", system, ("v", second), scales, (40.0, 60.0), (45.0, 57.0), curve)
