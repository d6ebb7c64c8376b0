"""Fig. 4: what section 3 says about the four force laws, on computed forces."""

from __future__ import annotations

import numpy as np
import pytest

from tests.paper.pictures import same_picture
from wheelset.plotting.flange import force_law_panels
from wheelset.published.figures import PANELS
from wheelset.studies import flange_claims, flange_models

P = flange_models.Parameters()
CLAIMS = flange_claims.figure_4_claims(P)
FORCES = flange_models.force_laws(P)
PANEL_OF = {
    "piecewise_linear": "piecewise linear",
    "quintic": "polynomial",
    "exponential": "exponential",
    "reciprocal": "reciprocal",
}


@pytest.mark.parametrize("claim", list(CLAIMS.itertuples()), ids=lambda c: f"{c.item}, {c.claim}")
def test_sentence_holds(claim):
    assert claim.low <= claim.measured <= claim.loose


@pytest.mark.parametrize("law", flange_models.FIGURE_4_LAWS)
def test_curve_crosses_the_whole_panel_or_stays_in_it(law):
    curve = FORCES[FORCES["law"] == law]
    (panel,) = (q for q in PANELS if q.figure == 4 and q.name == PANEL_OF[law])
    assert curve["y"].between(panel.x.low / 1e3, panel.x.high / 1e3).all()
    assert curve["force"].abs().max() >= 0.9 * panel.y.high * 1e3
    assert (np.sign(curve["force"].iloc[[0, -1]]).to_numpy() == [1, -1]).all()


def test_exponential_differs_from_piecewise_by_at_most_ten_kilonewtons_within_11_mm():
    a, b = (
        FORCES[(FORCES["law"] == law) & (FORCES["y"].abs() <= 0.011)]["force"].to_numpy()
        for law in ("exponential", "piecewise_linear")
    )
    assert 5e3 < np.abs(a - b).max() < 1e4


def test_polynomial_pushes_outward_below_ten_millimetres_only():
    away = FORCES["y"].abs()
    curve = FORCES[(FORCES["law"] == "quintic") & (away > 1e-4) & ((away - 0.010).abs() > 1e-6)]
    outward = curve["force"] * curve["y"] > 0
    assert (outward == (curve["y"].abs() < 0.010)).all()


def test_reciprocal_ends_at_its_poles():
    ends = flange_models.domains(P).set_index("law").loc["reciprocal"]
    assert (ends["low"], ends["high"]) == (-0.0112, 0.0112)
    assert FORCES[FORCES["law"] == "reciprocal"]["y"].abs().max() < 0.0112


def test_the_figure_looks_as_it_did(tmp_path):
    clearance = P.load(P.vehicle_case_1).values["eta"]
    same_picture("fig_4", force_law_panels(FORCES, flange_models.domains(P), clearance), tmp_path)
