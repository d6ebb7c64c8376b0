"""Fold curves of section 5: sheets, ends, outcomes in words, and what a reader's change does."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from wheelset.bifurcation.curves.branch import Branch, Ending
from wheelset.studies import first_fold, lpc_claims, lpc_curves, table_3


@dataclass
class Small:
    """A cycle of an amplitude."""

    amplitude: float

    def measure(self, name):
        return {"max y": self.amplitude}[name]


def branch(values, start, amplitude=0.01):
    points = tuple(
        SimpleNamespace(
            values=np.array([50.0 + k, value]), arclength=float(k - start),
            solution=Small(amplitude if k else 1e-6),
        )
        for k, value in enumerate(values)
    )  # fmt: skip
    stopped = Ending("least step", "no convergence")
    return Branch("folds", ("v", "c1"), points, (), (), stopped, stopped, {})


def values_of(points):
    return [float(point.values[1]) for point in points]


def test_a_sheet_reaches_to_where_the_coefficient_turns():
    turning = branch([0.0, 2.0, 1.0, 3.0, 4.0, 6.0, 5.0], start=4)
    assert values_of(lpc_curves.sheet(turning)) == [1.0, 3.0, 4.0, 6.0]
    falling = branch([6.0, 4.0, 2.0, 3.0], start=1)
    assert values_of(lpc_curves.sheet(falling)) == [2.0, 4.0, 6.0]
    assert values_of(lpc_curves.sheet(branch([1.0], start=0))) == [1.0]


def test_without_a_fold_there_are_words():
    p = lpc_curves.Parameters(resolution="quick", changes="a3=-499.4")
    found = lpc_curves.default_fold(p)
    assert found.fold is None
    assert found.words.startswith("no fold of cycles: they are born stable")
    scan = lpc_curves.FIGURE_8[3]
    s = lpc_curves.FoldScan("x", scan, found.system, None, None, found.words)
    assert lpc_curves.fold_at(s, 0.0) is None
    assert lpc_claims.figure_8_claims({}, [s]).empty
    assert lpc_claims.coefficient_for(s, 50.0) is None


def test_a_window_without_hopf_point_is_said():
    p = lpc_curves.Parameters(v_min=10, v_max=20)
    found = lpc_curves.default_fold(p)
    assert (found.hopf, found.words) == (None, "no Hopf point between 10 and 20 m/s")


@pytest.mark.parametrize("law", ["exponential", "reciprocal"])
def test_a_readers_flange_law_gives_another_fold(law):
    p = lpc_curves.Parameters(changes=f"flange_law={law}")
    fold = lpc_curves.default_fold(p).fold
    rows = table_3.row_of_table(p, p.vehicle, "a3", 200.0)
    assert fold.values[0] == rows[1].fold.values[0]
    default = lpc_curves.default_fold(lpc_curves.Parameters()).fold
    assert bool(fold.values[0] == default.values[0]) == (law == "exponential")


def test_the_right_normalisation_has_one_ratio():
    table = pd.DataFrame(
        {"b": [50.0, 100.0, None], "slope": [0.1, 0.01, None], "period": [0.15, 0.16, None]}
    )
    found = table_3.normalisations(table, [55.0, 110.0, None]).set_index("normalisation")
    spread = found["spread"].to_numpy()
    assert spread[0] == pytest.approx(0.0, abs=1e-12)
    assert (spread[1:] > 0.01).all()
    assert found["least"].iloc[0] == pytest.approx(1.1)


def test_section_5_is_given_before_the_reader_speaks():
    p = lpc_curves.Parameters(changes="a3=300")
    assert p.load(p.vehicle, given=first_fold.SECTION_5).values["a3"] == 300.0
    plain = replace(lpc_curves.default_fold(lpc_curves.Parameters()), fold=None)
    assert plain.system.values["a3"] == 200.0
    assert plain.cycle is None
