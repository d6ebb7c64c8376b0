"""The packaged vehicles: complete, sourced, and what the paper prints where it prints."""

from __future__ import annotations

import pytest

from wheelset.published.numbers import FLANGE_COEFFICIENTS, TABLE_1
from wheelset.vehicle import ModelOptions, load_vehicle, vehicle_names
from wheelset.vehicle.documents import document_chain
from wheelset.vehicle.options import allowed_values
from wheelset.vehicle.parameters import BY_NAME, PARAMETERS

NAMES = vehicle_names()
ENTRIES = [
    pytest.param(name, f"{table}.{field}", entry, id=f"{name}-{field}")
    for name in NAMES
    for table, fields in document_chain(name)[-1].tables.items()
    if table != "model"
    for field, entry in fields.items()
]


def test_the_vehicles_of_the_paper_are_there():
    assert {"guo2021", "guo2021_m2", "guo2021_physical"} <= set(NAMES)
    assert {"guo2021_case1", "guo2021_case2"} <= set(NAMES)


@pytest.mark.parametrize(("vehicle", "field", "entry"), ENTRIES)
def test_every_number_has_unit_and_source_and_is_printed_or_has_a_reason(vehicle, field, entry):
    assert entry["unit"], field
    assert entry["source"], field
    assert entry.get("inferred", "a sentence is needed").count(" ") >= 3
    assert entry.get("assumed", "a sentence is needed").count(" ") >= 3


@pytest.mark.parametrize("name", NAMES)
def test_every_parameter_is_stated_and_every_heading_written(name):
    vehicle = load_vehicle(name)
    assert list(vehicle.values) == [parameter.name for parameter in PARAMETERS]
    assert all(q.status in ("printed", "inferred", "assumed") for q in vehicle.quantities)
    assert vehicle.title != name
    assert vehicle.description


@pytest.mark.parametrize("name", NAMES)
def test_packaged_files_are_in_si_so_that_no_unit_has_to_be_converted(name):
    for field, entry in document_chain(name)[-1].tables.items():
        if field != "model":
            assert all(entry[key]["unit"] == BY_NAME[key].unit for key in entry)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("option", ModelOptions.model_fields)
def test_every_choice_of_every_option_can_be_made(name, option):
    for value in allowed_values(option):
        assert getattr(load_vehicle(name, {option: value}).options, option) == value


@pytest.mark.parametrize("printed", [*TABLE_1, *FLANGE_COEFFICIENTS], ids=lambda p: p.symbol)
def test_printed_parameters_are_the_papers(printed):
    quantity = load_vehicle("guo2021").quantity(printed.symbol)
    if quantity.status == "printed":
        assert quantity.value == pytest.approx(printed.si_value, rel=1e-12)
    else:
        assert round(quantity.value, printed.decimals) == printed.si_value


@pytest.mark.parametrize("hidden", [p.name for p in PARAMETERS if p.hidden])
def test_what_the_paper_does_not_print_is_never_called_printed(hidden):
    for name in NAMES:
        assert load_vehicle(name).quantity(hidden).status != "printed"
