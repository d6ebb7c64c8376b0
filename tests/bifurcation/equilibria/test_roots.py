"""Every root in a window, also the close pairs that a grid of signs would miss."""

from __future__ import annotations

import math

import numpy as np
import pytest

from wheelset.bifurcation.equilibria.roots import roots_in
from wheelset.bifurcation.outcomes import NoConvergence


def test_all_roots_of_a_sine():
    expected = [k * math.pi for k in range(1, 31)]
    np.testing.assert_allclose(roots_in(math.sin, 1.0, 95.0), expected, rtol=1e-13)


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-5])
def test_a_close_pair_is_not_missed(gap):
    roots = roots_in(lambda x: (x - 0.3) * (x - 0.3 - gap) * (1 + x**2), 0.0, 1.0)
    np.testing.assert_allclose(roots, [0.3, 0.3 + gap], atol=1e-11)


def test_roots_at_both_scales_of_a_stiff_function():
    roots = roots_in(lambda v: (1 / v - 0.1) * (v - 400) * (1 / v**2 - 1 / 50**2), 5.0, 500.0)
    np.testing.assert_allclose(roots, [10.0, 50.0, 400.0], rtol=1e-12)


def test_no_root():
    assert roots_in(lambda x: 1 + x**2, -3.0, 3.0) == ()


def test_a_jump_is_an_outcome():
    with pytest.raises(NoConvergence, match=r"test function near 0\.3"):
        roots_in(lambda x: 1.0 if x > 0.3 else 2.0, 0.0, 1.0)
