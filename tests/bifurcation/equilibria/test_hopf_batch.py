"""Hopf points of many rows at once: as one by one, for odd and other fields; failures by row."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tests.systems import TOY_HOPF, toy_wheelset
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch, hopf_batch
from wheelset.bifurcation.fields.field import Condition, VectorField
from wheelset.bifurcation.outcomes import DomainLeft, NoConvergence
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle

TABLE = [{"a1": 0.15}, {"a1": 0.35}, {"a3": 5000.0}, {"c1": -200.0}, {"c1": 200.0}, {"p0": 7e3}]


def agree_one_by_one(system: System, batch: HopfBatch, rows: np.ndarray, near: float) -> None:
    """Both stop at rounding, which the balance of large numbers in A multiplies by some 1e4."""
    assert batch.found.all()
    for i, row in enumerate(rows):
        there = system.with_values(**dict(zip(system.parameter_names, row, strict=True)))
        single = hopf_point(there, batch.parameter, near)
        assert batch.values[i] == pytest.approx(single.value, rel=1e-10)
        assert batch.frequencies[i] == pytest.approx(single.frequency, rel=1e-10)
        assert batch.lyapunov[i] == pytest.approx(single.lyapunov, rel=1e-9)
        assert batch.states[i] == pytest.approx(single.state, abs=1e-12)


def test_the_toy_wheelset_and_its_oracle():
    system = toy_wheelset()
    rows = np.array([system.p(v=45.0), system.p(v=60.0), system.p(v=50.0, a3=-30.0)])
    batch = hopf_batch(system, "v", rows)
    assert batch.values == pytest.approx(TOY_HOPF["v"], rel=1e-12)
    assert batch.frequencies == pytest.approx(TOY_HOPF["frequency"], rel=1e-12)
    assert batch.lyapunov[:2] == pytest.approx(TOY_HOPF["flc_at_a3_100"], rel=1e-11)
    agree_one_by_one(system, batch, rows, 50.0)


@pytest.mark.parametrize("vehicle", ["guo2021", "guo2021_physical"])
def test_a_vehicles_rows(vehicle):
    system = hunting_system(load_vehicle(vehicle, {"a3": 200}))
    near = hopf_point(system, "v", 52.0).value
    rows = np.array([system.p(v=near, **changes) for changes in TABLE])
    agree_one_by_one(system, hopf_batch(system, "v", rows), rows, near)


def test_unequal_wheels_move_the_equilibrium_with_the_speed():
    """da0 and dc1 differ left and right: no odd field, quadratic terms, and no equilibrium at 0."""
    system = hunting_system(load_vehicle("guo2021", {"a3": 200, "da0": 5e-5, "dc1": 0.5}))
    rows = np.array([system.p(v=50.0, a1=a1) for a1 in (0.2, 0.23)])
    batch = hopf_batch(system, "v", rows)
    assert (np.abs(batch.states[:, 0]) > 1e-5).all()
    agree_one_by_one(system, batch, rows, 50.0)


def test_a_row_that_leaves_the_domain_fails_for_itself():
    system = hunting_system(load_vehicle("guo2021", {"a3": 200}))
    rows = np.array([system.p(v=50.0), system.p(v=50.0, e0=-1.0), system.p(v=50.0, a1=0.3)])
    batch = hopf_batch(system, "v", rows)
    assert batch.found.tolist() == [True, False, True]
    assert isinstance(batch.outcomes[1], DomainLeft)
    assert "sum of curvatures" in str(batch.outcomes[1])
    assert np.isnan(batch.values[1])
    assert np.isfinite(batch.lyapunov[[0, 2]]).all()


def test_a_row_without_oscillation_says_so():
    """x'' = -k x + p x': a pair +-i sqrt(k) at p = 0, and a saddle for k < 0."""
    system = System.from_function(
        lambda x, p: [x[1], -p[1] * x[0] + p[0] * x[1] - x[1] ** 3], ("x", "y"), {"p": 0, "k": 1}
    )
    rows = np.array([system.p(p=0.3, k=4.0), system.p(p=0.3, k=-1.0)])
    batch = hopf_batch(system, "p", rows)
    assert batch.found.tolist() == [True, False]
    assert batch.values[0] == pytest.approx(0.0, abs=1e-12)
    assert batch.frequencies[0] == pytest.approx(2.0, rel=1e-12)
    assert isinstance(batch.outcomes[1], NoConvergence)


def test_the_pair_with_the_given_frequency_is_followed():
    """Two oscillators of frequencies 1 and 3, losing stability at p = 1 and p = 2."""

    def field(x, p):
        a, b, c, d = x
        return [b, -a + (p[0] - 1) * b - b**3, d, -9 * c + (p[0] - 2) * d - d**3]

    system = System.from_function(field, ("a", "b", "c", "d"), {"p": 0.0})
    batch = hopf_batch(system, "p", np.full((2, 1), 1.4), frequencies=[1.0, 3.0])
    assert batch.values == pytest.approx([1.0, 2.0], abs=1e-12)
    assert batch.frequencies == pytest.approx([1.0, 3.0], rel=1e-12)


def test_shapes_are_checked():
    system = toy_wheelset()
    with pytest.raises(ValueError, match="rows of shape"):
        hopf_batch(system, "v", system.p())
    with pytest.raises(ValueError, match="one each a row"):
        hopf_batch(system, "v", [system.p()], frequencies=[1.0, 2.0])


class TestForms:
    """``System.forms`` with one row of parameters a point."""

    @pytest.mark.parametrize("order", [0, 1, 2, 3])
    def test_each_point_sees_its_own_parameters(self, order):
        system = toy_wheelset()
        rng = np.random.default_rng(order)
        points = rng.uniform(-1, 1, (5, 4)) * 1e-3
        p = np.array([system.p(a1=a1, v=v) for a1, v in rng.uniform([0.1, 20], [0.4, 80], (5, 2))])
        directions = rng.uniform(-1, 1, (order, 4))
        got = system.forms(points, p, *directions)
        alone = [system.form(x, row, *directions) for x, row in zip(points, p, strict=True)]
        np.testing.assert_array_equal(got, alone)

    def test_rows_have_to_fit_the_points(self):
        system = toy_wheelset()
        with pytest.raises(ValueError, match="2 rows of parameters for 3 points"):
            system.forms(np.zeros((3, 4)), np.array([system.p(), system.p()]), np.ones(4))

    def test_conditions_are_read_with_the_rows_parameters(self):
        a, k, margin = sp.symbols("a k margin", real=True)
        field = VectorField(
            (a,), (k,), (sp.sqrt(margin),), ((margin, k - a),), (Condition(margin, "margin"),)
        )
        system = System(field, {"k": 1.0})
        rows = np.array([[2.0], [0.5]])
        assert system.forms([[0.0], [0.0]], rows)[:, 0] == pytest.approx(np.sqrt([2.0, 0.5]))
        with pytest.raises(DomainLeft) as left:
            system.forms([[1.0], [1.0]], rows)
        assert left.value.value == -0.5
