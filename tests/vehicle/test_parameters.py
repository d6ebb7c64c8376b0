"""The registries: every parameter and option is documented, bounded and unique."""

from __future__ import annotations

import math

import pytest
from pydantic import ValidationError

from wheelset.vehicle import ModelOptions, Quantity
from wheelset.vehicle.options import allowed_values, option_meaning, option_names
from wheelset.vehicle.parameters import BY_NAME, PARAMETERS, TABLES, Bounds
from wheelset.vehicle.units import to_si

IDS = [parameter.name for parameter in PARAMETERS]


def test_names_and_letters_are_unique():
    assert len(BY_NAME) == len(PARAMETERS)
    assert len({p.latex for p in PARAMETERS}) == len(PARAMETERS)
    assert len({p.meaning for p in PARAMETERS if p.table == "geometry"}) == 15
    assert not set(BY_NAME) & set(option_names())
    assert TABLES == ("wheelset", "suspension", "contact", "geometry", "asymmetry", "flange")


@pytest.mark.parametrize("parameter", PARAMETERS, ids=IDS)
def test_a_parameter_is_complete_and_its_default_allowed(parameter):
    assert parameter.meaning
    assert parameter.latex
    assert parameter.equation
    assert parameter.default is None or parameter.bounds.contain(parameter.default)
    assert not parameter.bounds.contain(math.nan)
    assert not parameter.bounds.contain(math.inf)
    if parameter.needed_by:
        option, value = parameter.needed_by
        assert value in allowed_values(option)


@pytest.mark.parametrize("parameter", PARAMETERS, ids=IDS)
def test_its_unit_is_one_that_pint_reads(parameter):
    assert to_si(2.0, f"1 {parameter.unit}", parameter) == 2.0
    assert to_si(2.0, f" {parameter.unit} ", parameter) == 2.0


@pytest.mark.parametrize("option", option_names())
def test_an_option_explains_each_of_its_values(option):
    assert ModelOptions.model_fields[option].default in allowed_values(option)
    for value in allowed_values(option):
        assert f"{value}:" in option_meaning(option)


def test_options_are_immutable_and_closed():
    with pytest.raises(ValidationError):
        ModelOptions(flange_law="soft")
    with pytest.raises(ValidationError):
        ModelOptions(flange="none")
    with pytest.raises(ValidationError):
        ModelOptions().flange_law = "quintic"
    assert {ModelOptions(): 1}[ModelOptions()] == 1


def test_bounds_say_what_they_hold():
    assert Bounds().describe("x") == "x any finite number"
    assert Bounds(0.0).describe("x") == "x > 0"
    assert Bounds(0.0, includes_low=True).describe("x") == "x >= 0"
    assert Bounds(0.0, 0.5, includes_low=True).describe("x") == "0 <= x < 0.5"
    assert Bounds(0.0, includes_low=True).contain(0.0)
    assert not Bounds(0.0).contain(0.0)
    assert not Bounds(0.0, 0.5).contain(0.5)


def test_a_quantity_cannot_be_out_of_range_or_unreasoned():
    with pytest.raises(ValueError, match="allowed: mw > 0"):
        Quantity(name="mw", value=-1, unit="kg", source="x", status="user")
    with pytest.raises(ValueError, match="without a reason"):
        Quantity(name="mw", value=1, unit="kg", source="x", status="assumed")
