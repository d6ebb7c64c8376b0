"""AUTO-07p as a peer: its Fortran is the same model, and it meets the closed forms and oracles."""

from __future__ import annotations

import ctypes
import dataclasses
import math
import os
import shutil
import subprocess

import numpy as np
import pytest
import sympy as sp

from benchmarks.auto07p import (
    Peer,
    Problem,
    Settings,
    StartFailed,
    available,
    lpc_curve,
    paper,
    toy,
)
from benchmarks.auto07p.files import iterations, point_type, read_table
from benchmarks.auto07p.fortran import problem
from benchmarks.auto07p.program import AutoFailed
from benchmarks.auto07p.script import write_script
from tests.systems import TOY, TOY_HOPF, TOY_LPC, closed_form_critical_speed, hopf_normal_form
from wheelset.bifurcation.fields.field import VectorField
from wheelset.bifurcation.system import System

#: AUTO prints eleven digits, so a speed near 50 m/s is known to 5e-10.
PRINT = 6e-10
FINE = {"jacobian": True, "tolerance": 1e-10, "locate": 1e-7}
INTERVALS = {False: 40, True: 20}  # of the full and of the half period
FORMS = pytest.mark.parametrize("half", [False, True], ids=["full", "half"])


def required(found: bool, what: str) -> None:
    """Skip for want of a program, or fail where it was promised."""
    if found:
        return
    if os.environ.get("WHEELSET_REQUIRE_AUTO") == "1":
        pytest.fail(f"WHEELSET_REQUIRE_AUTO=1, but {what} is not installed")
    pytest.skip(f"{what} is not installed: apt-get install auto-07p gfortran")


@pytest.fixture(scope="module")
def peers(tmp_path_factory):
    """Peers by name, each compiled once."""
    required(available(), "AUTO-07p")
    made = {}
    for name, case in {"toy": toy(), "paper": paper()}.items():
        folder = tmp_path_factory.mktemp(name)
        settings = Settings(scales=case.scales, **FINE)
        made[name] = case, Peer(Problem(case.system, folder, case.free), settings)
    return made


def branch(peers, name, half, **settings):
    case, peer = peers[name]
    peer = peer.using(ntst=INTERVALS[half], **settings)
    return case, peer, peer.cycles(peer.hopf(case.start), {"v": case.window}, half=half)


def first_fold(run):
    return run.table[run.table["type"] == "LP"].iloc[0]


