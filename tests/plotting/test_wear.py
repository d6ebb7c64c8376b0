"""Figures of wear: what is in the tables is what is drawn."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tests.plotting.checks import drawn_alike_twice, labelled_with_units
from wheelset.plotting.wear import depth_panels, variant_panels, variant_speeds


def test_depths_point_down_in_millimetres_and_the_band_is_shaded():
    y = np.linspace(-0.03, 0.03, 7)
    table = pd.DataFrame({4.8: 1e-4 + 0 * y, 18.5: 1e-3 + 0 * y}, index=y)
    (ax,) = depth_panels({"a law": table}).axes
    assert [line.get_ydata()[0] for line in ax.lines] == pytest.approx([0.1, 1.0])
    assert ax.yaxis_inverted()
    assert sorted(round(patch.get_x()) for patch in ax.patches) == [-25, 15]


def test_the_chosen_variant_is_drawn_last_and_strongest():
    table = pd.DataFrame({"a": [0.1, 0.2], "b": [0.3, 0.4]}, index=[0.001, 0.002])
    (ax,) = variant_panels(table, "a").axes
    assert [line.get_label() for line in ax.lines] == ["b", "a"]
    assert ax.lines[-1].get_linewidth() > ax.lines[0].get_linewidth()


def test_both_speeds_stand_on_the_line_of_their_variant():
    table = pd.DataFrame({"variant": ["a", "b"], "v_lin": [80.0, 60.0], "v_non": [40.0, 39.0]})
    (ax,) = variant_speeds(table).axes
    lin, non = ax.lines
    assert list(lin.get_xdata()) == [80.0, 60.0]
    assert list(non.get_ydata()) == [0, 1]


def test_axes_carry_units_and_figures_are_reproducible(tmp_path):
    y = np.linspace(-0.03, 0.03, 7)
    depths = {"a law": pd.DataFrame({4.8: 1e-4 + 0 * y}, index=y)}
    conicities = pd.DataFrame({"a": [0.1, 0.2], "b": [0.3, 0.4]}, index=[0.001, 0.002])
    labelled_with_units(lambda: depth_panels(depths))
    labelled_with_units(lambda: variant_panels(conicities, "a"))
    drawn_alike_twice(lambda: variant_panels(conicities, "a"), tmp_path)
