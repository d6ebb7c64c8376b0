"""A designer's figures: labelled with units, every bar and mark where the table says."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.plotting.design import gap_panels, threshold_panels, tornado_panels


def bars():
    rows = [(n, s, -1.0, 2.0, 1.5) for n in ("a1", "wp") for s in ("lin", "non")]
    return pd.DataFrame(rows, columns=["parameter", "speed", "lower", "higher", "tangent"])


def gaps():
    flc = np.array([1.0, 10.0, 100.0])
    return pd.DataFrame({"parameter": "a3", "flc": flc, "gap": 0.1 * flc, "estimate": 0.2 * flc})


def family():
    return pd.DataFrame({"v": [52.0, 51.0, 52.0], "y": [0.0, 0.008, 0.01], "unstable": [1, 1, 0]})


def disturbances():
    return pd.DataFrame({"v": [51.5], "y0": [0.005]})


FIGURES = {
    "tornado": lambda: tornado_panels({"one": bars(), "two": bars()}),
    "gaps": lambda: gap_panels({"one": gaps(), "two": gaps()}),
    "thresholds": lambda: threshold_panels(
        {"one": family(), "two": family()}, {"one": disturbances(), "two": disturbances()}
    ),
}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units_and_readings_their_titles(name):
    axes = FIGURES[name]().axes
    assert [ax.get_title() for ax in axes] == ["one", "two"]
    labels = [t for ax in axes for t in (ax.get_xlabel(), ax.get_ylabel()) if t]
    assert labels and all("(" in label for label in labels)


def test_bars_end_where_the_table_says():
    widths = {bar.get_width() for bar in tornado_panels({"one": bars()}).axes[0].patches}
    assert widths == {-1.0, 2.0, 0.0}  # 0: the legend's


def test_the_fold_belongs_to_the_unstable_and_the_stable_part():
    ax = threshold_panels({"one": family()}, {"one": disturbances()}).axes[0]
    stable, unstable = (line.get_ydata() for line in ax.lines[:2])
    assert np.isfinite(unstable).tolist() == [True, True, False]
    assert np.isfinite(stable).tolist() == [False, False, True]
