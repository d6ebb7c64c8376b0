"""Figures of profiles: labelled with units, the lines where the tables say."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.plotting.profiles import conicity_panels, contact_lines, profile_panels


def points(slope=0.0):
    y = np.linspace(-0.03, 0.03, 61)
    return pd.DataFrame({"y": y, "z": slope * y, "curvature": np.where(y < 0, -90.0, 3.0)})


def contact():
    y = np.linspace(-0.004, 0.004, 9)
    columns = {"dr": 0.2 * y}
    for side, s in (("left", 1), ("right", -1)):
        columns |= {f"delta_{side}": 0.05 + s * y, f"wheel_y_{side}": -s * y, f"rail_y_{side}": y}
    return pd.DataFrame(columns, index=pd.Index(y, name="y"))


def conicities():
    index = pd.Index([0.001, 0.003], name="amplitude")
    return pd.DataFrame({"integration": [0.1, 0.2], "regression": [0.1, 0.15]}, index=index)


FIGURES = {
    "profiles": lambda: profile_panels({"wheel": points(0.05), "rail": points()}),
    "lines": lambda: contact_lines(points(0.05), points(), contact()),
    "conicity": lambda: conicity_panels(contact(), conicities()),
}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units(name):
    axes = FIGURES[name]().axes
    labels = [t for ax in axes for t in (ax.get_xlabel(), ax.get_ylabel()) if t]
    assert labels and all("(" in label for label in labels)


def test_curvatures_of_a_flange_are_cut_off():
    bent = FIGURES["profiles"]().axes[2].lines[0].get_ydata()
    assert (min(bent), max(bent)) == (-30.0, 3.0)


def test_lines_join_the_places_of_contact():
    ax = FIGURES["lines"]().axes[0]
    first = ax.lines[2]
    assert first.get_xdata() == pytest.approx([4.0, -4.0])
    assert first.get_ydata() == pytest.approx([0.05 * 4.0 - 15.0, 15.0])
    # displacement and place are the same here: labels every 2 mm would be less than 5 mm apart
    assert {t.get_text() for t in ax.texts} == {"-4", "+2"}


def test_conicities_stand_at_their_amplitudes():
    ax = FIGURES["conicity"]().axes[3]
    assert ax.lines[0].get_xdata() == pytest.approx([1.0, 3.0])
    assert ax.lines[1].get_ydata() == pytest.approx([0.1, 0.15])
