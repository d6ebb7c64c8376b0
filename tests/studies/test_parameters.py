"""Every study's parameters: strict, described, with units, and equal to its notebook's cell."""

from __future__ import annotations

import ast
import importlib
import json
import re
from pathlib import Path

import pytest
from pydantic import ValidationError

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
STUDIES = {
    path.stem: study
    for path in NOTEBOOKS
    if (study := json.loads(path.read_text("utf-8"))["metadata"]["wheelset"].get("study"))
}

#: A unit as descriptions have it: "…, m/s; 0 < …", "…, m.", "…, dimensionless.".
UNIT = re.compile(r"[ ,](m/s|m|s|rad|N|N/m|km|%|dimensionless)[;.,]")


def parameters_of(study):
    return importlib.import_module(f"wheelset.studies.{study}").Parameters


def annotated_cell(stem):
    (path,) = (path for path in NOTEBOOKS if path.stem == stem)
    cells = json.loads(path.read_text("utf-8"))["cells"]
    (cell,) = (c for c in cells if "parameters" in c["metadata"].get("tags", []))
    return ast.parse("".join(cell["source"])).body


@pytest.mark.parametrize(("stem", "study"), STUDIES.items())
def test_cell_and_model_have_the_same_names_and_defaults(stem, study):
    cell = {line.target.id: ast.literal_eval(line.value) for line in annotated_cell(stem)}
    assert cell == parameters_of(study)().model_dump()


@pytest.mark.parametrize("study", STUDIES.values())
def test_unknown_names_are_refused(study):
    with pytest.raises(ValidationError, match="Extra inputs"):
        parameters_of(study)(velocity=40.0)


@pytest.mark.parametrize("study", STUDIES.values())
def test_every_field_is_described_and_every_number_has_a_unit(study):
    for name, field in parameters_of(study).model_fields.items():
        assert field.description, name
        if field.annotation is float:
            assert UNIT.search(field.description), name


def test_window_has_to_be_ordered():
    with pytest.raises(ValidationError, match="v_min = 60 m/s must be below v_max = 50 m/s"):
        parameters_of("hopf_point")(v_min=60, v_max=50)


@pytest.mark.parametrize("speed", [0.0, -3.0, float("nan"), float("inf"), 2000.0])
def test_impossible_speeds_are_refused(speed):
    with pytest.raises(ValidationError, match="speed"):
        parameters_of("flange_models")(speed=speed)


@pytest.mark.parametrize("study", STUDIES.values())
def test_a_vehicle_that_cannot_be_loaded_is_refused_before_anything_runs(study):
    model = parameters_of(study)
    field = next(name for name in model.model_fields if name.startswith("vehicle"))
    with pytest.raises(ValidationError, match='unknown vehicle "guo2020"'):
        model(**{field: "guo2020"})


def test_a_readers_change_wins_over_the_studys_choice_and_loses_to_a_tables_row():
    p = parameters_of("hopf_point")(changes="a1=0.3, flange_law=quintic")
    loaded = p.load("guo2021", given=["flange_law=exponential", "a3=200"], rows=["a1=0.05"])
    assert loaded.options.flange_law == "quintic"
    assert (loaded.values["a1"], loaded.values["a3"]) == (0.05, 200.0)


@pytest.mark.parametrize("study", STUDIES.values())
@pytest.mark.parametrize(
    ("changes", "words"),
    [("a9=1", 'unknown parameter or option "a9"'), ("a1", "not of the form"), ("mw=-1", "mw > 0")],
)
def test_changes_are_refused_before_anything_runs(study, changes, words):
    with pytest.raises(ValidationError, match=words):
        parameters_of(study)(changes=changes)
