"""Figures of the report and of re-profiling: what is drawn is what was given."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.plotting import report, reprofiling
from wheelset.plotting.style import svg


def lines_of(ax):
    return [line for line in ax.lines if len(line.get_xdata()) > 2]


@pytest.fixture
def contact():
    y = np.linspace(-0.01, 0.01, 21)
    columns = {f"{name}_{side}": y + k for k, name in enumerate(("r", "delta", "rho"))
               for side in ("left", "right")}  # fmt: skip
    return pd.DataFrame(columns, index=pd.Index(y, name="y"))


def test_functions_are_drawn_in_their_units_with_jumps(contact):
    figure = report.function_panels(contact, [0.003, -0.003])
    top = figure.axes[0]
    assert len(figure.axes) == 3
    assert lines_of(top)[0].get_ydata() == pytest.approx(contact["r_left"] * 1e3)
    dotted = [line for line in top.lines if line.get_linestyle() == ":"]
    assert sorted(line.get_xdata()[0] for line in dotted) == pytest.approx([-3.0, 3.0])


def test_conicities_begin_at_zero():
    table = pd.DataFrame({"integration": [0.1, 0.2], "regression": [0.1, 0.15]}, index=[1e-3, 2e-3])
    (ax,) = report.conicity_panel(table).axes
    assert ax.get_ylim()[0] == 0.0


def test_without_cycles_straight_running_is_drawn_over_the_window():
    (ax, *_) = report.speed_diagram({}, 5e-4, None, (10.0, 50.0)).axes
    assert ax.lines[0].get_xdata().tolist() == pytest.approx([36.0, 180.0])


def test_svg_is_the_same_for_the_same_figure():
    table = pd.DataFrame({"integration": [0.1, 0.2], "regression": [0.1, 0.15]}, index=[1e-3, 2e-3])
    one, two = (svg(report.conicity_panel(table)) for _ in range(2))
    assert one == two
    assert one.rstrip().endswith("</svg>")


@pytest.fixture
def campaigns():
    rows = [
        {"sample": k, "mileage": m, "v_lin": 80 - m + k, "v_non": 60 - 2 * m + 0.1 * k}
        for k in range(20)
        for m in (0.0, 5.0, 10.0)
    ]
    return pd.DataFrame(rows)


def test_margins_show_speeds_band_and_histogram(campaigns):
    wheels = campaigns[campaigns["sample"] == 0]
    figure = reprofiling.margin_panels(
        wheels, campaigns, {"v_lin": 75.0, "v_non": 50.0},
        {"v_lin": np.array([5.0, 6.0]), "v_non": np.zeros(0)},
    )  # fmt: skip
    left, right, below, empty = figure.axes
    assert left.get_title().startswith("linear")
    assert lines_of(left)[1].get_ydata() == pytest.approx(wheels["v_lin"])
    assert len(right.collections) == 1
    assert sum(bar.get_height() for bar in below.patches) == 2
    assert "in no campaign" in [text.get_text() for text in empty.texts]


def test_averaging_is_drawn_beside_its_law():
    counts = np.array([1.0, 4.0, 16.0])
    (ax,) = reprofiling.averaging_panel(counts, {"v_lin": 2 / np.sqrt(counts)}).axes
    marks, law = lines_of(ax)
    assert marks.get_ydata() == pytest.approx(law.get_ydata())
