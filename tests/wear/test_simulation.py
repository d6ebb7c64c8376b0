"""The evolution of a profile: calibration, determinism, resuming to the bit."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest

from wheelset.profiles import contact_geometry, packaged
from wheelset.wear import (
    NoWear,
    Operation,
    Simulation,
    Stepping,
    Store,
    Strips,
    WearHistory,
    evolve,
    history_of,
    wear_law,
)
from wheelset.wear.simulation import MILEAGE


def small(**changes) -> Simulation:
    """Few conditions, wide strips, two mileages: 0.1 mm in all."""
    values = {
        "wheel": packaged("LMB10"),
        "rail": packaged("CHN60"),
        "law": wear_law("usfd"),
        "mileages": (0.5, 2.0),
        "strips": Strips(spacing=5e-4),
        "stepping": Stepping(5e-5, 5e-6),
        "count": 8,
    }
    return Simulation(**{**values, **changes})


@pytest.fixture(scope="module")
def done() -> WearHistory:
    return history_of(small(), evolve(small()))


def test_the_field_rate_is_met_at_the_last_mileage(done):
    assert done.depth[-1].max() == pytest.approx(0.055e-3 * 2.0, rel=1e-8)
    assert done.depth.shape == (2, len(done.y))
    assert np.all(done.depth[1] >= done.depth[0])
    assert np.all(done.depth >= 0)


def test_the_factor_is_what_the_law_has_to_be_multiplied_by(done):
    law = replace(wear_law("usfd"), mild=5.3 * done.factor, catastrophic=0.0)
    scaled = small(law=law, field_rate=None)
    history = history_of(scaled, evolve(scaled))
    assert history.factor == 1.0
    # the steps end elsewhere: their error, far below a micrometre
    assert history.depth == pytest.approx(done.depth, abs=2e-7)


def test_growth_before_the_last_mileage_is_computed(done):
    unsteady = done.depth[0].max() / done.depth[1].max()
    assert 0.2 < unsteady < 0.3
    assert unsteady != pytest.approx(0.25, abs=1e-4)


def test_halved_steps_agree(done):
    fine = small(stepping=Stepping(2.5e-5, 1.25e-6))
    history = history_of(fine, evolve(fine))
    assert history.steps >= 2 * done.steps - 1
    assert history.factor == pytest.approx(done.factor, rel=0.03)
    # the coarse steps differ from their halves by no more
    assert history.depth == pytest.approx(done.depth, abs=done.simulation.stepping.error)


def test_the_seed_decides(done):
    rates = [next(iter(evolve(small(seed=seed)))).state.rate for seed in (1, 1, 2)]
    assert rates[1] == pytest.approx(rates[0], rel=1e-12, abs=0)
    assert abs(rates[2] - rates[0]).max() > 0.01 * rates[0].max()


def test_an_interrupted_run_goes_on_to_the_bit(tmp_path, done):
    simulation = small()
    first = Store.open(tmp_path, simulation.settings())
    killed = list(itertools.islice(evolve(simulation, first), 2))
    assert len(first.kept("run")) == 2 == len(killed)
    (tmp_path / "run" / "000099.npz.part").write_bytes(b"half a file")
    again = Store.open(tmp_path, simulation.settings())
    for progress in evolve(simulation, again):
        if progress.stage == "asked":
            break
    assert len(again.kept("asked")) == 1
    resumed = history_of(simulation, evolve(simulation, again))
    assert np.array_equal(resumed.depth, done.depth)
    assert np.array_equal(resumed.rates, done.rates)
    assert resumed.factor == done.factor


def test_a_folder_of_another_simulation_is_refused(tmp_path):
    Store.open(tmp_path, small().settings())
    other = small(seed=7, operation=Operation(friction=0.4))
    with pytest.raises(
        ValueError, match=r"operation.friction is 0.3 there and 0.4 here; seed is 1"
    ):
        Store.open(tmp_path, other.settings())
    with pytest.raises(ValueError, match=r"wheel\.name"):
        Store.open(tmp_path, small(wheel=packaged("LMA")).settings())


def test_a_damaged_or_missing_state_is_named(tmp_path):
    simulation = small()
    store = Store.open(tmp_path, simulation.settings())
    list(itertools.islice(evolve(simulation, store), 2))
    (tmp_path / "run" / "000000.npz").rename(tmp_path / "elsewhere.npz")
    with pytest.raises(ValueError, match="states are missing"):
        store.kept("run")
    (tmp_path / "run" / "000001.npz").write_bytes(b"no state")
    with pytest.raises(ValueError, match=r"000001.npz is no state"):
        store.kept("run")


def test_worn_profiles_can_be_searched(done):
    for mileage, wheel in done.profiles():
        contact = contact_geometry(wheel, packaged("CHN60"), trim=True)
        assert not contact.ended
        assert wheel.name == f"LMB10@{mileage:g}-usfd"


def test_the_table_holds_the_depths(done):
    frame = done.to_frame()
    assert frame["depth_mm_2"].max() == pytest.approx(0.11, rel=1e-8)
    summary = done.summary()
    assert summary["greatest_depth_mm"].tolist() == pytest.approx(done.depth.max(axis=1) * 1e3)
    removed = done.depth.sum(axis=1) * (done.y[1] - done.y[0]) * 1e6
    assert summary["removed_mm2"].tolist() == pytest.approx(removed.tolist())
    assert np.all(summary["band_from_mm"] < summary["at_mm"])
    text = done.to_csv()
    assert "calibration: the law times" in text
    assert '"friction": 0.3' in text


def test_rates_belong_to_the_depths(done):
    growth = (done.depth[1] - done.depth[0]).max() / (1.5 * MILEAGE)
    assert done.rates.max(axis=1) == pytest.approx(np.full(2, growth), rel=0.2)


def test_no_slip_no_wear_is_an_outcome():
    lawless = replace(wear_law("usfd"), mild=0.0, catastrophic=0.0)
    with pytest.raises(NoWear, match="usfd removes nothing"):
        list(evolve(small(law=lawless)))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"mileages": (2.0, 1.0)}, "ascending numbers, in 1e4 km"),
        ({"mileages": ()}, "ascending numbers"),
        ({"mileages": (0.0, 1.0)}, "first mileage = 0"),
        ({"field_rate": 55.0}, "field rate = 55 .* mm per 1e4 km"),
        ({"count": 4}, "count = 4"),
    ],
)
def test_what_is_out_of_range_is_named(changes, said):
    with pytest.raises(ValueError, match=said):
        small(**changes)
