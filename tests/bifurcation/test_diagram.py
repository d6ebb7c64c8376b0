"""Whole diagrams: every family is found, once."""

import numpy as np
import pytest

from tests.exact_systems import adaptive_control, bautin, lorenz, lorenz_hopf
from tests.systems import toy_wheelset
from wheelset.bifurcation.diagram import diagram


def test_the_toy_wheelset_has_one_family_with_a_fold():
    found = diagram(toy_wheelset(100.0), "v", (40.0, 60.0))
    [family] = found.families
    assert family.name == "H1" and family.branch is not None
    assert [s.kind for s in family.branch.special] == ["LPC"]
    assert set(found.branches) == {"equilibrium", "H1"}


def test_bautins_form_has_the_family_of_its_hopf_point():
    found = diagram(bautin(b2=0.5).system, "b1", (-0.2, 0.2))
    [family] = found.families
    assert family.branch.values[-1, 0] == pytest.approx(0.2)


def test_doubled_cycles_are_followed_as_deep_as_asked():
    shallow = diagram(adaptive_control(), "alpha", (0.55, 1.5), depth=1, steps=120)
    deep = diagram(adaptive_control(), "alpha", (0.55, 1.5), depth=2, steps=120)
    assert [f.name for f in shallow.families] == ["H1"]
    assert "H1 PD1" in [f.name for f in deep.families]
    doubled = next(f.branch for f in deep.families if f.name == "H1 PD1")
    doubling = shallow.families[0].branch.of_kind("PD")[0]
    assert doubled.points[0].solution.period == pytest.approx(
        2 * doubling.solution.period, rel=1e-3
    )


def test_lorenz_equilibrium_sends_off_its_unstable_cycles():
    r, _ = lorenz_hopf()
    rest = np.sqrt(8 / 3 * (24.0 - 1))
    found = diagram(lorenz(24.0), "r", (20.0, 26.0), [rest, rest, 23.0], depth=1, steps=30)
    [birth] = found.equilibria.of_kind("H")
    assert birth.values[0] == pytest.approx(r, rel=1e-9)
    assert found.families[0].branch.points[10].solution.unstable == 1


def test_an_equilibrium_without_hopf_points_has_no_families():
    assert diagram(toy_wheelset(100.0), "v", (10.0, 30.0)).families == ()
