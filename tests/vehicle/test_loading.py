"""Vehicle files: what is accepted, what they extend, and how all their errors read."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from wheelset.vehicle import Vehicle, VehicleError, load_vehicle, vehicle_names
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.parameters import BY_NAME, PARAMETERS

FOLDER = settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@pytest.fixture
def write(tmp_path):
    """Writes a vehicle file and gives its path."""

    def file(text: str, name: str = "mine.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return file


def problems(name, overrides=()) -> str:
    with pytest.raises(VehicleError) as caught:
        load_vehicle(name, overrides)
    return str(caught.value)


def test_a_file_extends_a_packaged_vehicle_with_bare_numbers_and_units(write):
    path = write(
        'title = "Mine"\nextends = "guo2021"\n'
        '[suspension]\nKpx = "1.2 MN/m"\nKpy = 9e5\n'
        'Cpx = {value = 3, unit = "kN s/m", source = "data sheet"}\n'
        '[geometry]\nc0 = "3 deg"\n[model]\nflange_law = "exponential"\n'
    )
    mine = load_vehicle(path)
    assert (mine.name, mine.title, mine.description) == ("mine", "Mine", "")
    assert mine.values["Kpx"] == pytest.approx(1.2e6, rel=1e-15)
    assert mine.values["Kpy"] == 9e5
    assert mine.values["c0"] == pytest.approx(0.0523598775598, rel=1e-10)
    assert mine.options.flange_law == "exponential"
    assert mine.options.contact_angle_sign == "reversed"
    assert mine.quantity("Kpx").status == "user"
    assert mine.quantity("Kpx").source == "mine.toml"
    assert (mine.quantity("Cpx").value, mine.quantity("Cpx").source) == (3000.0, "data sheet")
    assert mine.quantity("mw") == load_vehicle("guo2021").quantity("mw")


def test_a_file_extends_another_beside_it(write):
    write('title = "Base"\nextends = "guo2021"\n[wheelset]\nmw = "2 t"\n', "base.toml")
    top = load_vehicle(str(write('extends = "base.toml"\n[wheelset]\nIwz = 1000\n')))
    assert (top.values["mw"], top.values["Iwz"], top.title) == (2000.0, 1000.0, "Base")


def test_a_complete_file_needs_no_base_and_may_leave_out_what_has_a_default(write):
    needed = [p for p in PARAMETERS if p.default is None and p.needed_by is None]
    values = load_vehicle("guo2021").values
    lines = [f"{p.table}.{p.name} = {values[p.name]}" for p in needed]
    mine = load_vehicle(write("\n".join(lines)))
    assert mine.options == ModelOptions()
    assert (mine.values["Cpx"], mine.values["f23_factor"]) == (0.0, 1.0)
    assert mine.quantity("Cpx").status == "default"
    assert "p1" not in mine.values
    assert "mu" not in mine.values


def test_values_are_a_copy_and_the_vehicle_is_immutable_hashable_and_picklable():
    vehicle = load_vehicle("guo2021")
    vehicle.values["mw"] = 1.0
    assert vehicle.values["mw"] == 1550.0
    with pytest.raises(ValidationError):
        vehicle.name = "other"
    assert hash(vehicle) == hash(load_vehicle("guo2021"))
    assert pickle.loads(pickle.dumps(vehicle)) == vehicle  # noqa: S301


def test_the_table_lists_every_quantity_with_its_meaning():
    vehicle = load_vehicle("guo2021")
    rows = vehicle.table()
    assert [row.name for row in rows] == list(vehicle.values)
    row = next(row for row in rows if row.name == "a1")
    assert (row.value, row.unit, row.status) == (0.226537, "1", "inferred")
    assert "rounds" in row.reason
    assert "conicity" in row.meaning


BAD_FILES = {
    "unknown table": ("[wheel]\nmw = 1\n", ['"wheel"', 'did you mean "wheelset"']),
    "unknown field": ("[suspension]\nKpz = 1\n", ["suspension.Kpz", "did you mean", "Kpx, Kpy"]),
    "field of another table": ("[wheelset]\nKpx = 1\n", ["belongs to [suspension]"]),
    "field outside tables": ("mw = 1550\n", ["write it under [wheelset]"]),
    "unknown key": ("[wheelset]\nmw = {vale = 1}\n", ["wheelset.mw", 'did you mean "value"']),
    "wrong dimension": (
        '[suspension]\nKpx = "3 kg"\n',
        ["suspension.Kpx", '"kg"', '"N/m"', "MN/m"],
    ),
    "unknown unit": ('[wheelset]\nmw = "3 parsnip"\n', ["wheelset.mw", "parsnip", '"kg"']),
    "no number": ('[wheelset]\nmw = "heavy"\n', ["wheelset.mw", '"heavy" is not a number']),
    "boolean": ("[wheelset]\nmw = true\n", ["wheelset.mw", "True is not a number"]),
    "list": ("[wheelset]\nmw = [1]\n", ["wheelset.mw", "not a number"]),
    "negative mass": ("[wheelset]\nmw = -5\n", ["wheelset.mw = -5 kg", "allowed: mw > 0"]),
    "infinite": ("[geometry]\na3 = inf\n", ["geometry.a3", "not a finite number"]),
    "too large": (f"[geometry]\na3 = {10**400}\n", ["geometry.a3", "too large"]),
    "Poisson": ("[contact]\nnu = 0.5\n", ["contact.nu = 0.5", "0 <= nu < 0.5"]),
    "two units": ('[wheelset]\nmw = {value = "1 t", unit = "kg"}\n', ["wheelset.mw: two units"]),
    "no value": ('[wheelset]\nmw = {unit = "kg"}\n', ["wheelset.mw: the value is missing"]),
    "unit no text": ("[wheelset]\nmw = {value = 1, unit = 3}\n", ["wheelset.mw: unit must be"]),
    "no reason": ('[wheelset]\nmw = {value = 1, inferred = " "}\n', ["without a reason"]),
    "both": ('[wheelset]\nmw = {value = 1, inferred = "a", assumed = "b"}\n', ["exclude"]),
    "curvature": ("[geometry]\ne0 = -1\n", ["e0 + f0 > |dh0|"]),
    "asymmetric curvature": ("[asymmetry]\ndh0 = -20\n", ["e0 + f0 > |dh0|", "-20"]),
    "asymmetric radius": ("[asymmetry]\nda0 = 0.5\n", ["|da0| < r0"]),
    "option": (
        '[model]\nflange_law = "quntic"\n',
        ["flange_law", 'did you mean "quintic"', "none"],
    ),
    "option type": ("[model]\nflange_wheels = 3\n", ["flange_wheels = 3", "allowed: 1, 2"]),
    "unknown option": ('[model]\nflange = "none"\n', ["model.flange", "did you mean"]),
    "heading": ("title = 3\n", ["title must be a text"]),
    "table as number": ("wheelset = 3\n", ["[wheelset] must be a table"]),
}


@pytest.mark.parametrize("kind", BAD_FILES)
def test_an_error_names_the_field_the_value_and_what_is_allowed(write, kind):
    text, words = BAD_FILES[kind]
    said = problems(write(f'extends = "guo2021"\n{text}'))
    assert said.startswith("mine: ")
    for word in words:
        assert word in said


def test_all_problems_of_a_file_are_told_at_once(write):
    with pytest.raises(VehicleError) as caught:
        load_vehicle(write("[wheelset]\nmw = -1\nmass = 3\n[contact]\nnu = 2\n"))
    told = caught.value.problems
    assert len(told) == 5
    assert [problem for problem in told if problem.startswith("missing: ")] == list(told[3:])
    assert "wheelset.mw" not in told[3]


def test_a_missing_hidden_value_says_what_the_paper_leaves_out_and_the_remedy(write):
    said = problems(write("[wheelset]\nmw = 1\n"))
    for word in ("contact.p0", "geometry.c0", "The paper prints none", 'extends = "guo2021"'):
        assert word in said


def test_a_missing_flange_coefficient_names_the_law(write):
    keep = [p for p in PARAMETERS if p.table != "flange"]
    values = load_vehicle("guo2021").values
    text = "\n".join(f"{p.table}.{p.name} = {values[p.name]}" for p in keep)
    said = problems(write(text + '\nmodel.flange_law = "exponential"\n'))
    assert "flange.p1" in said
    assert 'model.flange_law = "exponential" needs' in said
    assert "flange.k0" not in said


def test_errors_of_finding_and_reading(write, tmp_path):
    assert 'did you mean "guo2021"' in problems("gou2021")
    assert all(name in problems("nothing") for name in vehicle_names())
    assert "does not exist" in problems(tmp_path / "none.toml")
    assert "line 2" in problems(write('title = "a"\nx = = 3\n'))
    assert "mine.toml" in problems(write("= 3"))
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00")
    assert "cannot be read" in problems(tmp_path / "bytes.toml")
    assert "unknown vehicle" in problems(write('extends = "nobody"\n'))
    assert "extends must be a text" in problems(write("extends = 3\n"))


def test_extending_in_a_circle_is_an_error(write):
    write('extends = "mine.toml"\n', "other.toml")
    said = problems(write('extends = "other.toml"\n'))
    assert "circle: mine.toml -> other.toml -> mine.toml" in said


@FOLDER
@given(text=st.text(max_size=60))
def test_any_text_is_a_vehicle_error_or_nothing(write, text):
    with pytest.raises(VehicleError):
        load_vehicle(write(text))


def attempt(name, overrides=()) -> Vehicle | VehicleError:
    try:
        return load_vehicle(name, overrides)
    except VehicleError as error:
        return error


@FOLDER
@given(name=st.text(max_size=300))
def test_any_name_is_a_vehicle_or_a_vehicle_error(name):
    assert isinstance(attempt(name), Vehicle | VehicleError)


@FOLDER
@given(parameter=st.sampled_from(PARAMETERS), value=st.floats())
def test_a_value_is_kept_exactly_or_refused_with_its_range(write, parameter, value):
    text = f'extends = "guo2021"\n[{parameter.table}]\n{parameter.name} = {value!r}\n'
    outcome = attempt(write(text))
    if isinstance(outcome, VehicleError):
        assert parameter.name in str(outcome)
        assert "allowed" in str(outcome)
    else:
        assert outcome.values[parameter.name] == value
        assert BY_NAME[parameter.name].bounds.contain(value)


@FOLDER
@given(junk=st.one_of(st.booleans(), st.none(), st.text(max_size=8), st.lists(st.floats())))
def test_no_entry_but_a_number_or_a_text_gets_through(junk):
    outcome = attempt("guo2021", {"a3": junk})
    assert isinstance(junk, str) or "geometry.a3" in str(outcome)
    assert isinstance(outcome, Vehicle | VehicleError)


def test_loading_a_packaged_vehicle_imports_nothing_heavy():
    code = (
        "import sys; from wheelset.vehicle import load_vehicle; load_vehicle('guo2021');"
        "heavy = {'pint', 'sympy', 'numba', 'pandas', 'scipy', 'matplotlib'} & set(sys.modules);"
        "sys.exit(str(heavy) if heavy else 0)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
