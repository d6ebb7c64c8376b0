"""Overrides: ``name=value[ unit]`` on top of a vehicle."""

from __future__ import annotations

from contextlib import suppress
from math import isfinite

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wheelset.vehicle import VehicleError, load_vehicle
from wheelset.vehicle.parameters import PARAMETERS
from wheelset.vehicle.units import split_quantity, to_si

GUO = load_vehicle("guo2021")


def problems(overrides) -> tuple[str, ...]:
    with pytest.raises(VehicleError) as caught:
        GUO.with_overrides(overrides)
    return caught.value.problems


def test_values_units_and_options():
    new = load_vehicle("guo2021", ["a1=0.3", " Kpx = 1.2 MN/m ", "flange_law=exponential"])
    assert (new.values["a1"], new.options.flange_law) == (0.3, "exponential")
    assert new.values["Kpx"] == pytest.approx(1.2e6, rel=1e-15)
    assert (new.quantity("a1").status, new.quantity("a1").source) == ("user", "override")
    assert GUO.values["a1"] == 0.226537


def test_texts_and_mappings_say_the_same():
    texts = GUO.with_overrides(["a1=0.3", "flange_wheels=2", "c0=0.1 rad"])
    assert texts == GUO.with_overrides({"a1": 0.3, "flange_wheels": 2, "c0": "0.1 rad"})
    assert GUO.with_overrides("a1=0.3") == GUO.with_overrides({"a1": 0.3})


def test_nothing_overridden_is_the_same_vehicle():
    assert GUO.with_overrides(()) == GUO


def test_problems_are_collected():
    told = problems(["mw=-5", "nu=0.7", "flange_law=expo", "Kpx=3 kg"])
    assert len(told) == 4
    assert any("wheelset.mw = -5 kg" in one for one in told)


def test_names_are_checked():
    assert 'did you mean "Kpx"' in problems(["kpx=3"])[0]
    assert 'did you mean "flange_law"' in problems(["flangelaw=none"])[0]
    assert "given twice" in problems(["a1=1", "a1=2"])[0]
    assert "name=value" in problems(["a1"])[0]
    assert "name=value" in problems(["=1"])[0]
    assert "is not a number" in problems(["a1="])[0]


def test_the_speed_is_no_part_of_a_vehicle():
    assert "unknown" in problems(["v=50"])[0]


def test_an_unknown_quantity_is_a_vehicle_error():
    with pytest.raises(VehicleError, match='did you mean "Kpx"'):
        GUO.quantity("Kpxx")


@settings(max_examples=100, deadline=None)
@given(parameter=st.sampled_from(PARAMETERS), value=st.floats(1e-3, 0.4))
def test_round_trip(parameter, value):
    new = GUO.with_overrides([f"{parameter.name}={value!r} {parameter.unit}"])
    assert new.values == {**GUO.values, parameter.name: value}


@settings(max_examples=200, deadline=None)
@given(text=st.text(max_size=20))
def test_any_text_is_a_vehicle_error_or_a_finite_value(text):
    with suppress(VehicleError):
        assert isfinite(GUO.with_overrides([f"a3={text}"]).values["a3"])


UNITS = [
    ("mw", "1.55 t", 1550.0),
    ("r0", "460 mm", 0.46),
    ("Kpx", "1 kN/mm", 1e6),
    ("Cpx", "2 kN s/m", 2e3),
    ("Cpx", "2 kN*s/m", 2e3),
    ("Iwz", "990 kg m^2", 990.0),
    ("Iwz", "990 kg·m²", 990.0),
    ("E", "210 GPa", 2.1e11),
    ("a1", "23 %", 0.23),
    ("c1", "14 rad/m", 14.0),
    ("a3", "2e-6 1/mm2", 2.0),
    ("a3", "2 m-2", 2.0),
    ("q1", "-1.645 1/mm", -1645.0),
    ("d1", "160 kN/mm**3", 1.6e14),
]


@pytest.mark.parametrize(("name", "text", "si"), UNITS)
def test_units_are_converted(name, text, si):
    assert GUO.with_overrides({name: text}).values[name] == pytest.approx(si, rel=1e-12)


WRONG = ["kg", "m/m/m/kg", "9**9**9", "N(m)", "degC", "dB", "1e3", "N//m", "__import__", "/", "m m"]


@pytest.mark.parametrize("unit", WRONG)
def test_a_wrong_unit_names_field_unit_and_what_is_expected(unit):
    (told,) = problems({"Kpx": f"1 {unit}"})
    assert told.startswith(f'suspension.Kpx: unit "{unit}"')
    assert 'expected "N/m"' in told


@settings(max_examples=100, deadline=None)
@given(value=st.floats(allow_nan=False, allow_infinity=False))
def test_every_float_is_read_back(value):
    assert split_quantity(f"{value!r} kg m2") == (value, "kg m2")


def test_the_si_unit_itself_changes_no_bit():
    for parameter in PARAMETERS:
        assert to_si(0.1, parameter.unit, parameter) == 0.1
