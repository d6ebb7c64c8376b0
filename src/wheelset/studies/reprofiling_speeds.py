"""Both critical speeds of wheels that differ a little from a known one, from functions of y.

The Hopf point needs the functions' Taylor coefficients in the middle only, up to the third. Folds
of cycles move by the first order: at a fold there is a psi orthogonal to all that a change of orbit
and period can cause, so that ``int psi . (f_v dv + df) dt = 0`` with df what the other functions
change in the field along the known cycle.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from wheelset.bifurcation.curves.branch import SpecialPoint
from wheelset.bifurcation.cycles.cycle_start import known, mode_at
from wheelset.bifurcation.cycles.fold_sensitivity import fold_sensitivity
from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch, hopf_batch
from wheelset.bifurcation.fields.sampling import TaylorFunction
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.profiles.geometry import QUANTITIES
from wheelset.vehicle import Vehicle

Array = NDArray[np.float64]

#: Coefficients of the model, constant first, by the functions; the constant of dr is zero.
COEFFICIENTS = {
    "dr": ("a1", "a2", "a3"),
    "delta": ("c0", "c1", "c2", "c3"),
    "rho": ("e0", "e1", "e2", "e3"),
}

#: The other summands of the same functions, which are zero here.
ZERO = ("f0", "f1", "f2", "f3")

#: Orders of Taylor coefficients in the equations up to the first Lyapunov coefficient.
ORDER = 3

#: Step of a function's value for the field's derivative by it: m, rad, 1/m.
STEPS = {"dr": 1e-7, "delta": 1e-6, "rho": 1e-4}

_SIDES = {1: "left", -1: "right"}


def taylor(average: BSpline) -> Array:
    """Operators (4, Y) to the averaged functions' Taylor coefficients in the middle."""
    return np.stack([average(0.0, k) / math.factorial(k) for k in range(ORDER + 1)])


def coefficients(operators: Array, functions: Array) -> dict[str, Array]:
    """The model's coefficients of functions (samples, 3, Y), SI, each (samples,)."""
    values = functions @ operators.T
    named: dict[str, Array] = {}
    for k, quantity in enumerate(QUANTITIES):
        names = COEFFICIENTS[quantity]
        named |= dict(zip(names, values[:, k, ORDER + 1 - len(names) :].T, strict=True))
    return named


def hopf_speeds(
    vehicle: Vehicle, known_coefficients: Mapping[str, Array], near: float, stiffness: float = 1.0
) -> HopfBatch:
    """Hopf points in v beside ``near`` [m/s], with the suspension's stiffnesses times a factor."""
    system = hunting_system(vehicle)
    rows = np.tile(system.p(v=near), (len(known_coefficients["a1"]), 1))
    for name in ("Kpx", "Kpy"):
        rows[:, system.index(name)] *= stiffness
    for name in system.parameter_names:
        if name in ZERO or name.startswith(("da", "dc", "dh")):
            rows[:, system.index(name)] = 0.0
    for name, values in known_coefficients.items():
        rows[:, system.index(name)] = values
    return hopf_batch(system, "v", rows)


@dataclass(frozen=True, eq=False)
class FoldResponse:
    """How a fold moves with the functions of y: its speed [m/s], amplitude [m], and by kernel
    (3, Y) what a change of the functions [m, rad, 1/m] does to the speed. power: the speed goes
    with this power of a factor on both stiffnesses of the suspension.
    """

    speed: float
    amplitude: float
    kernel: Array
    power: float

    def speeds(self, changes: Array) -> Array:
        """Speeds [m/s] for changes (samples, 3, Y) of the functions."""
        return self.speed + np.einsum("sky,ky->s", changes, self.kernel)


def fold_response(system: System, fold: SpecialPoint, average: BSpline) -> FoldResponse:
    """Of a fold in v on both wheels alike."""
    curve, u = known(system, fold.solution, ("v",), (None,))
    space, orbit = curve.space, curve.space.split(u)
    p = space.parameters(orbit.free)
    psi = mode_at(curve, u, flip=False)[0].psi.reshape(-1, system.n)
    states = orbit.stages.reshape(-1, system.n)
    unit = np.concatenate([np.zeros(system.n), system.directions("v")[0]])
    own = float((psi * system.forms(states, p, unit).real).sum())
    kernel = np.zeros((len(QUANTITIES), average.c.shape[1]))
    for (quantity, s), slope in _slopes(system, states, p).items():
        weights = -(psi * slope).sum(axis=1) / own
        kernel[QUANTITIES.index(quantity)] += weights @ average(s * states[:, 0])
    v = float(fold.values[0])
    springs = fold_sensitivity(system, fold.solution, "v", ("Kpx", "Kpy"))
    power = sum(springs[name] * system.values[name] for name in springs) / v
    return FoldResponse(v, float(fold.solution.measure("amplitude y")), kernel, power)


@dataclass(frozen=True, eq=False)
class _Raised:
    """A function with its value raised, by as much at every point (points,)."""

    function: TaylorFunction
    by: Array

    def taylor(self, y: Array, order: int) -> Array:
        """As the function's, but for the value."""
        values = self.function.taylor(y, order)
        values[:, 0] += self.by
        return values


def _slopes(system: System, states: Array, p: Array) -> dict[tuple[str, int], Array]:
    """The field's derivatives by the functions' values along states, by quantity and side.

    All in one evaluation: the states are repeated, and each time another function is raised.
    """
    names = [(q, s) for q in QUANTITIES for s in (1, -1)]
    count, by = len(states), {}
    for k, (quantity, s) in enumerate(names):
        by[quantity, s] = np.zeros((2 * len(names), count))
        by[quantity, s][2 * k : 2 * k + 2] = STEPS[quantity] * np.array([[1.0], [-1.0]])
    raised = {f"{q}_{_SIDES[s]}": by[q, s].ravel() for q, s in names}
    functions = {n: _Raised(f, raised[n]) for n, f in system.functions.items()}
    moved = replace(system, functions=functions)
    values = moved.forms(np.tile(states, (2 * len(names), 1)), p).real
    values = values.reshape(len(names), 2, count, system.n)
    return {
        (q, s): (values[k, 0] - values[k, 1]) / (2 * STEPS[q]) for k, (q, s) in enumerate(names)
    }
