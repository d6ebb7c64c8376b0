"""Conditions drawn from an operation: their distribution, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.wear.operation import Curve, Operation


def mean(conditions, values):
    return float((conditions.weight * values).sum())


def test_conditions_are_those_of_the_operation():
    operation = Operation()
    drawn = operation.draw(4096, 3)
    assert np.all(np.diff(drawn.y) >= 0)
    assert drawn.weight.sum() == pytest.approx(1.0)
    # quasi-random: a thousandth of the standard deviation
    assert mean(drawn, drawn.load) == pytest.approx(60e3, rel=2e-3)
    assert mean(drawn, drawn.y) == pytest.approx(0.0, abs=2e-5)
    straight = drawn.bend == 0
    assert drawn.weight[straight].sum() == pytest.approx(
        1 - sum(c.share for c in operation.curves), abs=2e-3
    )
    spread = np.sqrt(np.average(drawn.y[straight] ** 2, weights=drawn.weight[straight]))
    # cut at three standard deviations: 0.5 % less
    assert spread == pytest.approx(operation.displacement, rel=0.02)
    assert np.sqrt(mean(drawn, drawn.yaw**2)) == pytest.approx(operation.yaw, rel=0.02)


def test_curves_shift_the_wheelset_outward_to_both_sides():
    operation = Operation(curves=(Curve(0.5, 2000.0, 3e-3),))
    drawn = operation.draw(1024, 1)
    for sign in (1, -1):
        there = np.sign(drawn.bend) == sign
        assert drawn.weight[there].sum() == pytest.approx(0.25, abs=0.01)
        assert np.average(drawn.y[there], weights=drawn.weight[there]) == pytest.approx(
            sign * 3e-3, abs=2e-4
        )
        assert abs(drawn.bend[there]) == pytest.approx(np.full(there.sum(), 1 / 2000))


def test_rare_curves_are_drawn_more_often_than_they_are_run():
    operation = Operation(curves=(Curve(0.01, 2000.0, 3e-3),))
    drawn = operation.draw(1024, 1)
    bent = drawn.bend != 0
    assert bent.mean() > 0.05
    assert drawn.weight[bent].sum() == pytest.approx(0.01, abs=1e-3)


def test_the_same_seed_draws_the_same():
    one, again, other = (Operation().draw(64, seed) for seed in (5, 5, 6))
    assert all(
        np.array_equal(a, b) for a, b in zip(vars(one).values(), vars(again).values(), strict=True)
    )
    assert not np.array_equal(one.y, other.y)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Operation(speed=300.0), "speed = 300 is out of range; .* 1 and 150 m/s"),
        (lambda: Operation(load=60.0), "load = 60 .* N"),
        (lambda: Operation(displacement=2.0), "displacement = 2 .* m"),
        (lambda: Operation(friction=3.0), "friction = 3"),
        (lambda: Operation(difference_share=-0.1), "difference_share"),
        (lambda: Operation(curves=(Curve(0.7, 900.0, 0.0), Curve(0.6, 900.0, 0.0))), "shares"),
        (lambda: Curve(0.1, 5.0, 0.0), "radius = 5 .* 100 and 100000 m"),
        (lambda: Operation().draw(100, 1), "count = 100 is no power of two"),
    ],
)
def test_what_is_out_of_range_is_named(make, said):
    with pytest.raises(ValueError, match=said):
        make()
