"""Weights of the scaled norm in which a curve's steps are measured."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.curves.front import Window
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]


def state_weights(system: System, scales: ArrayLike | None) -> Array:
    """1/scale^2 of each state (n,); scales: typical sizes in SI units, default the system's."""
    n = system.n
    sizes = np.asarray(system.state_scales if scales is None else scales, dtype=np.float64)
    if sizes.shape != (n,) or not np.all((sizes > 0) & np.isfinite(sizes)):
        raise ValueError(f"scales = {scales!r}: needs {n} positive numbers, one a state variable")
    return 1 / sizes**2


def parameter_weight(window: Window | None, value: float) -> float:
    """1/scale^2 of a parameter: the scale is its window's width, else its value or one unit."""
    width = math.inf if window is None else float(window[1]) - float(window[0])
    if not width > 0:
        raise ValueError(f"window = {window}: needs the lower bound first")
    return 1 / (width if math.isfinite(width) else max(abs(value), 1.0)) ** 2
