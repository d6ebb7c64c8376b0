"""Branches in files: nothing is lost, any reader can read them, and no half file is ever left."""

from __future__ import annotations

import math
import os
import struct
from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.io import netcdf_file

from tests.systems import toy_wheelset
from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending, SpecialPoint
from wheelset.bifurcation.curves.columns import Sheet
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.curves.records import Reader, Writer, pack, unpack
from wheelset.bifurcation.curves.storage import BranchFileError, load, metadata, save
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_start import cycle_from_hopf
from wheelset.bifurcation.equilibria.equilibrium_curve import equilibrium_curve
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumPoint
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve
from wheelset.bifurcation.equilibria.hopf_points import HopfCurvePoint
from wheelset.bifurcation.system import System

AWKWARD = "line\nbreak, \x00 zero, \x00\x00", "ä λ 🚂 \ud800", "", '"quoted" \\ /', " blank "
SPECIAL_NUMBERS = [0.0, -0.0, math.inf, -math.inf, math.nan, 5e-324, 1.7976931348623157e308, 0.1]


def same(one, other):
    """Equal in type and in every bit; the order of a mapping's keys is free."""
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        alike = (one.dtype, one.shape) == (other.dtype, other.shape)
        return alike and one.tobytes() == other.tobytes()
    if isinstance(one, float):
        return struct.pack("d", one) == struct.pack("d", other)
    if isinstance(one, complex):
        return same((one.real, one.imag), (other.real, other.imag))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if is_dataclass(one):
        return all(same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one))
    return one == other


# --- branches by hand ----------------------------------------------------------------------------

rng = np.random.default_rng(5)


def cycle(intervals=3, signs=None):
    computed = rng.standard_normal(4) + 1j * rng.standard_normal(4)
    return Cycle(
        ("y", "psi", "yd", "ψ'"), {"v": 50.0, "a/3": rng.random()}, rng.random(),
        np.linspace(0, 1, intervals + 1), rng.random((intervals, 5, 4)), signs, computed,
    )  # fmt: skip


def equilibrium():
    eigenvalues = np.array([complex(-0.0, math.nan), 1j, -1j])
    return EquilibriumPoint(rng.random(3), rng.random(), eigenvalues, ("x", "x", "z"))


def hopf(flc=None, reason=AWKWARD[0]):
    return HopfCurvePoint(rng.random(2), rng.random(2), -0.0, flc, reason, np.empty(0), ("x", "y"))


SOLUTIONS = {
    "cycles on a mesh that changes": [
        cycle(3), cycle(4, (-1.0, -1.0, 1.0, -0.0)), cycle(4, (1.0,) * 4), cycle(5)
    ],
    "equilibria": [equilibrium(), equilibrium(), equilibrium()],
    "Hopf points": [hopf(), hopf(-1.5, ""), hopf(math.nan, AWKWARD[1])],
    "no solutions": [None, None],
    "solutions of all sorts": [
        None, True, 7, -0.0, 1j, "text", (), (1.0, 2.0), ("a", "b"), ("a", 1, None),
        {"a": 1.0, "b": (None, {})}, np.arange(3), np.array([True, False]), np.array(2.5),
        np.empty((0, 3)), np.array([[1j, -0.0]]), cycle(),
    ],
    "one point": [equilibrium()],
    "no point": [],
}  # fmt: skip


def unknowns(k):
    """Vectors whose number of unknowns changes with the mesh, with every sort of number."""
    return np.resize(SPECIAL_NUMBERS, 9 + 4 * (k % 3))


def made(solutions, parameters=("v", "a/3 ä")):
    points = tuple(
        BranchPoint(
            unknowns(k), -unknowns(k), np.array([50.0 + k, -0.0]), solution,
            {"fold": -math.inf, "torus": 0.1 * k}, 1.5 * k, 0.1,
        )
        for k, solution in enumerate(solutions)
    )  # fmt: skip
    special = tuple(
        SpecialPoint(
            kind, words, found, k + 0.25, unknowns(k), unknowns(k + 1), np.array([1.0, math.nan]),
            solution,
        )
        for k, (kind, words, found, solution) in enumerate(
            zip(("LPC", "", "PD"), AWKWARD, COEFFICIENTS, solutions, strict=False)
        )
    )  # fmt: skip
    return Branch(
        AWKWARD[1], parameters, points, special, special[:1], Ending("start", AWKWARD[0]),
        Ending("", AWKWARD[3]), {"steps": 2**40, "refused": 0},
    )  # fmt: skip


COEFFICIENTS = ({"b": 83.0, "dT/ds": math.nan}, {}, {"c": -0.3, "dT/ds": 1.0, "dT_ds": -1.0})


