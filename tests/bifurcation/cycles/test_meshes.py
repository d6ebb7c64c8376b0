"""Meshes of collocation: what moves from one to another, what is shared, and equal shares.

Tolerances are some rounding errors of the polynomials' values, which are of order one.
"""

from functools import cached_property

import numpy as np
import pytest

from tests.exact_systems import van_der_pol
from wheelset.bifurcation.cycles import meshes
from wheelset.bifurcation.cycles.collocation import Collocation
from wheelset.bifurcation.cycles.floquet import Floquet

EQUAL, WARPED = np.full(6, 1 / 6), np.array([0.1, 0.3, 0.2, 0.15, 0.2, 0.05])


def collocation(h):
    return Collocation(van_der_pol(1.0), np.ones(2), ("mu",), h, -np.ones(2), True, np.ones(2))


def at_nodes(space, f):
    """A vector of unknowns with the values of a function (..., 2) of the phase."""
    at = space.mesh[:-1, np.newaxis] + space.h[:, np.newaxis] * space.rule.c
    return space.join(f(space.mesh), f(at), 0.7, np.array([1.0]))


def polynomials(coefficients, s):
    """Two polynomials (5, 2) at s, on a last axis."""
    return np.moveaxis(np.polynomial.polynomial.polyval(s, coefficients), 0, -1)


@pytest.mark.parametrize("h", [WARPED, np.full(9, 1 / 9)])
def test_polynomials_are_the_same_on_another_mesh(h):
    coefficients = np.random.default_rng(1).normal(size=(3, 5, 2))
    old, new = collocation(EQUAL), collocation(h)
    given, expected = (
        np.array([at_nodes(space, lambda s, a=a: polynomials(a, s)) for a in coefficients])
        for space in (old, new)
    )
    found = meshes.moved(old, new, given)
    np.testing.assert_allclose(found, expected, atol=1e-12)
    for one, row in zip(given, found, strict=True):
        np.testing.assert_array_equal(meshes.moved(old, new, one), row)


@pytest.mark.parametrize("count", [6, 11])
def test_every_interval_gets_the_same_share(count):
    """Against numpy's interpolation of the integrated density."""
    space = collocation(WARPED)
    orbit = space.split(at_nodes(space, lambda s: np.stack([np.cos(3 * s), np.exp(-9 * s)], -1)))
    jumps = meshes._derivative(orbit.nodes, space.h, space.rule.highest, space.signs, space.scales)
    density = jumps**0.2
    density += meshes.FLOOR * density @ space.h
    share = np.append(0.0, np.cumsum(density * space.h))
    ends = np.interp(np.linspace(0.0, share[-1], count + 1), share, space.mesh)
    found = meshes.equidistributed(space, orbit, count)
    np.testing.assert_allclose(found, np.diff(ends), atol=1e-14)


@pytest.mark.parametrize("h", [WARPED, np.full(9, 1 / 9)])
def test_what_meshes_share_is_what_each_would_find(h):
    names = [name for name, kind in vars(Collocation).items() if isinstance(kind, cached_property)]
    old, fresh = collocation(EQUAL), collocation(h)
    for name in names:
        getattr(old, name)
    moved = old.on(h)
    for name in set(names) - {"_kernel", "_second"}:
        np.testing.assert_equal(getattr(moved, name), getattr(fresh, name), err_msg=name)


@pytest.mark.parametrize("critical", [0.0, 1.0, -1.0])
def test_what_is_watched_are_products_over_multipliers(critical):
    values = np.array([1.001, 0.98 + 0.3j, 0.98 - 0.3j, -0.97, 0.4])
    rest = [value for value in values if value != 1.001]
    paired = [v for v in rest if v != {1.0: 0.98 + 0.3j, -1.0: -0.97}.get(critical)]
    pairs = np.array([a * b for i, a in enumerate(paired) for b in paired[:i]])
    expected = (
        0.001,
        np.prod([(v - 1) / (1 + abs(v)) for v in rest]).real,
        np.prod([(v + 1) / (1 + abs(v)) for v in values]).real,
        np.prod((pairs - 1) / (1 + np.abs(pairs))).real,
    )
    floquet = Floquet(values, half=False)
    found = floquet.watched_beside(critical) if critical else floquet.watched
    np.testing.assert_allclose(found, expected, rtol=1e-12)
