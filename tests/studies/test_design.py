"""What follows for a designer: against exact forms, integration, and speeds computed anew."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.exact_systems import bautin
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.studies import design, design_gap, design_sensitivity, design_threshold

P = design.Parameters(resolution="quick")


@cache
def reading():
    return design.readings(P)[0]


@cache
def table():
    return design_sensitivity.sensitivities(reading())


def test_both_readings_have_both_speeds_and_a_gap():
    speeds = design.critical_speeds(design.readings(P))
    assert list(speeds["reading"]) == ["paper-consistent", "physical"]
    assert (speeds["gap"] > 0).all()


def test_derivatives_are_the_slopes_of_speeds_computed_anew():
    bars = design_sensitivity.tornado(reading(), table(), 6)
    assert bars["lower"].notna().all() and bars["higher"].notna().all()
    central = (bars["higher"] - bars["lower"]) / 2  # of +-10 %: off by the third order
    assert central.to_numpy() == pytest.approx(bars["tangent"].to_numpy(), rel=0.03, abs=1e-6)


def test_what_the_linear_analysis_cannot_see_moves_the_fold_alone():
    known = table().set_index("parameter")
    assert known.loc["a3", "lin"] == 0.0
    assert known.loc["a3", "non"] < -1e-3
    assert abs(known.loc["q1", "non"]) > 1e3 * abs(known.loc["q1", "lin"])


def test_curvatures_act_through_their_sum():
    known = table().set_index("parameter")["non"]
    for k in range(4):
        assert known[f"e{k}"] == pytest.approx(known[f"f{k}"], rel=1e-12)


def test_the_estimate_is_exact_for_bautins_form():
    exact = bautin(b1=0.0, b2=0.5)
    hopf = hopf_point(exact.system, "b1", 0.01)
    clearance = 0.3  # r' = r (b1 + b2 r^2): the cycle of this size is at b1 = -b2 r^2
    found = design_gap.estimated_gap(exact.system, hopf, clearance)
    assert found == pytest.approx(0.5 * clearance**2, rel=1e-9)


def test_the_boundary_of_a_disturbance():
    assert design_threshold.boundary(lambda x: x > 0.7, 1.0) == pytest.approx(0.7, rel=2e-3)
    assert np.isnan(design_threshold.boundary(lambda x: x > 1.7, 1.0))


def test_a_long_motion_confirms_the_threshold():
    found = design_threshold.thresholds(P, reading()).iloc[-1]
    system = reading().found.system.with_values(v=float(found["v"]))
    ends = []
    for part in (0.92, 1.08):
        motion = integrate(system, [part * found["y0"], 0, 0, 0], 25.0, rtol=1e-7)
        ends.append(float(np.abs(motion(np.linspace(24, 25, 200))[:, 0]).max()))
    assert ends[0] < 0.2 * found["unstable"]
    assert ends[1] == pytest.approx(found["stable"], rel=0.01)
