"""How a fold of cycles moves with the other parameters."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_start import known, mode_at
from wheelset.bifurcation.system import System

#: What is this small beside its terms is rounding.
ROUNDING = 1e-14

Array = NDArray[np.float64]


def fold_sensitivity(
    system: System, cycle: Cycle, parameter: str, names: Iterable[str]
) -> dict[str, float]:
    """Derivatives of the parameter value of a fold (LPC) by other parameters, SI, exact.

    At a fold there is a psi orthogonal to everything that a change of orbit and period can cause,
    so that only the explicit dependence of f on the parameters is left:

        int psi . (f_v dv + f_p dp) dt = 0.

    cycle: of an LPC in ``parameter``. A parameter that breaks the symmetry of a cycle given by half
    its period has derivative zero: the fold moves with its square. Raises SingularSystem where the
    fold is none in ``parameter``.
    """
    curve, u = known(system, cycle, (parameter,), (None,))
    space, orbit = curve.space, curve.space.split(u)
    mode = mode_at(curve, u, flip=False)[0]
    p = space.parameters(orbit.free)

    def forcing(name: str) -> float:
        """Psi . f_p over the whole period."""
        total = _forced(system, orbit.stages, p, mode.psi, name)
        if space.half:
            signs = space.signs
            total += _forced(system, signs * orbit.stages, p, signs * mode.psi, name)
        return total

    own = forcing(parameter)
    if abs(own) <= ROUNDING * float(np.abs(mode.psi).sum()):
        raise SingularSystem(f"the fold does not depend on {parameter}")
    return {name: -forcing(name) / own for name in names}


def _forced(system: System, stages: Array, p: Array, psi: Array, name: str) -> float:
    unit = np.concatenate([np.zeros(system.n), system.directions(name)[0]])
    slope = system.forms(stages.reshape(-1, system.n), p, unit)
    return float((psi.reshape(-1, system.n) * slope.real).sum())
