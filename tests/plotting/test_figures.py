"""Figures: on the paper's axes, labelled with units, reproducible, and without side effects."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from tests.plotting.checks import drawn_alike_twice, labelled_with_units
from wheelset.plotting.flange import force_law_panels
from wheelset.plotting.geometry import geometry_panels
from wheelset.plotting.loci import eigenvalue_panels
from wheelset.plotting.motion import time_history_panels
from wheelset.plotting.verdicts import hopf_comparison
from wheelset.published.figures import PANELS
from wheelset.studies import flange_models, hopf_point, model


def force_laws():
    p = flange_models.Parameters(resolution="quick")
    return force_law_panels(flange_models.force_laws(p), flange_models.domains(p), 0.00923)


def motions():
    t = np.linspace(0, 5, 101)
    names = [f"case {case}, {law}" for case in (1, 2) for law in ("none", "quintic")]
    frames = [pd.DataFrame({"panel": n, "t": t, "y": 0.01 * np.cos(t)}) for n in names]
    outcomes = pd.DataFrame({"panel": names, "title": names, "ended_at": [np.nan] * 3 + [4.0]})
    return time_history_panels(pd.concat(frames), outcomes.assign(paper_amplitude=0.01))


def loci():
    p = hopf_point.Parameters(v_min=20, v_max=80, resolution="quick")
    points = pd.DataFrame({"v": [51.7], "frequency": [41.0]})
    return eigenvalue_panels(hopf_point.loci(p), points, 51.70)


def geometry():
    p = model.Parameters(resolution="quick")
    return geometry_panels(model.contact_geometry(p), model.domain(p))


def comparison():
    rows = [("Table 3: a1=0.05", q, 10.0, 11.0) for q in ("hopf_speed", "flc")]
    table = pd.DataFrame(rows, columns=["item", "quantity", "published", "computed"])
    return hopf_comparison({"one": table, "two": table})


FIGURES = {f.__name__: f for f in (force_laws, motions, loci, geometry, comparison)}


@pytest.mark.parametrize("name", FIGURES)
def test_axes_carry_units_and_settings_are_left_alone(name):
    labelled_with_units(FIGURES[name])


@pytest.mark.parametrize("name", FIGURES)
def test_the_same_figure_gives_the_same_file(name, tmp_path):
    drawn_alike_twice(FIGURES[name], tmp_path)


@pytest.mark.parametrize(("number", "draw"), [(4, force_laws), (5, motions)])
def test_axes_are_those_of_the_paper(number, draw):
    panels = [panel for panel in PANELS if panel.figure == number]
    for panel, ax in zip(panels, draw().axes, strict=True):
        assert ax.get_xlim() == (panel.x.low, panel.x.high)
        assert ax.get_ylim() == (panel.y.low, panel.y.high)