class TestFortran:
    """The printed FUNC, called directly, against the package's own compiled kernel."""

    @pytest.fixture(scope="class")
    @staticmethod
    def library(tmp_path_factory):
        required(shutil.which("gfortran") is not None, "gfortran")

        def compiled(system, free, half):
            source = tmp_path_factory.mktemp("func") / "func.f90"
            source.write_text(problem(system, free, half), "ascii")
            library = source.with_suffix(".so")
            command = ["gfortran", "-O1", "-shared", "-fPIC", str(source), "-o", str(library)]
            subprocess.run(command, check=True, cwd=source.parent)
            return ctypes.CDLL(str(library)).func_

        return compiled

    @pytest.mark.parametrize("case", [toy(), paper("a1")], ids=lambda case: case.name)
    @FORMS
    def test_field_and_exact_jacobians(self, library, case, half):
        func = library(case.system, case.free, half)
        states = np.random.default_rng(1).uniform(-1, 1, (20, 4)) * [9e-3, 7e-3, 0.3, 0.3]
        period = 0.15
        scale = period / 2 if half else 1.0
        names = (*case.system.state_names, *case.free)
        for x in states:
            f, by_state, by_parameter = called(func, x, case, period)
            expected, slopes = case.system.evaluate(x, by=names)
            close = {"rtol": 1e-12, "atol": 1e-12 * scale * np.abs(slopes).max()}
            np.testing.assert_allclose(f, scale * expected, **close)
            np.testing.assert_allclose(by_state, scale * slopes[:, :4], **close)
            np.testing.assert_allclose(by_parameter[:, :2], scale * slopes[:, 4:], **close)
            if half:
                np.testing.assert_allclose(by_parameter[:, 10], expected / 2, **close)

    def test_names_that_fortran_takes_for_one(self, library):
        system = System.from_function(
            lambda x, p: [p[0] * x[1], p[1] * sp.sqrt(1 + x[0] ** 2)], ("u", "U"), {"a": 2, "A": 3}
        )
        case = dataclasses.replace(toy(), system=system, free=("A",))
        f, by_state, _ = called(library(system, ("A",), False), np.array([0.75, 5.0]), case, 1.0)
        np.testing.assert_allclose(f, [10.0, 3.75], rtol=1e-15)
        np.testing.assert_allclose(by_state, [[0, 2], [1.8, 0]], rtol=1e-15)

    def test_the_root_of_a_derivative_is_that_of_its_function(self):
        system = System.from_function(lambda x, p: [p[0] * x[0] ** 0.63], ("x",), {"a": 1.0})
        assert problem(system, ("a",)).count("**0.63d0") == 3  # f, df/dx, df/da
        assert "0.37" not in problem(system, ("a",))

    def test_a_sampled_function_is_refused(self):
        y = sp.Symbol("y", real=True)
        field = VectorField((y,), (), (sp.Function("table")(y),))

        class Line:
            def taylor(self, y, order):
                return np.ones((*y.shape, order + 1))

        with pytest.raises(ValueError, match="closed formula"):
            problem(System(field, {}, {"table": Line()}), ("y",))

    def test_more_free_parameters_than_slots_are_refused(self):
        with pytest.raises(ValueError, match="1 to 9"):
            problem(paper().system, paper().system.parameter_names[:10])

    def test_an_unknown_parameter_is_refused(self):
        with pytest.raises(ValueError, match="unknown parameter 'speed'"):
            problem(toy().system, ("speed",))


def called(func, x, case, period):
    """f (n,), df/dx (n, n) and df/dp (n, 36) of a compiled FUNC."""
    n = len(x)
    par = np.zeros(36)
    par[: len(case.free)] = [case.system.values[name] for name in case.free]
    par[10] = period
    f, by_state = np.empty(n), np.full((n, n), np.nan, order="F")
    by_parameter = np.full((n, 36), np.nan, order="F")
    sizes = ctypes.c_int(n), ctypes.c_int(2)
    arrays = (a.ctypes.data_as(ctypes.c_void_p) for a in (f, by_state, by_parameter))
    u, p = (a.ctypes.data_as(ctypes.c_void_p) for a in (np.array(x), par))
    func(ctypes.byref(sizes[0]), u, None, p, ctypes.byref(sizes[1]), *arrays)
    return f, by_state, by_parameter


class TestFiles:
    TABLE = """\
   0  -1.7976+308  1.7976+308 -1.7976+308  1.7976+308
   0
   0    PT  TY  LAB     PAR(1)            L2-NORM           MAX U(1)
   1     1   9    1  5.0000000000E+001  1.0000000000-100  2.5000000000E-003
   1    -2  59    0 -4.9000000000E+001  1.0000000000E+00  2.5000000000E-003
"""

    def test_a_table(self, tmp_path):
        (tmp_path / "fort.7").write_text(self.TABLE)
        table = read_table(tmp_path / "fort.7")
        assert list(table.columns) == ["type", "label", "PAR(1)", "L2-NORM", "MAX U(1)"]
        assert table["type"].tolist() == ["EP", "EP"]
        assert table["PAR(1)"].tolist() == [50.0, -49.0]
        assert table["L2-NORM"].tolist() == [1e-100, 1.0]

    @pytest.mark.parametrize(
        ("code", "kind"),
        [(0, ""), (3, "HB"), (5, "LP"), (-4, "UZ"), (-9, "MX"), (-59, "MX"), (-32, "GH")],
    )
    def test_codes_of_points(self, code, kind):
        assert point_type(code) == kind

    def test_iterations_of_a_log(self, tmp_path):
        log = "\n   2     2   0   5.02E+01\n   2     2   1   5.02E+01\n  -2     2  12   5.02E+01\n"
        (tmp_path / "fort.9").write_text(log + "  -2     3        0   5.02E+01\n")
        assert iterations(tmp_path / "fort.9") == 2


