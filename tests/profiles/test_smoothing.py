"""Smoothing: exact without noise, and better than the measurement with it."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.profiles import contact_geometry, equivalent_conicity, packaged, profile_from_points
from wheelset.profiles.smoothing import smoothed


def noisy(name, spacing, noise, seed=0):
    y, z = packaged(name).points(spacing)
    return y, z + noise * np.random.default_rng(seed).standard_normal(len(z))


@pytest.mark.parametrize("how", ["gcv", "none"])
def test_exact_points_are_kept(how):
    y, z = noisy("LMB10", 4e-4, 0.0)
    curve, words = smoothed(y, z, how)
    at = np.linspace(-0.025, 0.025, 101)
    assert curve(at) == pytest.approx(packaged("LMB10").z(at), abs=1e-7)
    assert "smoothed" in words


@pytest.mark.parametrize("how", ["gcv", 5e-6])
@pytest.mark.parametrize("name", ["LMB10", "S1002", "60E1"])
def test_noise_of_5_micrometres_is_taken_away(name, how):
    curve, _ = smoothed(*noisy(name, 5e-4, 5e-6), how)
    profile = packaged(name)
    at = np.linspace(-0.02, 0.02, 401)
    off = curve(at) - profile.z(at)
    slope = curve(at, 1) - profile.slope(at)
    # the noise has 5 um; 80 points on a smoothed length of some 8 mm leave less than a half
    assert np.sqrt(np.mean((off - off.mean()) ** 2)) < 3e-6
    # a spline through the points would have 5 um / 0.5 mm = 1e-2
    assert np.sqrt(np.mean(slope**2)) < 4e-3


def test_a_stated_noise_is_the_residual():
    y, z = noisy("LMB10", 5e-4, 1e-5)
    residual = smoothed(y, z, 1e-5)[0](y) - z
    tread = abs(y) < 0.02
    assert np.std(residual[tread]) == pytest.approx(1e-5, rel=0.2)
    with pytest.raises(ValueError, match=r"noise = 0\.1 m is out of range"):
        smoothed(y, z, 0.1)


def test_conicity_survives_resampling():
    rail = packaged("CHN60")
    found = []
    for spacing in (3e-4, 5e-4):
        y, z = packaged("LMB10").points(spacing)
        wheel = profile_from_points("again", "wheel", y, z)
        found.append(
            equivalent_conicity(contact_geometry(wheel, rail, trim=True), 3e-3).integration
        )
    exact = equivalent_conicity(contact_geometry(packaged("LMB10"), rail), 3e-3).integration
    assert found == pytest.approx([exact] * 2, abs=5e-4)