@pytest.mark.parametrize("name", SOLUTIONS)
def test_what_was_saved_is_loaded_bit_by_bit(name, tmp_path):
    branch = made(SOLUTIONS[name])
    save(branch, tmp_path / "branch.nc")
    assert same(load(tmp_path / "branch.nc"), branch)


def test_the_comparison_of_these_tests_sees_a_single_bit():
    one, other = made([cycle()]), made([cycle()])
    assert same(one, one)
    assert not same(one, other)
    assert not same((0.0,), (-0.0,))
    assert not same({"a": 1, "b": 2}, {"a": 1})
    assert not same(1, True)
    assert not same(np.array([1.0]), np.array([np.nextafter(1.0, 2)]))


def test_not_a_number_keeps_its_bits(tmp_path):
    payload = np.frombuffer(struct.pack("<Q", 0x7FF8_0000_DEAD_BEEF), dtype=np.float64)
    branch = made([payload, float(payload[0])])
    save(branch, tmp_path / "branch.nc")
    assert same(load(tmp_path / "branch.nc"), branch)


def test_the_live_solver_stays_behind(tmp_path):
    save(replace(made([None]), state=object()), tmp_path / "branch.nc")
    assert load(tmp_path / "branch.nc").state is None


def test_arrays_come_back_writable_and_in_native_byte_order(tmp_path):
    swapped = np.arange(3.0).astype(">f8")
    save(made([swapped, swapped[::-1]]), tmp_path / "branch.nc")
    found = [point.solution for point in load(tmp_path / "branch.nc").points]
    found[0][0] = 5.0
    assert [array.dtype.isnative for array in found] == [True, True]
    assert [array.tolist() for array in found] == [[5.0, 1.0, 2.0], [2.0, 1.0, 0.0]]


# --- any values ----------------------------------------------------------------------------------

floats = st.floats(allow_nan=True, allow_subnormal=True)
plain_values = (
    st.none() | st.booleans() | st.integers(-(2**31), 2**31 - 1) | floats | st.text()
    | st.complex_numbers() | st.lists(floats).map(np.array)
)  # fmt: skip
values = st.recursive(
    plain_values,
    lambda inner: (
        st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.text(max_size=2), inner, max_size=3)
    ),
    max_leaves=6,
)


@given(st.lists(values, max_size=4))
@settings(max_examples=150, deadline=None)
def test_any_values_come_back_from_columns(rows):
    sheet = Sheet("row", len(rows))
    layout = pack(Writer(sheet, {}), ("value",), range(len(rows)), rows)
    arrays = {name: column.data for name, column in sheet.columns.items()}
    found = unpack(Reader(arrays, {}), layout, range(len(rows)))
    assert len(found) == len(rows)
    assert all(map(same, found, rows))


@pytest.mark.parametrize("value", [object(), [1.0], {1: 2.0}, 2**40, 10**30, np.array(["a"])])
def test_what_no_column_can_hold_is_named(value, tmp_path):
    with pytest.raises(ValueError, match=r"solution = .*(cannot be stored|fit into 32 bits)"):
        save(made([value]), tmp_path / "branch.nc")
    assert not list(tmp_path.iterdir())


@dataclass(frozen=True)
class Unknown:
    x: float = 1.0


def test_a_solution_of_an_unregistered_class_is_refused_by_name(tmp_path):
    with pytest.raises(ValueError, match=r"solution = Unknown.*Cycle, EquilibriumPoint"):
        save(made([Unknown()]), tmp_path / "branch.nc")


def test_a_class_that_only_has_the_name_of_a_registered_one_is_refused(tmp_path):
    impostor = dataclass(frozen=True)(type("Cycle", (), {}))
    with pytest.raises(ValueError, match="cannot be stored"):
        save(made([impostor()]), tmp_path / "branch.nc")


def test_values_that_are_not_those_of_the_parameters_are_refused(tmp_path):
    with pytest.raises(ValueError, match="one for each of"):
        save(made([None], parameters=("v",)), tmp_path / "branch.nc")


# --- computed branches ---------------------------------------------------------------------------


def pitchfork():
    """x' = x (p - x^2): a branch point at p = 0."""
    return System.from_function(
        lambda x, p: [p[0] * x[0] - x[0] ** 3, -x[1]], ("x", "y"), {"p": -1.0}
    )


def cycles():
    """The toy wheelset's, born unstable and back through their fold."""
    system = toy_wheelset()
    start = cycle_from_hopf(system, hopf_point(system, "v", 50.0))
    return follow(
        start.problem, start.u, direction=start.tangent, windows={"v": (49.0, 50.5)}, kind="cycles"
    )


COMPUTED = {
    "cycles": cycles,
    "equilibria": lambda: equilibrium_curve(pitchfork(), "p", (-1.0, 1.0)),
    "Hopf points": lambda: hopf_curve(
        toy_wheelset(), hopf_point(toy_wheelset(), "v", 50.0), ("v", "a3"), {"a3": (-100.0, 100.0)}
    ),
}


