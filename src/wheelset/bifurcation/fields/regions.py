"""Regions of a piecewise smooth field: between which thresholds a state lies."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from wheelset.bifurcation.fields.field import Switch, VectorField

Array = NDArray[np.float64]


def thresholds(field: VectorField, p: Array) -> tuple[float, ...]:
    """Values of the switching thresholds at p, increasing; none for a smooth field."""
    if field.switch is None:
        return ()
    return tuple(float(t) for t in _compiled(field.switch, field.parameters)(*p))


@lru_cache(maxsize=32)
def _compiled(switch: Switch, parameters: tuple[sp.Symbol, ...]) -> Any:
    return sp.lambdify(parameters, list(switch.thresholds))


def region_of(field: VectorField, state: Any, p: Array) -> Array:
    """Region value at states given as their n components (floats or arrays of one shape)."""
    switch = field.switch
    if switch is None:
        raise ValueError("the field is smooth: it has no regions")
    variable = np.asarray(state[field.state.index(switch.variable)], dtype=np.float64)
    below = np.sum([variable > t for t in thresholds(field, p)], axis=0)
    return np.asarray(switch.values)[below]


def split(field: VectorField, points: Array, p: Array) -> list[tuple[Array, Any]]:
    """Pairs of p with its region set, and which of the points (points, n) lie in that region."""
    if field.switch is None:
        return [(p, slice(None))]
    regions = region_of(field, points.T, p)
    return [(in_region(field, p, value), regions == value) for value in np.unique(regions)]


def in_region(field: VectorField, p: Array, value: float) -> Array:
    """A copy of p with its region parameter set."""
    if field.switch is None:
        raise ValueError("the field is smooth: it has no regions")
    p = p.copy()
    p[field.parameters.index(field.switch.region)] = value
    return p
