"""The study of simulated wear: what is put in comes out, and what is assumed matters."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.profiles.worn import worn_profiles
from wheelset.studies import wear_simulation

QUICK = wear_simulation.Parameters(resolution="quick", mileage=2.0)


@pytest.fixture(scope="module")
def found():
    return wear_simulation.outcomes(QUICK)


def test_the_greatest_depth_is_the_one_put_in(found):
    table = wear_simulation.table(found)
    assert table["greatest_depth_mm"].to_numpy() == pytest.approx(0.055 * 2.0, rel=1e-6)
    assert wear_simulation.depths(found).max().to_numpy() == pytest.approx(1.1e-4, rel=1e-6)


def test_a_wider_scatter_wears_a_wider_band(found):
    table = wear_simulation.table(found).set_index("variant")
    width = table["band_to_mm"] - table["band_from_mm"]
    assert width["scatter 2 mm"] > width["archard_kth"]


def test_worn_wheels_have_both_critical_speeds(found):
    table = wear_simulation.table(found)
    assert (table["v_non"] < table["v_lin"]).all()
    assert list(wear_simulation.conicities(found).columns) == list(table["variant"])


def test_the_wheel_load_is_the_vehicles():
    p = wear_simulation.Parameters(resolution="quick", mileage=0.5, changes="p0=70e3")
    assert {o.history.simulation.operation.load for o in wear_simulation.outcomes(p)} == {70e3}


def test_packaged_depths_are_those_of_the_packaged_wheels():
    depths = wear_simulation.packaged_depths()
    for law, table in depths.items():
        assert list(table.columns) == list(worn_profiles(law))
        rate = table.max() * 1e3 / table.columns.to_numpy(float)
        assert rate.iloc[-1] == pytest.approx(0.055, rel=1e-3)
        assert (np.diff(table.max()) > 0).all()


def test_the_files_say_that_nothing_was_measured():
    for lines in wear_simulation.provenance().values():
        assert "not measured" in lines[0]
        assert any("calibration: the law times" in line for line in lines)
