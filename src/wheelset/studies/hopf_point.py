"""Section 4, first page: the default Hopf point and the eigenvalues around it.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 4.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pandas as pd
from pydantic import Field

from wheelset.bifurcation.equilibria.equilibrium import EigenvalueLoci, eigenvalue_loci
from wheelset.hunting import hunting_system
from wheelset.studies.hopf_rows import first_hopf, hopf_row, stability_changes
from wheelset.studies.parameters import VehicleName, WindowParameters

_POINTS = {"quick": 60, "paper": 400}


class Parameters(WindowParameters):
    """Parameters of the study of section 4's default Hopf point."""

    vehicle: VehicleName = Field(
        default="guo2021", description="Name of a packaged vehicle or path of a vehicle file."
    )


def default_hopf(p: Parameters) -> pd.DataFrame:
    """Every stability change of the vehicle in the speed window, one row each.

    Columns: v m/s, frequency rad/s, wavelength m, flc (MATCONT's normalisation), kind, words.
    """
    changes = stability_changes(p.load(p.vehicle), p.window)
    rows = [{**_numbers(point), "kind": point.kind, "words": point.words} for point in changes]
    return pd.DataFrame(rows, columns=["v", "frequency", "wavelength", "flc", "kind", "words"])


def _numbers(point: object) -> dict[str, float | None]:
    v, frequency = getattr(point, "value", None), getattr(point, "frequency", None)
    wavelength = 2 * np.pi * v / frequency if v and frequency else None
    return {
        "v": v,
        "frequency": frequency,
        "wavelength": wavelength,
        "flc": getattr(point, "lyapunov", None),
    }


def first_default(p: Parameters, vehicle: str | None = None) -> SimpleNamespace:
    """Hopf point of lowest speed of a vehicle (default: the study's): v, frequency, flc, kind,
    words; None for the numbers, and words that say so, where the window holds none.
    """
    changes = stability_changes(p.load(vehicle or p.vehicle), p.window)
    return SimpleNamespace(**hopf_row(first_hopf(changes), p.window))


def loci(p: Parameters) -> EigenvalueLoci:
    """The four eigenvalues [1/s] of straight running over the speed window, as curves."""
    speeds = np.linspace(p.v_min, p.v_max, _POINTS[p.resolution])
    return eigenvalue_loci(hunting_system(p.load(p.vehicle)), "v", speeds)


def eigenvalue_frame(curves: EigenvalueLoci) -> pd.DataFrame:
    """Loci in long form: v m/s, locus 1..n, re 1/s, im 1/s."""
    points, n = curves.eigenvalues.shape
    return pd.DataFrame(
        {
            "v": np.repeat(curves.values, n),
            "locus": np.tile(np.arange(1, n + 1), points),
            "re": curves.eigenvalues.real.ravel(),
            "im": curves.eigenvalues.imag.ravel(),
        }
    )