class TestToyWheelset:
    def test_hopf_point_is_the_closed_form(self, peers):
        case, peer = peers["toy"]
        hopf = peer.using(locate=1e-11).hopf(case.start).table.iloc[-1]
        v, w = closed_form_critical_speed(TOY, flange_stiffness=2 * TOY["p1"] * TOY["q"])
        assert hopf["type"] == "HB"
        assert hopf["v"] == pytest.approx(v, abs=PRINT)
        assert hopf["T"] == pytest.approx(2 * math.pi / w, abs=6e-12)

    def test_hopf_curve_is_straight_with_a_generalised_point(self, peers):
        case, peer = peers["toy"]
        hopf = peer.using(locate=1e-11).hopf(case.start)
        curve = peer.using(largest=2.0).hopf_curve(hopf, {"a3": (-50.0, 200.0)})
        assert curve.table["v"].to_numpy() == pytest.approx(TOY_HOPF["v"], abs=PRINT)
        assert np.sort(curve.table["a3"].iloc[[0, -1]]) == pytest.approx([-50, 200], abs=1e-4)
        generalised = curve.table.query("type == 'GH'")
        # AUTO differentiates the field numerically three times
        assert generalised["a3"].to_numpy() == pytest.approx([0.0234438188506], abs=1e-5)

    @FORMS
    def test_fold_of_cycles_at_a3_100(self, peers, half):
        fold = first_fold(branch(peers, "toy", half)[2])
        v, period, _ = TOY_LPC[100.0]
        assert fold["v"] == pytest.approx(v, abs=PRINT)
        assert fold["T"] == pytest.approx(period, abs=1e-9)

    @FORMS
    def test_fold_curve_passes_the_fold_it_starts_from(self, peers, half):
        _, peer, cycles = branch(peers, "toy", half)
        curve = peer.lpc_curve(cycles, {"a3": (40.0, 200.0)}).table
        start = curve.iloc[(curve["a3"] - 100.0).abs().argmin()]
        assert start["a3"] == 100.0
        assert start["v"] == pytest.approx(TOY_LPC[100.0][0], abs=PRINT)
        assert start["T"] == pytest.approx(TOY_LPC[100.0][1], abs=1e-11)
        assert np.sort(curve["a3"].iloc[[0, -1]]) == pytest.approx([40.0, 200.0], abs=1e-3)
        # between neighbours a few units of a3 apart, a cubic through four points is good to 1e-7
        near = curve.iloc[(curve["a3"] - 50.0).abs().argsort()[:4]]
        cubic = np.polynomial.Polynomial.fit(near["a3"], near["v"], 3)
        assert cubic(50.0) == pytest.approx(TOY_LPC[50.0][0], abs=1e-7)

    def test_differences_give_the_same_fold_as_exact_jacobians(self, peers):
        fold = first_fold(branch(peers, "toy", True, jacobian=False)[2])
        assert fold["v"] == pytest.approx(TOY_LPC[100.0][0], abs=PRINT)

    def test_half_the_intervals_do_for_half_the_period(self, peers):
        """Coarse enough for the mesh to show: the two forms have much the same error."""
        errors = []
        for half, intervals in ((False, 10), (True, 5)):
            case, peer = peers["toy"]
            peer = peer.using(ntst=intervals, locate=1e-5)
            cycles = peer.cycles(peer.hopf(case.start), {"v": case.window}, half=half)
            errors.append(first_fold(cycles)["v"] - TOY_LPC[100.0][0])
        assert abs(errors[0]) > 100 * PRINT
        assert errors[1] == pytest.approx(errors[0], rel=0.5)

    def test_a_start_without_null_vector_is_named(self, peers):
        case, peer, cycles = branch(peers, "toy", True)
        with pytest.raises(StartFailed, match="no null vector"):
            peer.using(tolerance=1e-25).lpc_curve(cycles, {"a3": case.curve})

    def test_a_branch_without_fold_is_named(self, peers):
        case, peer = peers["toy"]
        short = peer.using(most=4)
        cycles = short.cycles(peer.hopf(case.start), {"v": case.window})
        with pytest.raises(AutoFailed, match="Restart label LP1 not found"):
            peer.lpc_curve(cycles, {"a3": case.curve})

    def test_the_whole_study_in_one_call(self, peers, tmp_path):
        case = dataclasses.replace(toy(50.0), curve=(45.0, 60.0))
        curve = lpc_curve(case, tmp_path, half=True, ntst=20, **FINE)
        assert list(curve.columns) == ["type", "v", "a3", "T"]
        [(_, start)] = curve[curve["a3"] == 50.0].iterrows()
        assert start["v"] == pytest.approx(TOY_LPC[50.0][0], abs=1e-9 + PRINT)
        assert start["T"] == pytest.approx(TOY_LPC[50.0][1], abs=1e-9)

    def test_autos_own_command_line_agrees(self, peers, tmp_path):
        required(shutil.which("auto-07p") is not None, "the command auto-07p")
        case = dataclasses.replace(toy(), curve=(90.0, 110.0))
        write_script(case, tmp_path, Settings(scales=case.scales, jacobian=True))
        clean = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
        subprocess.run(
            ["auto-07p", "full.auto"],
            cwd=tmp_path,
            env={**clean, "OMP_NUM_THREADS": "1"},
            check=True,
            capture_output=True,
        )
        text = (tmp_path / "b.full").read_text("ascii")
        folds = [line.split() for line in text.splitlines() if " 5    3 " in line]
        assert [float(fold[4]) for fold in folds] == pytest.approx([TOY_LPC[100.0][0]], abs=1e-8)


