"""Convergence of cycles and multipliers, and whether their error estimates are honest."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.exact_systems import LORENZ_AB, VAN_DER_POL, adaptive_control, lorenz, van_der_pol
from tests.systems import toy_wheelset
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.cycles.accuracy import cycle_error
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    cycle_from_hopf,
    cycle_from_orbit,
)
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.integration.integrate import integrate


def settled(system, x0, t_end):
    return integrate(system, x0, t_end, rtol=1e-8)


def cycle_of(start):
    branch = follow(start.problem, start.u, direction=start.tangent, steps=1)
    return branch.points[0].solution


def van_der_pol_cycle(mu, intervals, mesh=None):
    system = van_der_pol(mu)
    orbit = settled(system, [2.0, 0.0], 40 + 6 * mu)
    how = Discretisation(intervals, True, mesh or Meshing(0, None))
    return system, cycle_of(cycle_from_orbit(system, "mu", orbit, discretisation=how))


def test_the_period_converges_with_order_eight():
    errors = []
    for intervals in (8, 16):
        _, cycle = van_der_pol_cycle(1.0, intervals)
        errors.append(abs(cycle.period / VAN_DER_POL[1.0][0] - 1))
    assert np.log2(errors[0] / errors[1]) > 6.5
    assert errors[1] < 1e-9


@pytest.mark.parametrize("mu", [10.0, 50.0])
def test_a_relaxation_oscillation_is_resolved_by_a_mesh_that_follows_it(mu):
    _, cycle = van_der_pol_cycle(mu, 120, Meshing(5, 1e-9))
    assert cycle.period == pytest.approx(VAN_DER_POL[mu][0], rel=1e-8)


def test_error_estimates_are_the_errors():
    system, cycle = van_der_pol_cycle(1.0, 14)
    estimate = cycle_error(system, cycle, "mu")
    true = abs(cycle.period / VAN_DER_POL[1.0][0] - 1)
    assert estimate.period == pytest.approx(true, rel=0.1)
    exact = np.exp(VAN_DER_POL[1.0][2])
    found = cycle.multipliers[np.argmin(np.abs(cycle.multipliers - exact))]
    assert estimate.multipliers.max() >= 0.5 * abs(found - exact)


def test_multipliers_agree_with_the_variational_equation_integrated():
    system = adaptive_control()
    start = cycle_from_hopf(system, hopf_point(system, "alpha", 1.0), 1.0)
    branch = follow(start.problem, start.u, direction=start.tangent, windows={"alpha": (0.7, 1.2)})
    cycle = branch.points[-1].solution
    values = integrated_multipliers(system, cycle)
    assert np.sort(np.abs(values)) == pytest.approx(np.sort(np.abs(cycle.multipliers)), abs=1e-7)


def integrated_multipliers(system, cycle):
    p, n = system.p(**cycle.parameters), system.n

    def field(t, z):
        f, J = system.evaluate(z[:n], p)
        return np.concatenate([f, (J @ z[n:].reshape(n, n)).ravel()])

    start = np.concatenate([cycle.nodes[0, 0], np.eye(n).ravel()])
    run = solve_ivp(field, (0, cycle.period), start, method="DOP853", rtol=1e-12, atol=1e-12)
    return np.linalg.eigvals(run.y[n:, -1].reshape(n, n))


def test_the_unstable_cycle_of_lorenz_is_the_published_one():
    system = lorenz(28.0)
    orbit = integrate(system, LORENZ_AB.state, LORENZ_AB.period, rtol=1e-10)
    how = Discretisation(40, True)
    start = cycle_from_orbit(
        system, "r", orbit, period=LORENZ_AB.period * (1 - 1e-12), discretisation=how
    )
    cycle = cycle_of(start)
    assert cycle.symmetric
    assert cycle.period == pytest.approx(LORENZ_AB.period, rel=1e-8)


def test_intervals_are_added_until_the_accuracy_is_reached():
    system = van_der_pol(1.0)
    orbit = settled(system, [2.0, 0.0], 46.0)
    how = Discretisation(10, True, Meshing(every=2, accuracy=1e-9))
    start = cycle_from_orbit(system, "mu", orbit, discretisation=how)
    branch = follow(start.problem, start.u, direction=1, windows={"mu": (0.5, 8.0)}, steps=400)
    last = branch.points[-1].solution
    assert len(last.mesh) > 11
    assert cycle_error(system, last, "mu").greatest < 1e-8


@pytest.mark.parametrize(
    ("make", "parameter", "near", "kind", "coefficient"),
    [
        (lambda: toy_wheelset(100.0), "v", 50.0, "LPC", "b"),
        (adaptive_control, "alpha", 1.0, "PD", "c"),
    ],
)
def test_reported_numbers_are_stable_under_mesh_doubling(make, parameter, near, kind, coefficient):
    found, coefficients = [], []
    for intervals in (40, 80):
        system = make()
        start = cycle_from_hopf(
            system, hopf_point(system, parameter, near), 10.0 if kind == "LPC" else 1.0,
            discretisation=Discretisation(intervals, None, Meshing(5, None)),
        )  # fmt: skip
        branch = follow(start.problem, start.u, direction=start.tangent, steps=130)
        point = branch.of_kind(kind)[0]
        size = point.solution.measure(f"rms {system.state_names[0]}")
        found.append([point.values[0], point.solution.period, size])
        coefficients.append(point.coefficients[coefficient])
    assert found[0] == pytest.approx(found[1], rel=1e-8)
    # b grows like 1/(dT/ds), here 1e-2, and takes the location's rounding with it
    assert coefficients[0] == pytest.approx(coefficients[1], rel=1e-7)
