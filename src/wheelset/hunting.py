"""The door between the wings: a vehicle becomes a dynamical system for ``bifurcation``.

State x = (y, psi, yd, psid) in (m, rad, m/s, rad/s); parameters are the vehicle's, in SI units,
and the speed ``v`` in m/s.
"""

from __future__ import annotations

import math
from functools import lru_cache

import sympy as sp

from wheelset.bifurcation.fields.field import Condition, Switch, VectorField
from wheelset.bifurcation.integration.events import ThresholdPair
from wheelset.bifurcation.system import System
from wheelset.vehicle.equations import EquationsOfMotion, equations_of_motion
from wheelset.vehicle.flange import region
from wheelset.vehicle.geometry import ContactGeometry, PolynomialGeometry
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.symbols import STATE, p, reach, v, y
from wheelset.vehicle.vehicle import Vehicle

#: Speed a system starts with, m/s.
DEFAULT_SPEED = 50.0

#: Typical sizes of the states, for norms: a millimetre and a milliradian at 6 Hz.
SCALES = {"y": 1e-3, "psi": 1e-3, "yd": 4e-2, "psid": 4e-2}


def hunting_system(
    vehicle: Vehicle, contact: ContactGeometry | None = None, speed: float = DEFAULT_SPEED
) -> System:
    """The hunting motion of a vehicle's wheelset on straight track, Eqs. (16), (17), (22).

    contact: a geometry to use instead of the vehicle's polynomials. speed: default of v, m/s.
    """
    geometry = contact or PolynomialGeometry()
    field = (
        _polynomial_field(vehicle.options)
        if contact is None
        else _field(equations_of_motion(vehicle.options, geometry))
    )
    values = {**vehicle.values, "v": speed, reach.name: geometry.reach or math.inf}
    used = {name: values[name] for name in field.parameter_names if name in values}
    return System(field, used, dict(geometry.functions), SCALES)


def flange_contact(vehicle: Vehicle) -> tuple[ThresholdPair, ...]:
    """Events for ``integrate``: |y| rises above the flange clearance eta, or falls below it.

    Empty for a vehicle without a clearance.
    """
    eta = vehicle.values.get("eta")
    if eta is None:
        return ()
    return (ThresholdPair("y", eta, "flange contact entered", "flange contact left"),)


@lru_cache(maxsize=32)
def _polynomial_field(options: ModelOptions) -> VectorField:
    """Fields differ by the structural options only, so one is written an option set."""
    return _field(equations_of_motion(options))


def _field(equations: EquationsOfMotion) -> VectorField:
    expressions = [e for _, e in equations.assignments]
    used = set().union(*(e.free_symbols for e in expressions))
    law = equations.law
    switch = None if law.smooth else Switch(region, y, law.thresholds, law.regions)
    known = (*vars(p).values(), reach)
    inputs = (v, *(q for q in known if q in used), *((region,) if switch else ()))
    return VectorField(
        STATE, inputs, equations.derivative, equations.assignments, _domain(equations), switch
    )


def _domain(equations: EquationsOfMotion) -> tuple[Condition, ...]:
    return tuple(
        Condition(
            sp.Symbol(r.symbol.name, real=True), r.quantity, r.where, r.unit, r.least, r.order
        )
        for r in equations.requirements
    )