class TestPaper:
    def test_fold_does_not_depend_on_form_or_mesh(self, peers):
        folds = [first_fold(branch(peers, "paper", half)[2])["v"] for half in (False, True)]
        _, peer, _ = branch(peers, "paper", True)
        fine = peer.using(ntst=60)
        run = fine.cycles(fine.hopf((45.0, 60.0)), {"v": (45.0, 57.0)}, half=True)
        assert folds == pytest.approx([first_fold(run)["v"]] * 2, abs=3 * PRINT)

    def test_the_domain_left_is_an_outcome_not_a_number(self, peers):
        """AUTO takes the NaN beyond |y| = 11.65 mm for converged and goes on."""
        case, peer = peers["paper"]
        with pytest.raises(AutoFailed, match=r"no number from point|NaN"):
            peer.using(most=100).cycles(peer.hopf(case.start), {"v": (45.0, 90.0)})


def test_period_along_the_hopf_normal_form(tmp_path):
    """Another size and a cycle in closed form: r^2 = -mu/a, T = 2 pi/(omega + b r^2)."""
    required(available(), "AUTO-07p")
    system = hopf_normal_form(mu=-0.5, omega=2.0, a=-1.0, b=0.5)
    peer = Peer(Problem(system, tmp_path, ("mu",)), Settings(jacobian=True, ntst=20))
    table = peer.cycles(peer.hopf((-0.5, 0.5)), {"mu": (-1.0, 2.0)}).table
    assert table["mu"].iloc[-1] == pytest.approx(2.0, abs=1e-4)
    assert table["T"].to_numpy() == pytest.approx(2 * np.pi / (2 + 0.5 * table["mu"]), rel=1e-7)
