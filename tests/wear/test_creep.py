"""Tangential contact: closed forms, symmetries, and the energy that has to go somewhere."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.wear.creep import CELLS, G, Slip, flexibilities, kalker, slide
from wheelset.wear.patch import find_patches

LOAD, RADIUS, MU = 60e3, 0.46, 0.3


def patch(curvature=4.0, count=161, gap=None):
    t = np.linspace(-0.012, 0.012, count)
    width = np.full(count, t[1] - t[0])
    gap = 0.5 * curvature * t**2 if gap is None else gap
    return find_patches(gap[None], t[None], width, RADIUS, LOAD), t


def slip_of(patches, xi_x=0.0, xi_y=0.0, phi=0.0, mu=MU, t=None):
    n = len(patches.row)
    across = -phi * t[patches.column] if t is not None else 0.0
    return Slip(np.full(n, xi_x) + across, np.full(n, xi_y), np.full(n, phi), mu)


def lost(patches, sliding):
    """Energy lost a metre rolled, by strips, N."""
    power = (sliding.traction * sliding.slip).sum(axis=0) * sliding.dx * patches.width
    return float(power.sum())


def test_kalkers_coefficients_are_those_of_his_table():
    # nu = 0.25 and 0.5 bracket 0.28, a/b = 1: 4.12..5.20, 3.67..3.98, 1.47..1.63
    C11, C22, C23 = kalker(1.0)
    assert 4.12 < C11 < 5.20
    assert 3.67 < C22 < 3.98
    assert 1.47 < C23 < 1.63
    assert kalker(50.0) == kalker(10.0)


@pytest.mark.parametrize("direction", [0, 1])
def test_small_creepage_gives_kalkers_slope(direction):
    patches, _ = patch()
    creepage = 1e-7
    slip = slip_of(patches, **{("xi_x", "xi_y")[direction]: creepage})
    sliding = slide(patches, slip, cells=200)
    a = patches.length[0]
    b = patches.area[0] / (np.pi * a)
    C = kalker(a / b)[direction]
    force = (sliding.Fx, sliding.Fy)[direction][0]
    # the patch of parabolas is an ellipse: the strips' sum is 8 a^2 b/(3 L), with L = 8a/(3 C G)
    assert force == pytest.approx(-G * a * b * C * creepage, rel=0.01)


def test_spin_alone_gives_kalkers_lateral_slope():
    patches, t = patch()
    phi = 1e-5
    sliding = slide(patches, slip_of(patches, phi=phi, t=t), cells=400)
    a = patches.length[0]
    b = patches.area[0] / (np.pi * a)
    C23 = kalker(a / b)[2]
    assert abs(sliding.Fy[0]) == pytest.approx(G * (a * b) ** 1.5 * C23 * phi, rel=0.02)
    assert abs(sliding.Fx[0]) < 1e-3 * abs(sliding.Fy[0])


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, -1.2])
def test_large_creepage_slides_everywhere(angle):
    patches, _ = patch()
    slip = slip_of(patches, xi_x=0.1 * np.cos(angle), xi_y=0.1 * np.sin(angle))
    sliding = slide(patches, slip, cells=200)
    force = np.hypot(sliding.Fx, sliding.Fy)[0]
    # the sum over the parabola by the cells' ends: 1 - 1/n^2
    assert force == pytest.approx(MU * LOAD, rel=1e-3)
    assert np.arctan2(-sliding.Fy[0], -sliding.Fx[0]) == pytest.approx(angle, abs=1e-3)


@pytest.mark.parametrize("seed", range(4))
def test_no_more_than_friction_allows(seed):
    r = np.random.default_rng(seed)
    patches, t = patch(gap=np.abs(np.cumsum(np.cumsum(r.normal(0, 3e-8, 161)))))
    slip = slip_of(patches, *(r.normal(0, 2e-3, 2)), r.normal(0, 0.5), t=t)
    sliding = slide(patches, slip)
    assert np.hypot(sliding.Fx, sliding.Fy)[0] <= MU * LOAD * (1 + 1e-12)
    strip = sliding.traction.sum(axis=0) * sliding.dx
    carried = 0.5 * np.pi * patches.scale * patches.a**2
    assert np.all(strip <= MU * carried * (1 + 1e-12))
    assert np.isfinite(sliding.slip).all()


def test_mirrored_creepages_give_mirrored_forces():
    patches, t = patch()
    one = slide(patches, slip_of(patches, 8e-4, 5e-4, 0.2, t=t))
    other = slide(patches, slip_of(patches, 8e-4, -5e-4, -0.2, t=t))
    assert other.Fx[0] == pytest.approx(one.Fx[0], rel=1e-10)
    assert other.Fy[0] == pytest.approx(-one.Fy[0], rel=1e-10)


def test_the_way_slid_through_a_strip_is_that_of_the_rigid_slip():
    patches, _ = patch()
    sliding = slide(patches, slip_of(patches, xi_x=6e-4))
    # traction is nothing at both ends, so that elastic slip adds up to nothing
    slid = sliding.slip.sum(axis=0) * sliding.dx
    assert slid == pytest.approx(2 * patches.a * 6e-4, rel=1e-9)


@pytest.mark.parametrize(
    ("xi_x", "xi_y", "phi"),
    [(6e-4, 0, 0), (0, 1e-3, 0), (4e-4, -7e-4, 0), (0, 0, 0.3), (3e-4, 2e-4, 0.15)],
)
def test_energy_lost_is_that_of_forces_and_creepages(xi_x, xi_y, phi):
    patches, t = patch()
    slip = slip_of(patches, xi_x, xi_y, phi, t=t)
    cells = 32
    sliding = slide(patches, slip, cells)
    x = patches.a * (1 - (np.arange(cells)[:, None] + 0.5) / cells * 2)
    power = -(sliding.tau_x * slip.xi_x + sliding.tau_y * (slip.xi_y + slip.phi * x))
    given = float((power.sum(axis=0) * sliding.dx * patches.width).sum())
    assert given > 0
    # exact in every cell but for the turn of a traction within it
    assert lost(patches, sliding) == pytest.approx(given, rel=5e-3)


@pytest.mark.parametrize(
    "creepages", [(6e-4, 0, 0), (0, 1e-3, 0), (1e-4, 0, 0), (4e-4, 3e-4, 0.15)]
)
def test_the_energy_converges_with_the_cells(creepages):
    patches, t = patch()
    slip = slip_of(patches, *creepages, t=t)
    energies = [lost(patches, slide(patches, slip, cells)) for cells in (CELLS, 4 * CELLS, 768)]
    errors = [abs(e / energies[-1] - 1) for e in energies[:2]]
    assert errors[0] < 0.02  # least slip, in few cells, is the worst
    assert errors[1] < 0.5 * errors[0] + 1e-4


def test_no_creepage_no_traction():
    patches, _ = patch()
    sliding = slide(patches, slip_of(patches))
    assert not sliding.traction.any()
    assert not sliding.slip.any()


def test_flexibilities_reproduce_the_linear_theory():
    a, b = np.array([6e-3]), np.array([4e-3])
    L1, L2, L3 = flexibilities(a, b)
    C11, C22, C23 = kalker(a / b)
    assert 8 * a**2 * b / (3 * L1) == pytest.approx(G * a * b * C11)
    assert 8 * a**2 * b / (3 * L2) == pytest.approx(G * a * b * C22)
    assert np.pi * a**3 * b / (4 * L3) == pytest.approx(G * (a * b) ** 1.5 * C23)
