"""A vehicle on profiles: the geometry goes through the engine as it is."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.profiles import Setup, packaged
from wheelset.profiles.functions import Polynomial
from wheelset.studies.first_fold import first_fold
from wheelset.studies.on_profiles import (
    cycle_table,
    lowest_cycle,
    on_profiles,
    on_track,
    searched,
    speed_of_amplitude,
    speeds_row,
)
from wheelset.vehicle import load_vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

WINDOW = (5.0, 200.0)
VEHICLE = load_vehicle("guo2021_physical")


@pytest.fixture(scope="module")
def contact():
    return searched(packaged("LMB10"), packaged("CHN60"), VEHICLE)


@pytest.fixture(scope="module")
def run(contact):
    return on_profiles(VEHICLE, contact, WINDOW)


def polynomials(values):
    """The vehicle's own polynomials as functions without a formula."""
    names = {"dr": "0 a1 a2 a3", "delta": "c0 c1 c2 c3"}
    common = {q: [values.get(c, 0.0) for c in names[q].split()] for q in names}
    common["rho"] = [values[f"e{k}"] + values[f"f{k}"] for k in range(4)]
    return [Polynomial(tuple(common[q])) for q in ("dr", "delta", "rho")]


def test_functions_without_a_formula_lead_to_the_fold_of_the_formula():
    vehicle = load_vehicle("guo2021", ["a3=200", "flange_law=exponential"])
    formula = first_fold(vehicle, WINDOW)
    geometry = ExpandedGeometry.mirrored(*polynomials(vehicle.values), reach=0.02)
    functions = first_fold(vehicle, WINDOW, geometry)
    assert functions.hopf.value == pytest.approx(formula.hopf.value, rel=1e-9)
    assert functions.hopf.lyapunov == pytest.approx(formula.hopf.lyapunov, rel=1e-7)
    assert functions.fold.values[0] == pytest.approx(formula.fold.values[0], rel=1e-8)


def test_cycles_end_where_the_contacts_do():
    vehicle = load_vehicle("guo2021", ["a3=200", "flange_law=exponential"])
    geometry = ExpandedGeometry.mirrored(*polynomials(vehicle.values), reach=0.004)
    branch = first_fold(vehicle, WINDOW, geometry).branch
    assert branch.ended.kind == "domain"
    assert "last displacement with a known contact" in branch.ended.words
    assert branch.points[-1].solution.measure("max y") == pytest.approx(0.004, abs=1e-5)


@pytest.mark.parametrize("reach", [0.0, -0.001, float("inf"), float("nan")])
def test_a_reach_that_is_none_is_refused(reach):
    with pytest.raises(ValueError, match=r"reach = .* out of range"):
        ExpandedGeometry.mirrored(*[Polynomial((0.0,))] * 3, reach=reach)


def test_the_track_has_the_vehicles_radius_and_base():
    setup = on_track(VEHICLE, Setup(gauge=1.433))
    assert (setup.gauge, setup.r0, setup.base) == (1.433, 0.46, 1.5)


def test_a_new_wheel_hunts_below_its_hopf_speed(run):
    row, lowest = speeds_row(run), lowest_cycle(run)
    assert row["v_non"] < row["v_fold"] < row["v_lin"]
    assert not lowest.bound
    assert row["amplitude"] > 0.009  # the flanges are reached
    assert row["flc"] > 0


def test_the_folds_width_matters_little_where_the_coefficients_does_much(contact, run):
    wide = on_profiles(VEHICLE, contact, WINDOW, width=1e-3)
    assert speeds_row(wide)["v_fold"] == pytest.approx(speeds_row(run)["v_fold"], rel=0.02)
    assert speeds_row(wide)["flc"] > 10 * speeds_row(run)["flc"]


def test_speeds_of_amplitudes_are_on_the_branch(run):
    table = cycle_table(run)
    at = len(table) // 3
    amplitude, v = table[["amplitude", "v"]].iloc[at]
    assert speed_of_amplitude(run, [amplitude])[0] == pytest.approx(v)
    assert np.isnan(speed_of_amplitude(run, [0.05])).all()
