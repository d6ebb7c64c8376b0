"""Three systems with a cycle that needs no paper: for looking at the engine itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_from_cycle,
    cycle_from_hopf,
    cycle_from_orbit,
)
from wheelset.bifurcation.cycles.gauss import gauss
from wheelset.bifurcation.equilibria.hopf import HopfPoint, instabilities
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System
from wheelset.hunting import SCALES

Array = NDArray[np.float64]

#: The toy wheelset's coefficients, SI.
TOY = {
    "m": 1550.0, "I": 990.0, "Ky": 1e6, "Kx": 1e6, "r0": 0.46, "b": 0.75, "a1": 0.23,
    "a3": 100.0, "f": 8e6, "p1": 3.906e-4, "q": 1645.0, "v": 50.0,
}  # fmt: skip

#: Where the first Hopf point is sought, m/s, and how far beyond it cycles are followed.
SPEEDS, BEYOND = (5.0, 200.0), 1.05

#: Typical change of the speed, m/s, for norms.
WIDTH = 10.0

#: Meshes stay as they are made, of equal intervals, so that an order is one.
FIXED = Meshing(every=0, accuracy=None)


@dataclass(frozen=True, eq=False)
class Example:
    """A system with a cycle, and with a fold of cycles where there is one.

    free: the parameter of the branch, then those along which the fold could be followed.
    """

    name: str
    system: System
    free: tuple[str, ...]
    cycle: Cycle
    fold: Cycle | None = None


def toy_wheelset() -> System:
    """A wheelset with constant creep coefficients and the exponential flange; odd, as the real one.

    m y'' = -2 Ky y - 2 f (y'/v - psi) - p1 (e^(q y) - e^(-q y)),
    I psi'' = -2 Kx psi - 2 f b^2 psi'/v - 2 f (b/r0) (a1 y + a3 y^3).
    """
    return System.from_function(_toy_field, tuple(SCALES), TOY, SCALES)


def _toy_field(x: Sequence[sp.Symbol], p: Sequence[sp.Symbol]) -> list[sp.Expr]:
    y, psi, yd, psid = x
    m, inertia, Ky, Kx, r0, b, a1, a3, f, p1, q, v = p
    lateral = -2 * Ky * y - 2 * f * (yd / v - psi) - p1 * (sp.exp(q * y) - sp.exp(-q * y))
    yaw = -2 * Kx * psi - 2 * f * b**2 * psid / v - 2 * f * b / r0 * (a1 * y + a3 * y**3)
    return [yd, psid, lateral / m, yaw / inertia]


def van_der_pol(mu: float = 1.0) -> System:
    """x' = y, y' = mu (1 - x^2) y - x."""
    return System.from_function(
        lambda x, p: [x[1], p[0] * (1 - x[0] ** 2) * x[1] - x[0]], ("x", "y"), {"mu": mu}
    )


def wheelset_cycle(name: str, system: System) -> Example:
    """The cycles born at the first Hopf point in speed: their first fold, and the last of them.

    Raises NoConvergence where straight running does not lose its stability.
    """
    changes = instabilities(system, "v", SPEEDS)
    hopf = next((point for point in changes if isinstance(point, HopfPoint)), None)
    if hopf is None:
        raise NoConvergence(f"{name}: no Hopf point at {SPEEDS[0]:g} to {SPEEDS[1]:g} m/s", ())
    start = cycle_from_hopf(system, hopf, WIDTH)
    window = hopf.value / BEYOND, hopf.value * BEYOND
    branch = follow(start.problem, start.u, direction=start.tangent, windows={"v": window})
    folds = branch.of_kind("LPC")
    fold = folds[0].solution if folds else None
    return Example(name, system, ("v", "a3"), branch.points[-1].solution, fold)


def oscillator_cycle() -> Example:
    """Van der Pol's cycle at mu = 1, from an integration that settles on it."""
    system = van_der_pol()
    orbit = integrate(system, [2.0, 0.0], 40.0)
    start = cycle_from_orbit(system, "mu", orbit, discretisation=Discretisation(20, True))
    return Example("van der Pol", system, ("mu",), solved(start))


def on_mesh(cycle: Cycle, intervals: int, half: bool) -> Cycle:
    """A cycle's polynomials evaluated on equal intervals of the full or of the half period."""
    mesh = np.linspace(0, 1, intervals + 1)
    c = np.concatenate([[0.0], gauss().c])
    phases = (mesh[:-1, np.newaxis] + c / intervals) * (0.5 if half else 1.0)
    signs = cycle.signs if half else None
    return replace(cycle, mesh=mesh, nodes=cycle.at(phases), signs=signs)


def solved(start: Start) -> Cycle:
    """The cycle a branch starts with."""
    return start.problem.cycle(start.u, start.problem.linearised(start.u).floquet)


def computed(example: Example, intervals: int, half: bool) -> Cycle:
    """The example's cycle on so many equal intervals a period, its parameter kept."""
    guess = on_mesh(example.cycle, intervals // 2 if half else intervals, half)
    return solved(cycle_from_cycle(example.system, guess, example.free[0], WIDTH, FIXED))


def fold_value(example: Example, intervals: int, half: bool) -> float | None:
    """Where the fold is on so many equal intervals a period, the second parameter kept."""
    if example.fold is None:
        return None
    guess = on_mesh(example.fold, intervals // 2 if half else intervals, half)
    first, second = example.free
    start = lpc_from_cycle(example.system, guess, (first, second), (WIDTH, None), FIXED)
    return float(start.problem.values(start.u)[0])
