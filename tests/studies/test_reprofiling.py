"""Re-profiling: the shortcuts of the samples against wheels that go the whole way alone."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.hunting import hunting_system
from wheelset.profiles import SplineGeometry, packaged, profile_from_points, smoothing
from wheelset.profiles.functions import smooth_spline
from wheelset.profiles.worn import worn, worn_profiles
from wheelset.studies import reprofiling, reprofiling_advice, reprofiling_noise
from wheelset.studies.on_profiles import on_profiles, reach_of, searched
from wheelset.studies.reprofiling_campaigns import (
    Plan,
    campaigns,
    case,
    cases,
    sampled,
    unmeasured,
    workers,
)
from wheelset.studies.reprofiling_contact import averaging
from wheelset.studies.reprofiling_noise import Measurement, aligned
from wheelset.vehicle import load_vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

RAIL, MILEAGE, COLUMN = packaged("CHN60"), 4.8, 1
PLAN = Plan(
    load_vehicle("guo2021_physical"), RAIL, (10.0, 200.0), 5e-4, 1.5, Measurement(), seed=7
)  # fmt: skip


@cache
def wheel():
    return worn_profiles("archard_kth")[MILEAGE]


@cache
def known():
    return case(PLAN, MILEAGE, wheel())


def bump(height, at=-0.002, width=0.004):
    """A little more wear: the worn wheel and what is off in z, dz/du, d2z/du2 at the places."""
    y = np.arange(-0.035, 0.025, 2e-4)
    profile = worn(wheel(), y, height * np.exp(-0.5 * ((y - at) / width) ** 2))
    u = known().beside.u
    return profile, np.array([profile.curve(u, k) - wheel().curve(u, k) for k in range(3)])


def close_to(contact, y):
    """Displacements without a jump of the contact beside them."""
    jumps = np.array([jump.y for jump in contact.jumps])
    return np.array([not len(jumps) or abs(jumps - at).min() > 3e-4 for at in y])


def test_a_smoothed_sample_is_the_smoothed_profile(monkeypatch):
    monkeypatch.setattr(smoothing, "gcv_weight", lambda t, z: 20.0)
    monkeypatch.setattr(reprofiling_noise, "gcv_weight", lambda t, z: 20.0)
    new = packaged("LMB10")
    u = np.linspace(-0.012, 0.02, 300)
    smoother = reprofiling_noise.smoother(new, u, Measurement())
    y, z = new.points(2e-4)
    noise = 5e-6 * np.random.default_rng(1).standard_normal(len(y))
    off = smoother.deviations(noise[np.newaxis])[:, 0]
    alone = profile_from_points("alone", "wheel", y, z + noise)
    # the contour along which it smooths alone is that of its noisy points
    for k, within in enumerate((1e-8, 1e-5, 1e-2)):
        assert abs(alone.curve(u, k) - new.curve(u, k) - off[k]).max() < within
    assert abs(off[0]).max() > 1e-6


def test_a_deviation_moves_the_contact_as_a_search_finds_it():
    profile, off = bump(4e-6)
    found, inside = known().beside.functions(off[:, np.newaxis])
    y = known().beside.y
    contact = searched(profile, RAIL, PLAN.vehicle)
    same = close_to(contact, y) & close_to(searched(wheel(), RAIL, PLAN.vehicle), y)
    r = np.interp(y, contact.y, contact.left.r - np.interp(0, contact.y, contact.left.r))
    assert inside.all()
    assert same.mean() > 0.8
    # where the contact travels fast a few hundredths of a millimetre of y are micrometres of r
    assert np.quantile(abs(found[0, 0] - r)[same], 0.9) < 1e-7
    assert abs(found[0, 0] - r)[same].max() < 3e-6
    assert np.median(abs(found[0, 1] - np.interp(y, contact.y, contact.left.delta))[same]) < 1e-6
    assert np.median(abs(found[0, 2] - np.interp(y, contact.y, contact.left.rho))[same]) < 1e-2


def test_averages_are_those_of_the_model():
    y = np.linspace(-0.005, 0.005, 81)
    values = np.tanh(y / 1e-3) + y**2
    average = averaging(y, 0.004, 5e-4)
    at = np.linspace(-0.004, 0.004, 23)
    exact = smooth_spline(y, values, 0.004, 5e-4).taylor(at, 3)
    for k, factor in enumerate((1, 1, 2, 6)):
        assert average(at, k) @ values == pytest.approx(factor * exact[:, k], rel=1e-7, abs=1e-7)


def test_the_wheel_itself_has_the_speeds_of_the_whole_way():
    row = unmeasured(PLAN, known()).iloc[0]
    # kinks of the worn wheel between places cost a few hundredths
    assert row["v_lin"] == pytest.approx(known().row["v_lin"], abs=0.1)
    assert row["v_non"] == pytest.approx(known().row["v_non"], rel=1e-9)


def test_a_fold_moves_by_the_adjoint_as_it_does_when_followed_anew():
    profile, off = bump(4e-6)
    functions, _ = known().beside.functions(off[:, np.newaxis])
    fold = known().folds[-1]
    (predicted,) = fold.speeds(functions - known().functions)
    anew = on_profiles(PLAN.vehicle, searched(profile, RAIL, PLAN.vehicle), PLAN.window)
    followed = min((float(f.values[0]) for f in anew.folds), key=lambda v: abs(v - predicted))
    assert abs(followed - fold.speed) > 0.05
    assert predicted - fold.speed == pytest.approx(followed - fold.speed, rel=0.1, abs=0.02)


def test_stiffer_springs_raise_the_fold_by_the_power():
    stiff = PLAN.vehicle.with_overrides({"Kpx": 1.1e6, "Kpy": 1.1e6})
    fold = known().folds[-1]
    contact = searched(wheel(), RAIL, PLAN.vehicle)
    expected = fold.speed * 1.1**fold.power
    folds = [float(f.values[0]) for f in on_profiles(stiff, contact, PLAN.window).folds]
    anew = min(folds, key=lambda v: abs(v - expected))
    assert anew / fold.speed - 1 == pytest.approx(1.1**fold.power - 1, rel=0.05)


def test_samples_do_not_depend_on_their_company():
    together = sampled(PLAN, known(), 0, 6, COLUMN)
    alone = sampled(PLAN, known(), 3, 3, COLUMN)
    for speed in ("v_lin", "v_limit", "v_non"):
        assert together[speed][3:].to_numpy() == pytest.approx(alone[speed].to_numpy(), rel=1e-10)
        assert together[speed].nunique() == 6
    other = sampled(PLAN, known(), 3, 3, COLUMN + 1)
    assert abs(other["v_lin"] - alone["v_lin"]).min() > 1e-6


def test_an_alignment_is_a_shift_and_a_turn():
    u = np.linspace(-0.01, 0.02, 31)
    z, slope, bend = aligned(wheel(), u, 1e-4, 2e-3)
    assert z == pytest.approx(wheel().z(u - 1e-4) - wheel().z(u) + 2e-3 * u, abs=1e-12)
    assert slope == pytest.approx(wheel().slope(u - 1e-4) - wheel().slope(u) + 2e-3, abs=1e-9)
    assert bend.shape == u.shape
    assert not aligned(wheel(), u, 0.0, 0.0).any()


def test_noise_falls_with_the_root_of_the_repeats():
    once, often = Measurement(), Measurement(repeats=16)
    draws = [m.drawn(np.random.default_rng(5), 4000)[0] for m in (once, often)]
    assert draws[1] == pytest.approx(draws[0] / 4)
    assert np.std(draws[0]) == pytest.approx(once.noise, rel=0.05)


def test_mileages_at_which_speeds_fall_too_low():
    speeds = np.array(
        [[80, 70, 60], [50, 60, 70], [90, 80, 70], [80, np.nan, 50], [80, 60, 80]], dtype=float
    )
    at, outcomes = reprofiling_advice.exhausted(np.array([0.0, 4.0, 8.0]), speeds, 65.0)
    assert outcomes == ["within", "from the start", "not in the series", "not computed", "within"]
    assert at[[0, 4]] == pytest.approx([6.0, 3.0])
    assert np.isnan(at[[1, 2, 3]]).all()


def test_percentiles_know_what_lies_beyond_the_series():
    at = np.array([np.nan, 2.0, 3.0, 4.0, np.nan, np.nan])
    became = ["from the start", *["within"] * 3, "not in the series", "not computed"]
    assert reprofiling_advice.percentiles(at, became) == [0.0, 3.0, None]
    assert reprofiling_advice.percentiles(at[-1:], became[-1:]) == [None, None, None]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0=LMB10", "give two or more"),
        ("0=LMB10, x=LMA", "is not mileage=wheel"),
        ("0=LMB10, 0=LMA", "a mileage of its own"),
        ("0=LMB10, 5=CHN60", "a wheel is wanted"),
        ("0=LMB10, 5=nobody.whl", "nobody.whl"),
    ],
)
def test_wheels_of_your_own_are_checked(text, said):
    with pytest.raises(ValueError, match=said):
        reprofiling.Parameters(measured=text)


def test_wheels_of_your_own_take_the_place_of_the_simulated_ones():
    p = reprofiling.Parameters(measured="5=LMA, 0=LMB10")
    assert {m: w.name for m, w in p.wheels.items()} == {0.0: "LMB10", 5.0: "LMA"}
    assert len(reprofiling.Parameters(resolution="quick").wheels) == 4


@pytest.mark.slow
def test_samples_against_wheels_that_go_the_whole_way_alone():
    samples = sampled(PLAN, known(), 0, 12, COLUMN)
    y, z = wheel().points(PLAN.measurement.spacing)
    alone = []
    for k in range(12):
        seed = np.random.SeedSequence(PLAN.seed, spawn_key=(k, COLUMN))
        noise, _, _ = PLAN.measurement.drawn(np.random.default_rng(seed), len(y))
        contact = searched(
            profile_from_points("alone", "wheel", y, z + noise), RAIL, PLAN.vehicle
        )  # fmt: skip
        geometry = SplineGeometry.of(contact, reach_of(contact), PLAN.width)
        system = hunting_system(PLAN.vehicle, ExpandedGeometry(geometry.functions))
        alone.append(hopf_point(system, "v", samples["v_lin"][k]).value)
    off = np.array(alone) - samples["v_lin"].to_numpy()
    # each alone chooses its own weight: alike in the mean, and within the scatter one by one
    assert abs(off.mean()) < 0.6
    assert np.sqrt(np.mean(off**2)) < 1.5 * np.std(alone)


@pytest.mark.slow
def test_results_do_not_depend_on_the_number_of_processes():
    wheels = {0.0: packaged("LMB10"), MILEAGE: wheel()}
    tables = []
    for count in (1, 2):
        with workers(count) as pool:
            tables.append(campaigns(PLAN, cases(PLAN, wheels, pool), 5, pool))
    one, two = tables
    assert one[["sample", "mileage", "words"]].equals(two[["sample", "mileage", "words"]])
    for speed in ("v_lin", "v_limit", "v_non"):
        assert one[speed].to_numpy() == pytest.approx(two[speed].to_numpy(), rel=1e-9)


@pytest.mark.slow
def test_advice_is_made_of_counted_outcomes():
    p = reprofiling.Parameters(
        measured="0=LMB10, 4.8=LMB10@4.8-archard_kth", samples=10, processes=1,
        v_nonlinear=55.0, v_linear=60.0, resolution="quick",
    )  # fmt: skip
    found = reprofiling.found(p)
    table = reprofiling_advice.advice_table(p, found).set_index("criterion")
    counts = table[["within", "not in the series", "from the start", "not computed"]]
    assert (counts.sum(axis=1) == 10).all()
    assert table.loc["Hopf speed", "not in the series"] == 10
    fold = table.loc["nonlinear critical speed"]
    assert fold["within"] == 10
    assert 0 < fold["low"] <= fold["median"] <= fold["high"] < 4.8
    sentences = reprofiling_advice.advice(p, found)
    assert "kept up to 48\N{NO-BREAK SPACE}000 km" in sentences[0]
    assert f"exhausted at {reprofiling_advice.kilometres(fold['median'])}" in sentences[1]
    row = reprofiling.speeds(p, found).iloc[0]
    factor = row["stiffness_lin"]
    soft = PLAN.vehicle.with_overrides({"Kpx": 1e6 * factor, "Kpy": 1e6 * factor})
    run = on_profiles(soft, searched(packaged("LMB10"), RAIL, soft), PLAN.window)
    assert run.hopf.value == pytest.approx(60.0, abs=0.05)
