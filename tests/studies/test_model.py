"""The model chapter's tables come from the objects that are computed."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.studies import model
from wheelset.vehicle import load_vehicle, vehicle_names
from wheelset.vehicle.equations import equations_of_motion
from wheelset.vehicle.flange import FLANGE_LAWS
from wheelset.vehicle.latex import equation_latex
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.parameters import BY_NAME


@pytest.mark.parametrize("vehicle", vehicle_names())
def test_every_equation_of_the_model_is_printed_once(vehicle):
    printed = [e for s in model.equations(model.Parameters(vehicle=vehicle)) for e in s.equations]
    equations = equations_of_motion(load_vehicle(vehicle).options)
    computed = (*equations.geometry, equations.roll, *equations.wheel, *equations.body)
    wanted = [e for e in computed if e.symbol.name not in ("cos_gamma", "sin_gamma")]
    assert sorted(printed) == sorted(map(equation_latex, wanted))


@pytest.mark.parametrize("law", FLANGE_LAWS)
def test_every_symbol_has_a_letter(law):
    options = ModelOptions(flange_law=law, creep_law="shen_hedrick_elkins", spin_moment="fit")
    equations = equations_of_motion(options)
    for equation in (*equations.geometry, equations.roll, *equations.wheel, *equations.body):
        latex = equation_latex(equation)
        assert "_left" not in latex
        assert r"\mathrm{F" not in latex
        assert r"\\" not in latex


def test_symbols_are_all_parameters_with_their_reasons():
    table = model.symbols(model.Parameters())
    assert set(table["name"]) == set(BY_NAME)
    hidden = table[table["status"].isin(["inferred", "assumed"])]
    assert (hidden["reason"].str.len() > 10).all()


def test_only_the_reversed_signs_depart_in_the_default_vehicle():
    table = model.departures(model.Parameters())
    assert list(table[table["departs"]]["option"]) == ["contact_angle_sign"]


def test_domain_ends_where_the_curvature_sum_vanishes():
    p = model.Parameters()
    domain = model.domain(p).set_index("side")
    assert domain.loc["right", "high"] == pytest.approx(0.01165, abs=1e-5)
    assert domain.loc["left", "low"] == -domain.loc["right", "high"]
    right = model.contact_geometry(p).query("side == 'right'")
    inside = right["y"] < domain.loc["right", "high"]
    assert (np.asarray(right["rho"] > 0) == np.asarray(inside)).all()