@pytest.fixture(scope="module", params=COMPUTED)
def computed(request):
    return COMPUTED[request.param]()


def test_computed_branches_come_back_whole(computed, tmp_path):
    save(computed, tmp_path / "branch.nc")
    found = load(tmp_path / "branch.nc")
    assert computed.special
    assert same(found, replace(computed, state=None))
    assert found.table(()).equals(computed.table(()))


def test_the_table_has_the_special_points_in_their_places(computed):
    table = computed.table(())
    special = np.flatnonzero(table["point"] != "")
    assert table["point"].iloc[special].tolist() == [point.kind for point in computed.special]
    first = [int(point.index) + k for k, point in enumerate(computed.special)]
    assert special.tolist() == [row + 1 for row in first]


# --- what other readers find ---------------------------------------------------------------------


def opened(path):
    with netcdf_file(path, mmap=False) as file:
        variables = {name: (v[:].copy(), v) for name, v in file.variables.items()}
        return file, variables


def test_any_reader_finds_names_numbers_and_units(tmp_path):
    branch = made(SOLUTIONS["cycles on a mesh that changes"])
    save(branch, tmp_path / "branch.nc", units={"v": "m s-1"})
    file, variables = opened(tmp_path / "branch.nc")
    points, special = branch.points, branch.special
    expected = {
        "arclength": [point.arclength for point in points],
        "step": [point.step for point in points],
        "parameter_v": [point.values[0] for point in points],
        "test_fold": [point.tests["fold"] for point in points],
        "solution_period": [point.solution.period for point in points],
        "solution_parameters_a_3": [point.solution.parameters["a/3"] for point in points],
        "special_index": [point.index for point in special],
        "special_parameter_v": [point.values[0] for point in special],
        "special_coefficient_b": [83.0, math.nan, math.nan],
    }
    for name, numbers in expected.items():
        data, variable = variables[name]
        np.testing.assert_array_equal(data, numbers)
        assert variable.dimensions == ("special" if name.startswith("special") else "point",)
    units = {name: v.units for name, (_, v) in variables.items() if hasattr(v, "units")}
    assert units["solution_period"] == b"s"
    assert units["parameter_v"] == units["solution_parameters_v"] == b"m s-1"
    assert variables["special_coefficient_dT_ds"][1].long_name == b"dT/ds"
    assert file.ended.decode() == AWKWARD[3]


def test_complex_numbers_are_pairs_and_ragged_arrays_have_their_shapes_beside_them(tmp_path):
    cycles = SOLUTIONS["cycles on a mesh that changes"]
    save(made(cycles), tmp_path / "branch.nc")
    _, variables = opened(tmp_path / "branch.nc")
    pairs, variable = variables["solution_computed"]
    assert variable.dimensions[-1] == "complex"
    np.testing.assert_array_equal(pairs[1, :, 1], cycles[1].computed.imag)
    shapes, _ = variables["solution_nodes_shape"]
    start = int(np.prod(shapes[:2], axis=1).sum())
    third = variables["solution_nodes"][0][start : start + int(np.prod(shapes[2]))]
    np.testing.assert_array_equal(third.reshape(shapes[2]), cycles[2].nodes)


def test_metadata_are_global_attributes_under_any_name(tmp_path):
    given_ = {
        "vehicle": "case 1", "package version": AWKWARD[1], "mode": "r", "kind": "?",
        "": AWKWARD[0], "package_version": "2", "variables": "none", "layout": "mine",
        "format": "x",
    }  # fmt: skip
    save(made([None]), tmp_path / "branch.nc", given_)
    assert metadata(tmp_path / "branch.nc") == given_
    assert load(tmp_path / "branch.nc").kind == AWKWARD[1]
    assert opened(tmp_path / "branch.nc")[0].vehicle == b"case 1"
    with pytest.raises(ValueError, match=r"metadata seed = 7: has to be a text"):
        save(made([None]), tmp_path / "other.nc", {"seed": 7})


# --- files that hold no branch -------------------------------------------------------------------


@pytest.fixture
def stored(tmp_path):
    path = tmp_path / "branch.nc"
    save(made([cycle(), equilibrium()]), path, {"vehicle": "case 1"})
    return path


def changed(path, attribute, value):
    """The file with another global attribute."""
    with netcdf_file(path, mmap=False) as old:
        data = {name: (v.dimensions, v[:].copy()) for name, v in old.variables.items()}
        names = ("format", "format_version", "layout", "kind", "began_kind", "began")
        kept = {n: getattr(old, n) for n in (*names, "ended_kind", "ended", "statistics")}
        sizes = dict(old.dimensions)
    with netcdf_file(path, "w", version=2) as new:
        for name, size in sizes.items():
            new.createDimension(name, size)
        for name, (dimensions, array) in data.items():
            new.createVariable(name, array.dtype, dimensions)[:] = array
        for name, text in {**kept, attribute: value(kept[attribute])}.items():
            setattr(new, name, text)


