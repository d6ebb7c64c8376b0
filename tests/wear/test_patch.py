"""Normal contact: against Hertz by elliptic integrals, and by what must hold for any patch."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from wheelset.wear.errors import PatchNotFound
from wheelset.wear.patch import NU, E, find_patches

LOAD, RADIUS = 60e3, 0.46


def strips(half=0.02, count=801):
    t = np.linspace(-half, half, count)
    return t, np.full(count, t[1] - t[0])


def hertz(curvature, load=LOAD):
    """Semi-axes along and across, largest pressure and approach; Johnson, Contact Mechanics."""
    A, B = 1 / (2 * RADIUS), curvature / 2
    low, high = sorted((A, B))

    def miss(log_e2):
        e2 = 1 - np.exp(log_e2)  # e2 = 1 - (b/a)^2
        k2 = 1 - e2
        return high / low - (ellipe(e2) / k2 - ellipk(e2)) / (ellipk(e2) - ellipe(e2))

    e2 = 1 - np.exp(brentq(miss, -12, -1e-9))
    stiff = E / (2 * (1 - NU**2))
    # A = p0 / (E* e2) b/a^2 (K - E), p0 = 3 N / (2 pi a b), a the longer axis
    long = np.cbrt(3 * load / (2 * np.pi * stiff * e2 * low) * (ellipk(e2) - ellipe(e2)))
    short = long * np.sqrt(1 - e2)
    p0 = 3 * load / (2 * np.pi * long * short)
    delta = p0 / stiff * short * ellipk(e2)
    along, across = (long, short) if low == A else (short, long)
    return along, across, p0, delta


def patch_of(curvature, load=LOAD):
    t, width = strips()
    return find_patches(0.5 * curvature * t[None] ** 2, t[None], width, RADIUS, load)


@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.9, 2.0, 5.0])
def test_circular_profiles_are_near_hertz(ratio):
    """The known error of the method, for A/B from 5 to 1/5, is bounded here."""
    curvature = 1 / RADIUS / ratio
    along, across, p0, delta = hertz(curvature)
    patch = patch_of(curvature)
    assert 1.06 < patch.area[0] / (np.pi * along * across) < 1.115
    assert 0.90 < (patch.scale * patch.a).max() / p0 < 0.945
    assert 0.965 < patch.delta[0] / delta < 0.98
    assert patch.length[0] == pytest.approx(along, rel=0.20)


def test_the_axis_ratio_is_that_of_the_interpenetration():
    curvature = 5.0
    patch = patch_of(curvature)
    width = patch.width.sum() / 2
    assert patch.length[0] / width == pytest.approx(np.sqrt(curvature * RADIUS), rel=0.01)


def test_the_load_is_carried_and_hertz_power_holds():
    loads = np.array([20e3, 40e3, 80e3])
    t, width = strips()
    gap = np.broadcast_to(2.0 * t**2, (3, len(t)))
    patch = find_patches(gap, np.broadcast_to(t, gap.shape), width, RADIUS, loads)
    assert patch.load == pytest.approx(loads, rel=1e-10)
    # N ~ delta^1.5 of parabolas; strips of 0.05 mm leave 1e-3
    assert np.log(patch.delta[2] / patch.delta[0]) == pytest.approx(np.log(4) / 1.5, rel=2e-3)


def test_finer_strips_change_little():
    found = []
    for count in (81, 161, 1281):
        t, width = strips(count=count)
        found.append(find_patches(4 * t[None] ** 2, t[None], width, RADIUS, LOAD))
    errors = [abs(p.delta[0] / found[-1].delta[0] - 1) for p in found[:2]]
    assert errors[0] < 5e-3  # strips of 0.5 mm under a patch of 7 mm
    assert errors[1] < 2e-3


def test_a_contact_beside_the_strips_middles_is_the_same():
    t, width = strips(count=161)
    gaps = [4 * (t - shift) ** 2 for shift in (0.0, 6e-5, 1.25e-4)]
    there = np.array([t - shift for shift in (0.0, 6e-5, 1.25e-4)])
    patch = find_patches(np.array(gaps), there, width, RADIUS, LOAD)
    assert patch.delta == pytest.approx(np.full(3, patch.delta[0]), rel=2e-3)


def test_two_points_of_contact_are_two_groups_of_strips():
    t, width = strips()
    gap = np.minimum(20 * t**2, 20 * (t - 0.012) ** 2 + 5e-6)
    patch = find_patches(gap[None], t[None], width, RADIUS, LOAD)
    place = t[patch.column]
    assert np.diff(place).max() > 1e-3
    assert patch.load[0] == pytest.approx(LOAD, rel=1e-10)
    assert place.max() > 0.012


def test_a_flat_contact_spreads_the_load():
    t, width = strips(half=0.01, count=201)
    gap = np.where(abs(t) < 8e-3, 0.0, 1e-3)
    patch = find_patches(gap[None], t[None], width, RADIUS, LOAD)
    assert np.ptp(patch.a) < 1e-15
    assert np.isfinite(patch.scale).all()


def test_a_load_that_no_strip_can_carry_is_an_outcome():
    t, width = strips(half=0.01, count=5)
    with pytest.raises(PatchNotFound, match="no contact patch carries 9e"):
        find_patches(0 * t[None] + 2.9e-4, t[None], width, RADIUS, 9e9)
