"""Hopf points of a vehicle as rows of a table."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from wheelset.bifurcation.equilibria.hopf import HopfPoint, StabilityChange, instabilities
from wheelset.hunting import hunting_system
from wheelset.vehicle import Vehicle


def stability_changes(vehicle: Vehicle, window: tuple[float, float]) -> tuple[StabilityChange, ...]:
    """Every Hopf and static point of a vehicle's straight running over a speed window, m/s."""
    return instabilities(hunting_system(vehicle), "v", window)


def first_hopf(changes: Iterable[StabilityChange]) -> HopfPoint | None:
    """The Hopf point of lowest speed, None if there is none."""
    return next((point for point in changes if isinstance(point, HopfPoint)), None)


def hopf_row(point: HopfPoint | None, window: tuple[float, float]) -> dict[str, Any]:
    """Columns of a Hopf point: v m/s, frequency rad/s, flc (MATCONT), kind, words.

    A window without a Hopf point gives None for the numbers and says so in ``words``.
    """
    if point is None:
        words = f"no Hopf point between {window[0]:g} and {window[1]:g} m/s"
        return {"v": None, "frequency": None, "flc": None, "kind": "", "words": words}
    return {
        "v": point.value,
        "frequency": point.frequency,
        "flc": point.lyapunov,
        "kind": point.kind,
        "words": point.words,
    }
