"""Figures of the contact formulas: labelled with units, reproducible, without side effects."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tests.plotting.checks import drawn_alike_twice, labelled_with_units
from wheelset.plotting.contact_formulas import (
    CREEP,
    KALKER,
    fit_panels,
    hertz_panels,
    kalker_panels,
)

VISITED = pd.DataFrame(
    [("one", 0.2, 4.0, 0.4, 2.5), ("two", 0.5, np.inf, 0.6, np.inf)],
    columns=["of", "low", "high", "k_low", "k_high"],
)
K = np.geomspace(0.1, 10, 7)


def hertz():
    names = [("inside", "Hertz", n) for n in ("ab", "b/a", *CREEP)]
    names += [("outside", "Hertz", "ab"), *(("inside", "both", n) for n in CREEP)]
    ratio = np.geomspace(0.05, 20, 9)
    columns = {"ratio": ratio, "error": 0.01 * np.log(ratio)}
    frames = [
        pd.DataFrame({"reading": r, "against": a, "quantity": n, **columns}) for r, a, n in names
    ]
    return hertz_panels(pd.concat(frames), VISITED)


def points():
    frames = [
        pd.DataFrame({"coefficient": c, "nu": nu, "k": K, "value": 1 + nu + K, "error": 0.01 * K})
        for c in KALKER
        for nu in (0.0, 0.25, 0.5)
    ]
    return pd.concat(frames)


def table():
    return kalker_panels(points(), points().query("nu == 0.25"), VISITED)


def fits():
    nu = np.linspace(0, 0.5, 11)
    frames = [
        pd.DataFrame({"coefficient": c, "nu": nu, "rms": 0.01 + (nu - 0.3) ** 2}) for c in KALKER
    ]
    best = pd.DataFrame({"coefficient": list(KALKER), "nu": 0.3, "rms": 0.01})
    return fit_panels(points().query("nu == 0.25"), pd.concat(frames), best)


FIGURES = {f.__name__: f for f in (hertz, table, fits)}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units_and_settings_are_left_alone(name):
    labelled_with_units(FIGURES[name])


@pytest.mark.parametrize("name", FIGURES)
def test_the_same_figure_gives_the_same_file(name, tmp_path):
    drawn_alike_twice(FIGURES[name], tmp_path)


def test_a_range_without_end_reaches_the_edge():
    bars = hertz().axes[2].patches
    edge = hertz().axes[2].get_xlim()[1]
    assert [bar.get_x() for bar in bars] == list(VISITED["low"])
    assert bars[0].get_x() + bars[0].get_width() == pytest.approx(4.0)
    assert bars[1].get_x() + bars[1].get_width() > edge


def test_errors_are_drawn_in_per_cent():
    drawn = hertz().axes[0].lines[0].get_ydata()
    assert drawn == pytest.approx(np.log(np.geomspace(0.05, 20, 9)))
