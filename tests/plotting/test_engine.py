"""Figures of the engine, drawn from the record that the benchmark stored."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.plotting.checks import drawn_alike_twice, labelled_with_units
from wheelset.plotting.engine import convergence_panels, cost_panels, goal_dots, time_bars

RECORD = Path(__file__).parents[2] / "benchmarks" / "results" / "engine.json"


@pytest.fixture(scope="module")
def record():
    return json.loads(RECORD.read_text("utf-8"))


def convergence(record):
    rows = [
        {"system": system, "form": form, "intervals": n, "quantity": name, "error": n**-order}
        for system in ("one", "two")
        for form in ("full", "half")
        for n in (10.0, 20.0, 40.0)
        for name, order in (("mesh points", 8.0), ("between them", 5.0), ("period", 20.0))
    ]
    return convergence_panels(pd.DataFrame(rows))


def goals(record):
    rows = pd.DataFrame(record["goals"])
    return goal_dots(rows[rows["unit"] == "times"])


def costs(record):
    names = "against_intervals", "cost_lines", "against_size"
    return cost_panels(*(pd.DataFrame(record[name]) for name in names))


def times(record):
    return time_bars(record["breakdown"])


FIGURES = {f.__name__: f for f in (convergence, goals, costs, times)}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units_and_settings_are_left_alone(name, record):
    labelled_with_units(lambda: FIGURES[name](record))


@pytest.mark.parametrize("name", FIGURES)
def test_the_same_figure_gives_the_same_file(name, record, tmp_path):
    drawn_alike_twice(lambda: FIGURES[name](record), tmp_path)


def test_grey_lines_have_the_orders_of_theory(record):
    for ax in convergence(record).axes:
        lines = {line.get_label(): np.log(line.get_xydata()) for line in ax.lines}
        for order in (5, 8):
            (x, y), (x_end, y_end) = lines[f"order {order}"]
            assert (y_end - y) / (x_end - x) == pytest.approx(-order)


def test_errors_below_rounding_stay_on_the_axes(record):
    for ax in convergence(record).axes:
        drawn = [line for line in ax.lines if not str(line.get_label()).startswith("order")]
        lowest = min(line.get_ydata().min() for line in drawn)
        assert lowest >= ax.get_ylim()[0]


def test_a_bar_is_as_long_as_its_step(record):
    [ax] = times(record).axes
    ends = {}
    for patch in ax.patches:
        height = round(patch.get_y() + patch.get_height() / 2)
        ends[height] = max(ends.get(height, 0.0), patch.get_x() + patch.get_width())
    steps = [
        sum(ms for part, ms in walks[walk].items() if part.endswith("_ms"))
        for walk in ("cycles", "lpc_curve")
        for walks in record["breakdown"].values()
    ]
    assert [ends[height] for height in sorted(ends)] == pytest.approx(steps)


def test_the_record_names_no_machine_and_no_folder(record):
    assert not re.search(r"/(home|root|tmp|usr|var|work)\b", json.dumps(record))
    assert {"processor", "python", "threads"} <= set(record["machine"])
    assert "node" not in record["machine"]
