"""Section 2: the model as it is computed: symbols with sources, equations, departures, domain.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, Eqs. (1)-(21), Table 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
import sympy as sp
from pydantic import Field

from wheelset.studies.parameters import StudyParameters, VehicleName
from wheelset.vehicle import ModelOptions, Vehicle
from wheelset.vehicle.equations import Equation, equations_of_motion
from wheelset.vehicle.geometry import QUANTITIES, SIDES, PolynomialGeometry
from wheelset.vehicle.latex import equation_latex
from wheelset.vehicle.options import allowed_values, option_meaning
from wheelset.vehicle.parameters import BY_NAME
from wheelset.vehicle.symbols import p as symbol
from wheelset.vehicle.symbols import y as lateral

_POINTS = {"quick": 61, "paper": 301}


class Parameters(StudyParameters):
    """Parameters of the study of the model itself."""

    vehicle: VehicleName = Field(
        default="guo2021", description="Name of a packaged vehicle or path of a vehicle file."
    )
    reach: float = Field(
        default=0.015,
        gt=0.0,
        le=0.05,
        description="Largest displacement of the contact geometry shown, m; up to 0.05.",
    )


@dataclass(frozen=True)
class Section:
    """Equations that belong together: a title and their LaTeX, in the order of evaluation."""

    title: str
    equations: tuple[str, ...]


def equations(p: Parameters) -> tuple[Section, ...]:
    """The equations of the vehicle's reading of the model, for a wheel of side s = +-1.

    Every line is written from the sympy expression that is also compiled and differentiated.
    """
    model = equations_of_motion(p.load(p.vehicle).options)
    numbered = (*model.geometry, model.roll, *model.wheel, *model.body)
    return tuple(
        Section(title, tuple(equation_latex(e) for e in numbered if _belongs(e, numbers)))
        for title, numbers in SECTIONS.items()
    )


#: Titles of the model's parts and the paper's equations in them; "" is a force without number.
SECTIONS: dict[str, tuple[str, ...]] = {
    "Contact geometry": ("1", "2", "3, 4"),
    "Hertzian contact": ("5", "6", "7"),
    "Normal force and creepages": ("8", "9"),
    "Creep forces": ("10", "11"),
    "Saturation": ("12", "13"),
    "Forces in track axes": ("14", "15"),
    "Flange force": ("", "24", "25", "26", "27"),
    "Equations of motion": ("16", "17"),
}

#: Abbreviations whose definition says nothing beyond their name.
_TAUTOLOGIES = ("cos_gamma", "sin_gamma")


def _belongs(equation: Equation, numbers: tuple[str, ...]) -> bool:
    return equation.number in numbers and equation.symbol.name not in _TAUTOLOGIES


def symbols(p: Parameters) -> pd.DataFrame:
    """Every parameter of the vehicle.

    Columns: name, latex, meaning, equation, value (SI), unit, status (printed, inferred, assumed,
    user, default), source, reason.
    """
    vehicle = p.load(p.vehicle)
    return pd.DataFrame([_symbol_row(vehicle, name) for name in vehicle.values])


def _symbol_row(vehicle: Vehicle, name: str) -> dict[str, object]:
    quantity, parameter = vehicle.quantity(name), BY_NAME[name]
    return {
        "name": name,
        "latex": parameter.latex,
        "meaning": parameter.meaning,
        "equation": parameter.equation,
        **quantity.model_dump(include={"value", "unit", "status", "source", "reason"}),
    }


def departures(p: Parameters) -> pd.DataFrame:
    """The structural options of the model in the vehicle.

    Columns: option, chosen, printed (what physics and the printed equations say), choices, departs
    (whether chosen differs), meaning.
    """
    chosen, printed = p.load(p.vehicle).options.model_dump(), ModelOptions().model_dump()
    rows = [
        {
            "option": name,
            "chosen": value,
            "printed": printed[name],
            "choices": ", ".join(map(str, allowed_values(name))),
            "departs": value != printed[name],
            "meaning": option_meaning(name),
        }
        for name, value in chosen.items()
    ]
    return pd.DataFrame(rows)


def contact_geometry(p: Parameters) -> pd.DataFrame:
    """Contact geometry by displacement and side.

    Columns: side, y m, dr m (rolling radius less r0), delta rad, rho 1/m (sum of curvatures).
    """
    values = p.load(p.vehicle).values
    displacement = np.linspace(-p.reach, p.reach, _POINTS[p.resolution])
    frames = [
        pd.DataFrame({"side": side, "y": displacement, **_on_side(side, values, displacement)})
        for side in SIDES
    ]
    return pd.concat(frames, ignore_index=True)


def _on_side(
    side: str, values: dict[str, float], displacement: np.ndarray
) -> dict[str, np.ndarray]:
    functions = {q: sp.lambdify(lateral, _polynomial(q, side, values)) for q in QUANTITIES}
    return {q: np.broadcast_to(f(displacement), displacement.shape) for q, f in functions.items()}


def _polynomial(quantity: str, side: str, values: dict[str, float]) -> sp.Expr:
    expression = PolynomialGeometry().expression(quantity, side)
    return expression.subs({getattr(symbol, name): value for name, value in values.items()})


def domain(p: Parameters) -> pd.DataFrame:
    """Where the sum of curvatures stays positive, by side: side, low m, high m.

    Beyond, Hertz's formulas (5), (6) have no meaning; infinite where there is no such end.
    """
    values = p.load(p.vehicle).values
    return pd.DataFrame([_domain_row(side, values) for side in SIDES])


def _domain_row(side: str, values: dict[str, float]) -> dict[str, object]:
    curvature = sp.Poly(_polynomial("rho", side, values), lateral)
    roots = np.roots([float(c) for c in curvature.all_coeffs()])
    ends = roots[np.abs(roots.imag) < 1e-12].real
    return {
        "side": side,
        "low": max(ends[ends < 0], default=-np.inf),
        "high": min(ends[ends > 0], default=np.inf),
    }
