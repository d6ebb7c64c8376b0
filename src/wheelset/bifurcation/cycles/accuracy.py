"""How accurate a computed cycle is: the same cycle on a mesh twice as fine.

Mesh values and the period converge with order 2 m, so the difference from the finer solution is the
error of the coarser one to within a part in 2^(2 m).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from wheelset.bifurcation.curves.locate import any_tangent, corrected
from wheelset.bifurcation.cycles import refinement
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_start import known
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CycleError:
    """Differences from the same cycle on a mesh twice as fine.

    period: relative. states: greatest at a mesh point, relative to the state's greatest modulus.
    multipliers (n,): absolute, of ``finer.multipliers``, complex multipliers by modulus of the
    difference. finer: that cycle.
    """

    period: float
    states: float
    multipliers: Array
    finer: Cycle

    @property
    def greatest(self) -> float:
        """The greater of the errors of period and states."""
        return max(self.period, self.states)


def cycle_error(system: System, cycle: Cycle, parameter: str) -> CycleError:
    """The error of a cycle's period, mesh values and Floquet multipliers.

    parameter: the branch the cycle belongs to; the finer cycle is the one across the branch, so
    that folds are no exception (its parameter differs by the error).
    """
    curve, u = known(system, cycle, (parameter,), (None,))
    fine, guess = refinement.finer(curve, u)
    tangent = any_tangent(fine.linearised(guess), fine.metric)
    point = corrected(fine, guess, tangent, 1e-11, 12, 1e-8).point
    better = fine.solution(point)
    scale = np.abs(cycle.nodes).max(axis=(0, 1))
    at_mesh = np.abs(better.nodes[::2, 0] - cycle.nodes[:, 0]).max(axis=0) / scale
    return CycleError(
        abs(better.period / cycle.period - 1),
        float(at_mesh.max()),
        _matched(better.multipliers, cycle.multipliers),
        better,
    )


def _matched(finer: NDArray, coarser: NDArray) -> Array:
    """|difference| of each finer multiplier from its partner."""
    distance = np.abs(finer[:, np.newaxis] - coarser)
    rows, columns = linear_sum_assignment(distance)
    return np.asarray(distance[rows, columns])
