"""Fig. 6: what section 3 says about the cycles, and the curves themselves."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pandas as pd
import pytest

from tests.paper.arrays import regress
from tests.paper.flange_cycles import P, curves, filed, panel_of, vehicle_of, verdicts
from tests.paper.judging import judged
from wheelset.bifurcation.cycles.cycle_start import cycle_from_cycle
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.plotting.flange_cycles import NAMES, cycle_panels
from wheelset.published.figures import panel
from wheelset.published.items import items_of
from wheelset.studies import flange_cycle_claims, flange_cycles

pytestmark = pytest.mark.slow

#: Speeds at which the curves are compared, m/s.
SPEEDS = {"quintic": (35.0, 40.0, 45.0, 50.0, 55.0, 59.0)}
OTHER_SPEEDS = (50.8, 51.1, 51.5, 52.0, 53.0, 55.0, 59.0)


def at_speed(family, speed):
    """Cycles of a branch at a speed, each solved there from the nearer point beside it."""
    for one, other in pairwise(family.branch.points):
        first, second = float(one.values[0]), float(other.values[0])
        if (first - speed) * (second - speed) < 0:
            near = (one if abs(first - speed) < abs(second - speed) else other).solution
            moved = replace(near, parameters={**near.parameters, "v": speed})
            start = cycle_from_cycle(family.system, moved, "v", 10.0)
            yield start.problem.cycle(start.u, start.problem.linearised(start.u).floquet)


def sampled(family):
    speeds = SPEEDS.get(family.law, OTHER_SPEEDS)
    return [
        {
            "case": family.case,
            "law": family.law,
            "v": speed,
            "y": cycle.extremes("y")[1],
            "period": cycle.period,
            "unstable": cycle.unstable,
        }
        for speed in speeds
        for cycle in at_speed(family, speed)
    ]


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Fig. 6"), vehicle_of))
def test_panel_is_as_the_paper_says(item, vehicle):
    claims = flange_cycle_claims.figure_6_claims(curves())
    sentences = claims[claims["item"] == item.item]
    assert len(sentences) > 0
    assert sentences["tolerated"].all()


def test_curves_are_as_stored():
    """Solved at the speeds, so that steps do not matter: meshes resolve periods to 1e-8 and
    displacements between mesh points, of lower order, to some 1e-6.
    """
    rows = [row for family in filed() if family.name == "H" for row in sampled(family)]
    regress("fig_6", pd.DataFrame(rows), rtol=1e-5)


@pytest.mark.parametrize("case", P.cases)
def test_axes_are_the_papers_and_every_curve_is_followed_through_its_panel(case):
    figure = cycle_panels(curves(), verdicts(), case)
    for ax, (law, name) in zip(figure.axes, NAMES.items(), strict=True):
        window = panel(6, f"case {case}, {name}")
        assert ax.get_xlim() == (window.x.low, window.x.high)
        assert ax.get_ylim() == (window.y.low, window.y.high)
        low, high = flange_cycles.followed(panel_of(case, law)[0].hopf, law)
        assert low <= window.x.low < window.x.high <= high


@pytest.mark.parametrize("case", P.cases)
def test_hunting_under_the_polynomial_is_what_integration_settles_on(case):
    """Fig. 5's speed; the motion is integrated to 1e-9 and settles to 1e-6 of its amplitude."""
    family = panel_of(case, "quintic")[0]
    largest = max(at_speed(family, 40.0), key=lambda cycle: cycle.extremes("y")[1])
    system = family.system.with_values(v=40.0)
    motion = integrate(system, [0.01, 0.0, 0.0, 0.0], 60.0, stop_when_settled=True)
    assert motion.outcome.amplitude[0] == pytest.approx(largest.measure("amplitude y"), rel=1e-5)
    assert motion.outcome.period == pytest.approx(largest.period, rel=1e-5)