MALFORMED = {
    "an empty file": (lambda path: path.write_bytes(b""), "whole file of classic netCDF"),
    "a text": (lambda path: path.write_text("v,period\n1,2\n"), "whole file of classic netCDF"),
    "HDF5": (lambda path: path.write_bytes(b"\x89HDF\r\n\x1a\n" * 9), "whole file of classic"),
    "a netCDF of others": (
        lambda path: netcdf_file(path, "w").close(), r"found format = None, expected 'wheelset"
    ),
    "another format": (
        lambda path: changed(path, "format", lambda _: b"mesh"), r"found format = b'mesh'"
    ),
    "a later version": (
        lambda path: changed(path, "format_version", lambda _: np.int32(2)),
        "found version 2, expected version 1",
    ),
    "no JSON": (lambda path: changed(path, "layout", lambda text: text[:-9]), "a layout in JSON"),
    "an unknown class": (
        lambda path: changed(path, "layout", lambda t: t.replace(b'"Cycle"', b'"Tours"')),
        r"found .*class 'Tours', expected one of Cycle, EquilibriumPoint, HopfCurvePoint",
    ),
    "other fields": (
        lambda path: changed(path, "layout", lambda t: t.replace(b'"mesh"', b'"grid"')),
        r"found .*Cycle with fields .*'grid'.*expected .*'mesh'",
    ),
    "a variable less": (
        lambda path: changed(path, "layout", lambda t: t.replace(b'"tangent"', b'"gone"')),
        "found",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MALFORMED)
def test_a_file_that_holds_no_branch_is_named_with_what_was_found(name, stored):
    change, words = MALFORMED[name]
    change(stored)
    with pytest.raises(BranchFileError, match=rf"branch\.nc: .*{words}"):
        load(stored)


def test_a_rewritten_file_is_still_good(stored):
    """The changes above are the only ones they make."""
    before = load(stored)
    changed(stored, "kind", lambda text: text)
    assert same(load(stored), before)


def test_a_file_that_is_not_there_is_not_called_damaged(tmp_path):
    with pytest.raises(FileNotFoundError):
        load(tmp_path / "branch.nc")


def test_a_file_cut_short_anywhere_is_noticed(stored):
    whole = stored.read_bytes()
    for length in {*range(0, len(whole), 97), *range(len(whole) - 8, len(whole))}:
        stored.write_bytes(whole[:length])
        with pytest.raises(BranchFileError, match=r"branch\.nc: expected"):
            load(stored)


def test_damage_anywhere_raises_nothing_else(stored):
    """Altered numbers cannot be noticed; whatever cannot be read is said in one way."""
    whole, noticed, draw = stored.read_bytes(), 0, np.random.default_rng(1)
    for _ in range(400):
        damaged = bytearray(whole)
        damaged[draw.integers(len(whole))] = draw.integers(256)
        stored.write_bytes(damaged)
        try:
            load(stored)
        except BranchFileError:
            noticed += 1
    assert noticed > 50


# --- writing at once or not at all ---------------------------------------------------------------


def test_the_same_branch_gives_the_same_file(stored, tmp_path):
    branch = load(stored)
    save(branch, tmp_path / "again.nc", metadata(stored))
    assert (tmp_path / "again.nc").read_bytes() == stored.read_bytes()


@pytest.mark.parametrize("step", ["createVariable", "flush", "fsync"])
def test_a_write_that_fails_leaves_the_old_file(step, stored, monkeypatch):
    def full(*args):
        raise OSError(28, "No space left on device")

    before = stored.read_bytes()
    monkeypatch.setattr(os if step == "fsync" else netcdf_file, step, full)
    with pytest.raises(OSError, match="No space left"):
        save(made([None] * 3), stored)
    monkeypatch.undo()
    assert stored.read_bytes() == before
    assert list(stored.parent.iterdir()) == [stored]


def test_a_file_that_is_there_is_replaced_whole(stored):
    with stored.open("rb") as reader:  # who reads the old one goes on reading the old one
        start, before = reader.read(64), stored.read_bytes()
        save(made([None]), stored)
        assert start + reader.read() == before
    assert len(load(stored)) == 1
    assert list(stored.parent.iterdir()) == [stored]


def test_a_new_file_can_be_read_by_whom_any_new_file_can(stored, tmp_path):
    (tmp_path / "plain").touch()
    assert stored.stat().st_mode == (tmp_path / "plain").stat().st_mode
