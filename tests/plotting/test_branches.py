"""Branches as drawn: every line, its style and every mark from the branch's own values."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from tests.systems import toy_wheelset
from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending, SpecialPoint
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumPoint
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve
from wheelset.bifurcation.equilibria.hopf_points import HopfCurvePoint
from wheelset.plotting.branches import MARKS, Quantity, branch_diagram, draw_branch
from wheelset.plotting.style import save

SPEED, PERIOD = Quantity("v", "speed (km/h)", 3.6), Quantity("period", "period (ms)", 1e3)
STIFFNESS = Quantity("k", "stiffness (N/m)")
STYLES = {"-": "stable", "--": "unstable"}


def cycle(period, unstable):
    multipliers = np.array([1.0] + [2.0] * unstable + [0.5] * (2 - unstable), dtype=complex)
    return Cycle(("x",), {"v": 0.0}, period, np.array([0.0, 1.0]), np.zeros((1, 5, 1)), None,
                 multipliers)  # fmt: skip


def hopf(flc, k=1.0):
    return HopfCurvePoint(np.zeros(1), np.zeros(2), k, flc, "", np.empty(0), ("x",))


def made(points, special=(), parameters=("v",), began="start", ended="window"):
    """points: values and solution. special: index, letters, values and solution."""
    u = np.zeros(1)
    return Branch(
        "curve", parameters,
        tuple(BranchPoint(u, u, np.array(p, float), s, {}, 0.0, 0.0) for p, s in points),
        tuple(SpecialPoint(k, "", {}, i, u, u, np.array(p, float), s) for i, k, p, s in special),
        (), Ending(began, ""), Ending(ended, ""), {},
    )  # fmt: skip


def folded(**kwargs):
    """A branch from v = 3 to the fold at v = 1 unstable, back to v = 3 stable."""
    known = [(3.0, 1.0, 1), (2.0, 1.1, 1), (1.1, 1.2, 1), (1.4, 1.3, 0), (2.5, 1.4, 0)]
    points = [([v], cycle(T, count)) for v, T, count in known]
    return made(points, [(2.4, "LPC", [1.0], cycle(1.25, 0))], **kwargs)


def drawn(branch, x=SPEED, y=PERIOD):
    """Axes with a branch, its lines (style, x, y) and its marks (letters, shape, x, y)."""
    ax = Figure().subplots()
    draw_branch(ax, branch, x, y)
    lines = [
        (line.get_linestyle(), list(line.get_xdata()), list(line.get_ydata()))
        for line in ax.lines if line.get_marker() in {"None", None, ""} and len(line.get_xdata())
    ]  # fmt: skip
    shapes = [line for line in ax.lines if line.get_linestyle() == "None"]
    marks = [
        (text.get_text(), line.get_marker(), *text.xy, line.get_xdata()[0], line.get_ydata()[0])
        for text, line in zip(ax.texts, shapes, strict=True)
    ]
    return lines, marks


def test_styles_change_exactly_at_the_fold():
    lines, marks = drawn(folded())
    kmh = [3.6 * v for v in (3.0, 2.0, 1.1, 1.0, 1.4, 2.5)]
    ms = [1e3 * T for T in (1.0, 1.1, 1.2, 1.25, 1.3, 1.4)]
    assert lines == [("--", kmh[:4], ms[:4]), ("-", kmh[3:], ms[3:])]
    assert marks == [("LPC", MARKS["LPC"], 3.6, 1250.0, 3.6, 1250.0)]


def test_a_step_between_points_that_disagree_is_not_called_stable():
    [unstable, stable], _ = drawn(made([([v], cycle(1.0, v < 3)) for v in (1.0, 2.0, 3.0, 4.0)]))
    assert unstable[:2] == ("--", [3.6 * v for v in (1.0, 2.0, 3.0)])
    assert stable[:2] == ("-", [3.6 * v for v in (3.0, 4.0)])


@pytest.mark.parametrize(("between", "style"), [(1, "--"), (0, "-")])
def test_between_two_special_points_of_one_step_they_say_what_is_there(between, style):
    """Where the first multiplier has left the second finds it outside."""
    ends = 1 - between
    points = [([v], cycle(1.0, ends)) for v in (1.0, 2.0)]
    special = [(0.3, "LPC", [1.3], cycle(1.0, 0)), (0.6, "BPC", [1.6], cycle(1.0, between))]
    lines, marks = drawn(made(points, special))
    outer = "-" if style == "--" else "--"
    assert [line[0] for line in lines] == [outer, style, outer]
    assert lines[1][1] == [1.3 * 3.6, 1.6 * 3.6]
    assert [mark[0] for mark in marks] == ["LPC", "BPC"]


@pytest.mark.parametrize("noise", [0, 2])
@pytest.mark.parametrize("at", [0, 2])
def test_a_point_that_is_itself_special_has_no_say(at, noise):
    """Rounding decides on which side of the axis a critical eigenvalue is counted."""
    counts = [0, 0, 0, 0, 0]
    counts[at] = noise
    points = [([float(k)], cycle(1.0, count)) for k, count in enumerate(counts)]
    lines, _ = drawn(made(points, [(float(at), "BP", [float(at)], cycle(1.0, noise))]))
    solid = [line for line in lines if len(set(line[1])) > 1]
    assert {line[0] for line in solid} == {"-"}


@pytest.mark.parametrize("kind", ["problem", "window"])
def test_the_point_beyond_the_birth_of_a_cycle_is_not_drawn(kind):
    """The walk notices that a cycle has passed size zero one point too late."""
    points = [([v], cycle(1.0, 0)) for v in (3.0, 2.0, 1.1)]
    branch = made(points, [(1.9, "H", [1.0], cycle(1.0, 0))], ended=kind)
    [(_, speeds, _)], _ = drawn(branch)
    expected = [3.0, 2.0, 1.0] if kind == "problem" else [3.0, 2.0, 1.0, 1.1]
    assert speeds == [3.6 * v for v in expected]
    turned = made(points[::-1], [(0.1, "H", [1.0], cycle(1.0, 0))], began=kind)
    assert drawn(turned)[0][0][1] == speeds[::-1]


def curve():
    """A Hopf curve with GH between FLC = -1 and 1, BT before two neutral saddles."""
    solutions = [*map(hopf, (-2.0, -1.0, 1.0, 2.0)), hopf(None, -1.0), hopf(None, -2.0)]
    points = [([10.0 + k, 5.0 * k], solution) for k, solution in enumerate(solutions)]
    special = [(1.5, "GH", [11.5, 7.5], hopf(1e-9)), (3.2, "BT", [13.2, 16.0], hopf(None, 0.0))]
    return made(points, special, ("v", "k"))


def test_a_hopf_curve_is_solid_where_it_is_supercritical():
    lines, marks = drawn(curve(), STIFFNESS, SPEED)
    assert [(style, x) for style, x, _ in lines] == [
        ("-", [0.0, 5.0, 7.5]), ("--", [7.5, 10.0, 15.0, 16.0]), (":", [16.0, 20.0, 25.0]),
    ]  # fmt: skip
    assert lines[0][2] == [3.6 * v for v in (10.0, 11.0, 11.5)]
    assert [(mark[0], mark[1]) for mark in marks] == [("GH", "*"), ("BT", MARKS["BT"])]


def test_hopf_points_without_a_coefficient_are_neither_solid_nor_dashed():
    points = [([10.0 + k, 5.0 * k], hopf(None)) for k in range(3)]
    [line], _ = drawn(made(points, parameters=("v", "k")), STIFFNESS, SPEED)
    assert line[0] == "-."


def test_a_curve_of_folds_is_whole():
    points = [([10.0 + k, 5.0 * k], cycle(1.0, k % 2)) for k in range(4)]
    branch = made(points, [(1.5, "CPC", [11.5, 7.5], cycle(1.0, 0))], ("v", "k"))
    lines, marks = drawn(branch, STIFFNESS, SPEED)
    assert [(style, x) for style, x, _ in lines] == [("-", [0.0, 5.0, 7.5, 10.0, 15.0])]
    assert marks[0][0] == "CPC"


def test_a_computed_hopf_curve_is_drawn_where_it_is():
    system = toy_wheelset()
    found = hopf_curve(system, hopf_point(system, "v", 50.0), ("v", "a3"), {"a3": (-150.0, 150.0)})
    lines, marks = drawn(found, Quantity("a3", "a3 (1/m2)"), SPEED)
    [gh] = found.of_kind("GH")
    assert [style for style, _, _ in lines] == ["-", "--"]
    xs = [*lines[0][1][:-1], *lines[1][1][1:]]
    assert xs == [point.values[1] for point in found.points]
    assert lines[0][1][-1] == lines[1][1][0] == gh.values[1]
    assert marks == [("GH", "*", *[gh.values[1], 3.6 * gh.values[0]] * 2)]


# --- several branches, legends, marks ------------------------------------------------------------


def test_every_branch_has_its_colour_and_one_legend_explains_all():
    figure = branch_diagram({"one": folded(), "other": folded()}, SPEED, PERIOD)
    [ax] = figure.axes
    words = [text.get_text() for text in ax.get_legend().get_texts()]
    assert words == ["one", "other", "stable", "unstable"]
    colours = [line.get_color() for line in ax.get_legend().get_lines()]
    assert len(set(colours[:2])) == 2
    styles = [line.get_linestyle() for line in ax.get_legend().get_lines()]
    assert styles == ["-", "-", "-", "--"]
    assert [text.get_text() for text in ax.texts] == ["LPC"]  # a point that both have
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("speed (km/h)", "period (ms)")


def test_equal_letters_at_different_points_are_all_written():
    special = [(0.3, "NS", [1.3], cycle(1.0, 0)), (1.5, "NS", [2.5], cycle(1.2, 0))]
    points = [([v], cycle(v, 0)) for v in (1.0, 2.0, 3.0)]
    assert [mark[0] for mark in drawn(made(points, special))[1]] == ["NS", "NS"]


def test_a_line_of_one_sort_is_explained_too():
    points = [([v], cycle(1.0, 0)) for v in (1.0, 2.0)]
    legend = branch_diagram({"": made(points)}, SPEED, PERIOD).axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["stable"]


def test_equilibria_and_cycles_share_an_axis_by_measures_of_their_own():
    rest = [([v], EquilibriumPoint(np.array([v]), v, np.zeros(1), ("x",))) for v in (1.0, 2.0)]
    height = Quantity("max x", "x (mm)", 1e3, of_equilibria="x")
    assert drawn(made(rest), SPEED, height)[0][0][2] == [1000.0, 2000.0]
    assert drawn(folded(), SPEED, height)[0][0][2] == [0.0] * 4


def test_letters_keep_off_the_branch():
    """At a fold that opens to the right they stand on the left."""
    sides = {}
    for name, sign in (("right", 1.0), ("left", -1.0)):
        points = [([sign * v], cycle(T, 0)) for v, T in ((2.0, 1.0), (2.0, 2.0))]
        branch = made(points, [(0.5, "LPC", [sign], cycle(1.5, 0))])
        ax = Figure().subplots()
        draw_branch(ax, branch, SPEED, PERIOD)
        sides[name] = ax.texts[0].get_ha()
    assert sides == {"right": "right", "left": "left"}


FAMILIES = {
    "equilibria": ("LP", "H", "BP", "NSE"),
    "cycles": ("LPC", "BPC", "PD", "NS", "H"),
    "Hopf points": ("GH", "BT", "ZH", "HH"),
    "folds of cycles": ("CPC", "GH", "R1", "LPPD", "LPNS"),
    "period doublings": ("R2", "GPD", "LPPD", "PDNS"),
}


@pytest.mark.parametrize("family", FAMILIES)
def test_special_points_of_one_family_differ_in_shape(family):
    letters = FAMILIES[family]
    assert len({MARKS[one] for one in letters}) == len(letters)


def test_letters_without_a_shape_are_marked_all_the_same():
    points = [([v], cycle(1.0, 0)) for v in (1.0, 2.0)]
    _, [mark] = drawn(made(points, [(0.5, "NEW", [1.5], cycle(1.0, 0))]))
    assert mark[0] == "NEW"


def test_an_unknown_measure_is_named():
    with pytest.raises(ValueError, match=r"unknown measure 'amplitude z'"):
        drawn(folded(), SPEED, Quantity("amplitude z", "z (m)"))


def test_settings_are_left_alone_and_the_same_figure_gives_the_same_file(tmp_path):
    before = dict(mpl.rcParams)
    one, two = (
        save(branch_diagram({"a": folded()}, SPEED, PERIOD), tmp_path / f"{k}.svg") for k in (1, 2)
    )
    assert dict(mpl.rcParams) == before
    assert one.read_bytes() == two.read_bytes()
