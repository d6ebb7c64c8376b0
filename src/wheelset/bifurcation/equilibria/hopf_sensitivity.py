"""How a Hopf point moves with the other parameters."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.equilibria.lyapunov import critical_pair, resolvent
from wheelset.bifurcation.system import System

#: A real part this small beside its number is rounding.
ROUNDING = 1e-12


def hopf_sensitivity(system: System, hopf: HopfPoint, names: Iterable[str]) -> dict[str, float]:
    """Derivatives of a Hopf point's value by other parameters, SI, exact.

    The point stays where the real part of its eigenvalue is zero. Raises SingularSystem where the
    eigenvalue does not cross the axis with the point's own parameter.
    """
    chosen = tuple(names)
    slopes = eigenvalue_slopes(system, hopf, (hopf.parameter, *chosen))
    own = slopes[hopf.parameter]
    if abs(own.real) <= ROUNDING * abs(own):
        raise SingularSystem(f"the eigenvalues do not cross the axis with {hopf.parameter}")
    return {name: -slopes[name].real / own.real for name in chosen}


def eigenvalue_slopes(system: System, hopf: HopfPoint, names: Iterable[str]) -> dict[str, complex]:
    """Derivatives of a Hopf point's eigenvalue i w by parameters, the equilibrium taken along.

    With its eigenvectors q, p: dl = <p, D^2 f [q, d]>, d = (-A^-1 f_p, unit direction). Raises
    SingularSystem where 0 is an eigenvalue too.
    """
    x, p = np.array(hopf.state), system.p(**{hopf.parameter: hopf.value})
    pair = critical_pair(system.jacobian(x, p), hopf.frequency)

    def slope(name: str) -> complex:
        unit = np.concatenate([np.zeros(system.n), system.directions(name)[0]])
        shift = resolvent(pair, 0, system.form(x, p, unit)).real
        along = np.concatenate([shift, unit[system.n :]])
        return complex(np.vdot(pair.p, system.form(x, p, pair.q, along)))

    return {name: slope(name) for name in names}
