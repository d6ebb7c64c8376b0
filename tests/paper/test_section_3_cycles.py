"""The bifurcations of cycles that section 3 prints: ours beside them, and what became of each."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.paper.flange_cycles import (
    ITEMS,
    P,
    constant,
    curves,
    filed,
    panel_of,
    vehicle_of,
    verdicts,
)
from tests.paper.judging import judged
from wheelset.bifurcation.cycles.accuracy import cycle_error
from wheelset.published.items import item_frame
from wheelset.published.rules import verdict
from wheelset.studies import (
    flange_cycle_meshes,
    flange_cycle_motions,
    flange_cycle_tables,
    flange_cycle_verdicts,
    flange_neglect,
    flange_readings,
)

pytestmark = pytest.mark.slow

#: The verdict on each printed point.
EXPECTED = {
    "case 1, reciprocal, PD": flange_cycle_verdicts.REAL,
    "case 2, none, LPC": flange_cycle_verdicts.REAL,
    "case 2, none, BPC": flange_cycle_verdicts.ARTEFACT,
    "case 2, none, PD": flange_cycle_verdicts.OUTSIDE,
    "case 2, polynomial, LPC": flange_cycle_verdicts.ELSEWHERE,
    "case 2, polynomial, BPC": flange_cycle_verdicts.ARTEFACT,
    "case 2, exponential, LPC": flange_cycle_verdicts.REAL,
    "case 2, exponential, BPC": flange_cycle_verdicts.ARTEFACT,
    "case 2, reciprocal, LPC": flange_cycle_verdicts.REAL,
    "case 2, reciprocal, BPC 1": flange_cycle_verdicts.ARTEFACT,
    "case 2, reciprocal, BPC 2": flange_cycle_verdicts.ARTEFACT,
    "case 2, reciprocal, PD": flange_cycle_verdicts.REAL,
}


@cache
def meshes():
    return flange_cycle_meshes.mesh_frame(P, filed())


@cache
def numbers():
    return flange_cycle_verdicts.computed_numbers(item_frame(ITEMS), verdicts(), curves())


def special(case, law, name, letters):
    (family,) = [f for f in panel_of(case, law) if f.name == name]
    return family.branch.of_kind(letters)[0]


@pytest.mark.parametrize(("item", "vehicle"), judged(ITEMS, vehicle_of))
def test_number_is_the_papers(item, vehicle):
    value = numbers()[item.key]
    assert value is not None
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


def test_every_printed_point_has_its_verdict():
    found = verdicts().set_index(verdicts()["item"].str.removeprefix("Section 3: "))["verdict"]
    assert found.to_dict() == EXPECTED


def test_folds_of_case_2_are_the_printed_ones_and_with_constant_curvatures_one_is_missing():
    folds = verdicts()[(verdicts()["point"] == "LPC") & (verdicts()["law"] != "quintic")]
    assert len(folds) == 3
    assert folds["found"].to_numpy() == pytest.approx(folds["printed"].to_numpy(), abs=0.1)
    missing = folds["found_constant"].isna()
    assert folds.loc[missing, "law"].tolist() == ["none"]


def test_only_the_whole_curvature_sum_folds_at_the_printed_speed_without_flange():
    known = {"filed": filed(), "constant": constant()}
    table = flange_neglect.neglect_frame(P, item_frame(ITEMS), known).set_index("kept")
    apart = (table["case 2, none, LPC"] - table.loc["paper", "case 2, none, LPC"]).abs()
    missing = set(apart.index[apart.isna()])
    assert missing == {"constant", "only e₁ and f₁"}
    assert apart.idxmax() == "only e₃ and f₃"
    assert apart.drop(["paper", "only e₃ and f₃"]).min() == apart["filed"]


@pytest.mark.parametrize("case", P.cases)
def test_motions_settle_before_between_and_behind_as_the_branches_say(case):
    """Integration knows no multiplier; 60 micrometres of asymmetry are 500 times its error. The
    period itself falls by 1 percent over these speeds.
    """
    settled = flange_cycle_motions.settled_frame(panel_of(case, "reciprocal"))
    assert len(settled) >= 2
    lopsided = (settled["low"] + settled["high"]).abs().to_numpy()
    assert lopsided[0] < 1e-6
    assert (lopsided[1:] > 6e-5).all()
    periods = np.array([1.0, 1.0, 2.0])[: len(settled)]
    assert settled["ratio"].to_numpy() == pytest.approx(periods, rel=0.02)


def test_the_doubling_under_the_reciprocal_law_does_not_depend_on_the_mesh():
    point = special(2, "reciprocal", "H BPC1", "PD")
    error = cycle_error(panel_of(2, "reciprocal")[0].system, point.solution, "v")
    assert error.greatest < 1e-7
    assert error.multipliers.max() < 1e-3


def test_on_meshes_that_follow_the_cycle_the_real_points_survive():
    """Even the second doubling of case 1, half a micrometre from the pole."""
    adapted = meshes()[meshes()["adapted"] & meshes()["survives"]]
    letters = adapted[adapted["intervals"] >= 40].groupby(["case", "law", "intervals"])["point"]
    found = {place: set(points) for place, points in letters}
    for intervals in (40, 80):
        assert found[1, "reciprocal", intervals] == {"BPC", "PD"}
        assert found[2, "exponential", intervals] == {"LPC"}
        assert found[2, "reciprocal", intervals] == {"LPC", "BPC", "PD"}
        first = adapted[(adapted["intervals"] == intervals) & (adapted["case"] == 1)]
        assert first["point"].tolist() == ["BPC", "PD", "PD"]


def test_coarse_meshes_report_points_that_refinement_removes():
    spurious = meshes()[~meshes()["survives"]]
    coarse, fine = spurious[spurious["intervals"] < 80], spurious[spurious["intervals"] == 80]
    assert len(coarse) > 10
    assert set(coarse["law"]) == {"reciprocal"}
    assert fine.empty


def test_a_fixed_mesh_passes_the_pole_unseen():
    """Adapted polynomials stay within a micrometre of it."""
    pole = P.load(P.vehicle_case_2).values["q2"]
    pressed = meshes()[meshes()["law"] == "reciprocal"]
    assert pressed[~pressed["adapted"]]["reach"].max() > pole + 1e-5
    assert pressed[pressed["intervals"] == 80]["reach"].max() < pole + 1e-6


def test_the_physical_vehicle_hunts_when_curvatures_are_constant_and_stops_when_not():
    ends = flange_cycle_tables.end_frame(flange_readings.physical_families(P))
    first = ends[ends["family"] == "H"].set_index("reading")
    assert first.loc[flange_readings.PHYSICAL_CONSTANT, "y"] > 0.010
    for reading in (flange_readings.PHYSICAL, flange_readings.PHYSICAL_IN_FULL):
        assert first.loc[reading, "y"] < 0.0013
        ended = first.loc[reading, "ended"]
        assert "singularity" in ended or "domain" in ended
