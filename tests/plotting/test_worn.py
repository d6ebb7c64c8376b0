"""Figures of section 6: the paper's axes, the paper's numbers as rings, settings left alone."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from tests.plotting.checks import labelled_with_units
from wheelset.plotting import worn, worn_speeds
from wheelset.published.figures import panel
from wheelset.published.numbers import TABLE_4

MILEAGES = (0.2, 18.5)


def profiles():
    y = np.linspace(-0.06, 0.06, 25)
    frames = [
        pd.DataFrame({"mileage": m, "y": y, "z": -0.05 * y - 1e-4 * m}) for m in (0.0, *MILEAGES)
    ]
    return worn.worn_profiles(pd.concat(frames))


def contact():
    y = np.linspace(-0.008, 0.008, 17)
    frames = [
        pd.DataFrame({"mileage": m, "y": y, "r": 0.46 + y / 10, "delta": y, "curvature": 100 * y})
        for m in MILEAGES
    ]
    waves = [pd.DataFrame({"mileage": m, "amplitude": abs(y), "conicity": 0.1}) for m in MILEAGES]
    return worn.worn_contact(pd.concat(frames), pd.concat(waves))


def closer():
    y = np.linspace(-0.008, 0.008, 17)
    frames = [pd.DataFrame({"mileage": m, "y": y, "curvature": 100 * y}) for m in MILEAGES]
    return worn.curvature_close(pd.concat(frames), 5e-4)


def speeds(**columns):
    table = {
        "mileage": [0.2, 4.8],
        "v_lin": [70.0, 71.0],
        "v_fold": [60.0, np.nan],
        "flc": [-1, 9.0],
    }
    return pd.DataFrame(table | columns)


def by_mileage():
    return worn_speeds.speeds_by_mileage({"one": speeds(), "two": speeds()})


def by_width():
    return worn_speeds.speeds_by_width(pd.concat([speeds(width=w) for w in (3e-4, 1e-3)]))


def stiffness():
    rows = [(m, c, k, 2e6 - k) for m in MILEAGES for c in ("Hopf", "LPC") for k in (0.0, 1e6)]
    return worn_speeds.stiffness_panels(
        pd.DataFrame(rows, columns=["mileage", "curve", "Kpx", "Kpy"])
    )


def inverse():
    table = speeds(a1=0.14, neutral=30.0, read=500.0, **{"as MATCONT prints it": 20.0})
    return worn_speeds.inverse_panels({"one": table}, "read", (-500.0, 500.0))


FIGURES = {
    f.__name__: f for f in (profiles, contact, closer, by_mileage, by_width, stiffness, inverse)
}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units_and_settings_are_left_alone(name):
    labelled_with_units(FIGURES[name])


@pytest.mark.parametrize(
    ("draw", "number", "names"), [(profiles, 9, "ab"), (contact, 10, "abcd"), (stiffness, 11, [""])]
)
def test_axes_are_the_papers(draw, number, names):
    for ax, name in zip(draw().axes, names, strict=False):
        shown = panel(number, name)
        assert ax.get_xlim() == (shown.x.low, shown.x.high)
        assert ax.get_ylim() == (shown.y.low, shown.y.high)


def test_printed_numbers_are_rings():
    left, right = by_mileage().axes
    for ax, quantity in ((left, "hopf_speed"), (right, "flc")):
        rings = next(line for line in ax.get_lines() if line.get_label() == "paper")
        assert rings.get_ydata().tolist() == [getattr(row, quantity) for row in TABLE_4]


def test_colors_go_from_dark_to_light_whatever_the_order():
    colors = worn.mileage_colors([18.5, 0.2, 4.8])
    assert list(colors) == [0.2, 4.8, 18.5]
    light = [sum(mpl.colors.to_rgb(c)) for c in colors.values()]
    assert light == sorted(light)
