"""How fine a mesh has to be: the error of a cycle against a mesh twice as fine.

Period and mesh values converge with order 2 m = 8, so the first Newton correction on the finer mesh
is the error of the coarser solution, to within a part in 2^8.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.cycles import meshes

if TYPE_CHECKING:
    from wheelset.bifurcation.cycles.cycle_curve import CycleCurve

Array = NDArray[np.float64]

#: Order of the error of mesh values.
ORDER = 8

#: A state smaller than this part of the others, in their scales, is compared with that part.
ABSENT = 1e-6

#: Intervals grow at most this much at a time, and by this much more than the order asks for.
MOST, SPARE = 3.0, 1.15


def finer(curve: CycleCurve, u: Array) -> tuple[CycleCurve, Array]:
    """The same problem on twice as many intervals, and u's polynomials there."""
    space = curve.space.on(np.repeat(curve.space.h, 2) / 2)
    guess = meshes.moved(curve.space, space, u)
    return curve.on(space, guess), guess


def mesh_error(curve: CycleCurve, u: Array, tangent: Array) -> float:
    """Estimated relative error of a cycle's period and mesh values, across a tangent (N,)."""
    fine, guess = finer(curve, u)
    row = fine.metric * meshes.moved(curve.space, fine.space, tangent)
    linearisation = fine.linearised(guess)
    change = fine.space.split(linearisation.newton(row)[0])
    size, scales = np.abs(curve.space.split(u).mesh_values).max(axis=0), curve.space.scales
    size = np.maximum(size, ABSENT * scales * (size / scales).max())
    moved = np.abs(change.nodes[::2, 0]) / size
    return max(float(moved.max()), abs(change.period) / fine.space.split(guess).period)


def intervals_for(intervals: int, error: float, wanted: float) -> int:
    """Number of intervals that brings an error below what is wanted; never fewer than there are."""
    if error <= wanted:
        return intervals
    return int(np.ceil(intervals * min(SPARE * (error / wanted) ** (1 / ORDER), MOST)))
