"""Figures of fits: what is in the tables is what is drawn."""

from __future__ import annotations

import numpy as np
import pandas as pd

from tests.plotting.checks import drawn_alike_twice, labelled_with_units
from wheelset.plotting.contact_fits import branch_panel, fit_panels, noise_panel


def functions():
    y = np.linspace(-0.006, 0.006, 13)
    one = pd.DataFrame({"y": y, "dr": 0.1 * y, "delta": 0.06 + y, "rho": 9.0 + 0 * y})
    return {"contacts": one, "cubic": one}


def test_fits_lie_over_the_contacts_in_millimetres():
    dr, delta, rho = fit_panels(functions(), ["cubic"]).axes
    np.testing.assert_allclose(dr.lines[1].get_ydata(), 0.1 * dr.lines[1].get_xdata())
    assert delta.lines[0].get_ydata()[0] == 54.0
    assert set(rho.lines[1].get_ydata()) == {9.0}


def test_unstable_pieces_are_dashed_only_and_folds_are_marked():
    branch = pd.DataFrame(
        {
            "v": [80.0, 76.0, 75.0, 78.0],
            "amplitude": [0.0, 0.001, 0.002, 0.003],
            "unstable": [1, 1, 0, 0],
            "point": ["", "", "LPC", ""],
        }
    )
    (ax,) = branch_panel({"spline": branch}, ["spline"]).axes
    dashed, solid, folds = ax.lines
    assert len(dashed.get_xdata()) == 4
    assert np.isnan(solid.get_ydata()).tolist() == [True, True, False, False]
    assert (folds.get_xdata()[0], folds.get_ydata()[0]) == (75.0, 2.0)


def test_noise_is_told_from_spacing():
    trips = pd.DataFrame(
        {
            "spacing": [0.0, 1e-4, 1e-4],
            "noise": [0.0, 0.0, 5e-6],
            "v_lin": [80.0, 80.1, 81.0],
            "v_non": [70.0, 70.1, 69.0],
        }
    )
    lin, non = noise_panel(trips).axes
    assert [line.get_ydata()[-1] for line in lin.lines] == [80.0, 80.1, 81.0]
    assert [line.get_ydata()[-1] for line in non.lines] == [70.0, 70.1, 69.0]


def test_axes_carry_units_and_figures_are_reproducible(tmp_path):
    labelled_with_units(lambda: fit_panels(functions(), ["cubic"]))
    drawn_alike_twice(lambda: fit_panels(functions(), ["cubic"]), tmp_path)
