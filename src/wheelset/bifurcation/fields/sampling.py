"""Functions of one state variable known by their Taylor coefficients: splines, sines, tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.fields.tape import Tape
from wheelset.bifurcation.outcomes import NotFinite, as_tuple

Array = NDArray[np.float64]


class TaylorFunction(Protocol):
    """A function of one variable that can be expanded anywhere: a spline, a sine, a table."""

    def taylor(self, y: Array, order: int) -> Array:
        """Coefficients f^(j)(y)/j!, j = 0..order, shape ``y.shape + (order + 1,)``."""
        ...


def sampled(
    tape: Tape,
    functions: Mapping[str, TaylorFunction],
    points: Array,
    order: int,
    names: tuple[str, ...],
) -> Array:
    """Coefficients of every sampled function of a tape, shape (points, functions, order + 1).

    points (points, n), whose components are called ``names``. Raises NotFinite at the first point
    outside the range of a function.
    """
    out = np.empty((len(points), len(tape.sampled), order + 1))
    for i, (name, state) in enumerate(tape.sampled):
        out[:, i] = functions[name].taylor(points[:, state], order)
        outside = ~np.isfinite(out[:, i]).all(axis=-1)
        if outside.any():
            x = as_tuple(points[np.argmax(outside)])
            raise NotFinite(f"sampled function {name}, outside its range", x, names)
    return out
