"""What a fit of the contact geometry does to the critical speeds.

Polynomials as in Eqs. (1)-(4), sine series as the paper suggests for worn profiles, splines. Each
is fitted to the same contacts, and taken through the same Hopf point, cycles and folds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.profiles import Contact, PolynomialFit, SineFit, SplineGeometry
from wheelset.profiles.geometry import QUANTITIES, FittedGeometry
from wheelset.studies.on_profiles import (
    OnProfiles,
    cycle_table,
    on_geometry,
    speed_of_amplitude,
    speeds_row,
)
from wheelset.studies.profile_contact import Parameters

Make = Callable[[Contact, float], FittedGeometry]

#: The |y| up to which fits are made, m: short of the flange, which no polynomial of low degree and
#: no short sine series can have together with the tread.
REACH = 0.006

#: Amplitudes at which the cycles' speeds are compared, m.
AMPLITUDES = (0.001, 0.002, 0.003, 0.005)

#: The fits by name and what they are fitted with.
FITS: Mapping[str, Make] = {
    "polynomial, degree 3": lambda contact, reach: PolynomialFit.of(contact, reach, 3),
    "polynomial, degree 5": lambda contact, reach: PolynomialFit.of(contact, reach, 5),
    "polynomial, degree 9": lambda contact, reach: PolynomialFit.of(contact, reach, 9),
    "polynomial, degree 13": lambda contact, reach: PolynomialFit.of(contact, reach, 13),
    "sines, 4 terms": lambda contact, reach: SineFit.of(contact, reach, 4),
    "sines, 8 terms": lambda contact, reach: SineFit.of(contact, reach, 8),
    "spline, cross validation": lambda contact, reach: SplineGeometry.by_validation(contact, reach),
    "spline, 0.2 mm": lambda contact, reach: SplineGeometry.of(contact, reach, 2e-4),
    "spline, 0.5 mm": lambda contact, reach: SplineGeometry.of(contact, reach, 5e-4),
    "spline, 1 mm": lambda contact, reach: SplineGeometry.of(contact, reach, 1e-3),
}

#: The fits of the quick preview.
QUICK = ("polynomial, degree 3", "sines, 4 terms", "spline, 0.5 mm")


@dataclass(frozen=True, eq=False)
class Fit:
    """A fit, and the vehicle's run on it; words: why there is none."""

    name: str
    geometry: FittedGeometry
    run: OnProfiles | None
    words: str


def fits(p: Parameters, contact: Contact) -> tuple[Fit, ...]:
    """All fits with the vehicle's critical speeds and cycles on them."""
    names = QUICK if p.resolution == "quick" else tuple(FITS)
    return tuple(_fit(p, contact, name) for name in names)


def _fit(p: Parameters, contact: Contact, name: str) -> Fit:
    geometry = FITS[name](contact, REACH)
    try:
        run = on_geometry(p.loaded, contact, geometry, p.window)
    except NumericalOutcome as outcome:
        return Fit(name, geometry, None, str(outcome))
    return Fit(name, geometry, run, run.found.words)


def fit_errors(found: tuple[Fit, ...]) -> pd.DataFrame:
    """By fit: root mean square and largest error of the left wheel's dr m, delta rad, rho 1/m."""
    rows = []
    for fit in found:
        errors = {q: fit.geometry.errors[f"{q}_left"] for q in QUANTITIES}
        rms = {f"{q}_rms": error.rms for q, error in errors.items()}
        rows.append({"fit": fit.name, **rms, **{q: e.largest for q, e in errors.items()}})
    return pd.DataFrame(rows)


def fit_speeds(found: tuple[Fit, ...]) -> pd.DataFrame:
    """By fit: the columns of ``speeds_row``, and the speeds v1, v2, ... m/s of the cycles with
    AMPLITUDES; None where there is none.
    """
    return pd.DataFrame([{"fit": fit.name, **_speeds(fit)} for fit in found])


def _speeds(fit: Fit) -> dict[str, object]:
    if fit.run is None:
        return {"words": fit.words}
    at = speed_of_amplitude(fit.run, AMPLITUDES)
    return {
        **speeds_row(fit.run),
        **{f"v{1e3 * a:g}": v for a, v in zip(AMPLITUDES, at, strict=True)},
    }


def fit_functions(found: tuple[Fit, ...], contact: Contact) -> dict[str, pd.DataFrame]:
    """By fit, and by "contacts" the searched ones: y m, dr m, delta rad, rho 1/m, left wheel."""
    inside = contact.to_frame().loc[-REACH : REACH + 1e-9]
    searched = pd.DataFrame(
        {
            "y": inside.index.to_numpy(float),
            "dr": inside["r_left"] - np.interp(0.0, inside.index, inside["r_left"]),
            "delta": inside["delta_left"],
            "rho": inside["rho_left"],
        }
    )
    return {"contacts": searched, **{fit.name: _functions(fit.geometry) for fit in found}}


def _functions(geometry: FittedGeometry) -> pd.DataFrame:
    y = np.linspace(-geometry.reach, geometry.reach, 481)
    values = {q: geometry.functions[f"{q}_left"].taylor(y, 0)[:, 0] for q in QUANTITIES}
    return pd.DataFrame({"y": y, **values})


def fit_branches(found: tuple[Fit, ...]) -> dict[str, pd.DataFrame]:
    """By fit: its cycles, as ``cycle_table``."""
    return {fit.name: cycle_table(fit.run) for fit in found if fit.run is not None}
