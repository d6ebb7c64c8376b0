"""Wear of a wheel under its conditions: symmetry, scaling, and what a cone must do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from wheelset.profiles import Setup, packaged
from wheelset.profiles.curves import PiecewiseCurve, SplineCurve
from wheelset.wear.creep import slide
from wheelset.wear.errors import ContactLost
from wheelset.wear.laws import USFD
from wheelset.wear.operation import Conditions, Operation
from wheelset.wear.rolling import Rolling, Strips, Touching

SETUP = Setup()
RAIL = SETUP.laid(packaged("CHN60"))
WHEEL = packaged("LMB10")


def conditions(y=(0.0,), load=60e3, yaw=0.0, traction=0.0, bend=0.0):
    y = np.atleast_1d(np.asarray(y, float))
    every = [np.broadcast_to(np.asarray(v, float), y.shape) for v in (load, yaw, traction, bend)]
    return Conditions(y, *every, np.full(len(y), 1 / len(y)))


def rolling(drawn, strips=None, law=None, share=1.0):
    return Rolling(RAIL, SETUP, drawn, law or USFD(), strips or Strips(), 80.0, 0.3, share)


def test_wear_is_where_the_wheel_touches():
    one = rolling(conditions([0.003]), Strips(smoothing=5e-4))
    rate, y = one.rate(WHEEL), one.strips.y
    contact = Touching.of(one, WHEEL)
    middle = (rate * y).sum() / rate.sum()
    assert middle == pytest.approx(contact.u[0], abs=4e-3)
    assert np.all(rate >= 0)
    patch = contact.patches(one.strips)
    worn = y[rate > 1e-3 * rate.max()]
    assert worn[0] >= y[patch.column.min()] - 4e-3
    assert worn[-1] <= y[patch.column.max()] + 4e-3


def test_conditions_add_up_by_their_weights():
    apart = [rolling(conditions([y], traction=1e-3)).rate(WHEEL) for y in (-0.002, 0.004)]
    both = rolling(conditions([-0.002, 0.004], traction=1e-3)).rate(WHEEL)
    assert both == pytest.approx(0.5 * (apart[0] + apart[1]), rel=1e-9, abs=1e-20)


def test_two_conditions_of_one_displacement_are_two():
    twice = rolling(conditions([0.001, 0.001], traction=[1e-3, -1e-3]))
    apart = [rolling(conditions([0.001], traction=t)).rate(WHEEL) for t in (1e-3, -1e-3)]
    assert twice.rate(WHEEL) == pytest.approx(0.5 * (apart[0] + apart[1]), rel=1e-9, abs=1e-20)


def test_mass_lost_is_energy_lost_in_the_mild_regime():
    """Below its first limit USFD takes 5.3 ug/m/mm2 for 1 N/mm2: 5.3e-9 kg for a joule."""
    strips = Strips(smoothing=5e-4)
    one = rolling(conditions([0.002], traction=2e-4, yaw=1e-4), strips)
    touching = Touching.of(one, WHEEL)
    patches = touching.patches(strips)
    slip = touching.slip(one, patches)
    sliding = slide(patches, slip, one.cells)
    cell = (np.arange(one.cells)[:, None] + 0.5) * sliding.dx
    lateral = slip.xi_y + slip.phi * (patches.a - cell)
    given = -(sliding.tau_x * slip.xi_x + sliding.tau_y * lateral)
    power = float((given.sum(axis=0) * sliding.dx * patches.width).sum())
    # vertical depth on a strip's width in y is normal depth on its width along the profile
    around = 2 * np.pi * (SETUP.r0 + touching.z) * strips.spacing
    mild = replace(one, law=replace(one.law, first_limit=1e9, second_limit=2e9))
    removed = float((mild.rate(WHEEL) * around).sum() * 7850)
    # exact in every cell but for the turn of the traction within it
    assert removed == pytest.approx(5.3e-9 * power, rel=5e-3)


def test_a_measured_wheel_may_end_within_the_strips():
    y = np.linspace(-0.038, 0.040, 3121)
    short = replace(WHEEL, curve=SplineCurve.through(y, WHEEL.z(y)))
    one = rolling(Operation(displacement=1e-3).draw(8, 1))
    # the spline rounds the joints of the arcs over some 0.025 mm
    assert one.rate(short) == pytest.approx(one.rate(WHEEL), abs=5e-3 * one.rate(WHEEL).max())


def test_steering_reduces_the_slip():
    drawn = conditions([-0.003, 0.003])
    stiff, free = (rolling(drawn, share=share).rate(WHEEL).sum() for share in (1.0, 0.0))
    assert free < 0.5 * stiff


def test_a_curve_that_the_radius_difference_fits_wears_least():
    y = 0.003
    touching = Touching.of(rolling(conditions([y])), WHEEL)
    dr = 2 * (touching.r - touching.mean_r)[0]
    fitting = dr / (SETUP.base * SETUP.r0)
    wear = [
        rolling(conditions([y], bend=bend)).rate(WHEEL).sum() for bend in (0.0, fitting, -fitting)
    ]
    assert wear[1] < wear[0] < wear[2]


def test_more_load_more_friction_more_wear():
    light, heavy = (
        rolling(conditions([0.002], load=load, traction=1e-3)).rate(WHEEL).sum()
        for load in (50e3, 70e3)
    )
    assert heavy > light


def test_finer_strips_change_little():
    drawn = Operation().draw(32, 1)
    coarse, fine = Strips(spacing=5e-4), Strips(spacing=1.25e-4)
    rates = [rolling(drawn, strips).rate(WHEEL) for strips in (coarse, fine)]
    there = np.interp(coarse.y, fine.y, rates[1])
    assert abs(rates[0] - there).max() < 0.02 * there.max()


def test_smoothing_keeps_what_is_removed():
    drawn = Operation().draw(16, 2)
    sums = [rolling(drawn, Strips(smoothing=w)).rate(WHEEL).sum() for w in (1e-3, 4e-3)]
    assert sums[0] == pytest.approx(sums[1], rel=1e-6)


def test_displacements_without_contact_are_an_outcome():
    whole = WHEEL.curve
    cut = PiecewiseCurve((-0.030, *whole.joints[5:]), whole.pieces[4:])
    with pytest.raises(ContactLost, match=r"50\.0% of the distance .* narrow the displacements"):
        rolling(conditions([0.0, 0.011])).rate(replace(WHEEL, curve=cut))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"spacing": 1e-2}, "spacing = 0.01"),
        ({"smoothing": 1e-4}, "smoothing = 0.0001 .* between 0.0005"),
        ({"last": -0.04}, "last"),
    ],
)
def test_strips_out_of_range_are_named(values, said):
    with pytest.raises(ValueError, match=said):
        Strips(**values)
