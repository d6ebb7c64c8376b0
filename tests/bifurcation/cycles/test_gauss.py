"""The Gauss methods against the identities that define them.

Tolerances are a few dozen rounding errors: the coefficients of six stages come from Vandermonde
systems with condition numbers up to 1e5, and entries of slopes and weights grow to some tens.
"""

import math

import numpy as np
import pytest

from wheelset.bifurcation.cycles.gauss import gauss

STAGES = range(1, 7)


@pytest.fixture(params=STAGES)
def rule(request):
    return gauss(request.param)


def test_quadrature_is_exact_to_degree_2m_minus_1(rule):
    for q in range(1, 2 * rule.m + 1):
        assert rule.b @ rule.c ** (q - 1) == pytest.approx(1 / q, abs=1e-14)


def test_quadrature_is_not_exact_beyond(rule):
    q = 2 * rule.m + 1
    assert abs(rule.b @ rule.c ** (q - 1) - 1 / q) > 1e-9  # m!^4 / ((2m+1) (2m)!^3) x (2m)!


def test_each_stage_integrates_polynomials_of_degree_m_minus_1(rule):
    for q in range(1, rule.m + 1):
        np.testing.assert_allclose(rule.a @ rule.c ** (q - 1), rule.c**q / q, atol=1e-13)


def test_simplifying_condition_d(rule):
    """sum_i b_i c_i^(q-1) a_ij = b_j (1 - c_j^q) / q: with the other two, order 2 m."""
    for q in range(1, rule.m + 1):
        left = (rule.b * rule.c ** (q - 1)) @ rule.a
        np.testing.assert_allclose(left, rule.b * (1 - rule.c**q) / q, atol=1e-13)


def test_the_method_conserves_quadratic_invariants(rule):
    """b_i a_ij + b_j a_ji = b_i b_j."""
    weighted = rule.b[:, np.newaxis] * rule.a
    np.testing.assert_allclose(weighted + weighted.T, np.outer(rule.b, rule.b), atol=1e-14)


def test_nodes_are_symmetric_and_ordered(rule):
    np.testing.assert_allclose(rule.c + rule.c[::-1], 1.0, atol=1e-15)
    assert np.all(np.diff(np.concatenate([[0.0], rule.c, [1.0]])) > 0)


def test_the_step_is_the_polynomial_at_one(rule):
    """x + h sum b_l f(X_l) is end x + d . X whatever the f_l, where X = x + h a f."""
    rng = np.random.default_rng(rule.m)
    x, f = rng.normal(), rng.normal(size=rule.m)
    stages = x + rule.a @ f
    assert rule.end * x + rule.d @ stages == pytest.approx(x + rule.b @ f, abs=1e-12)
    assert rule.end == pytest.approx((-1) ** rule.m, abs=1e-12)  # R(infinity)
    np.testing.assert_array_equal(rule.at_one, [rule.end, *rule.d])


def test_basis_slopes_and_leading_coefficient_reproduce_polynomials(rule):
    rng = np.random.default_rng(rule.m)
    polynomial = np.polynomial.Polynomial(rng.normal(size=rule.m + 1))
    nodes = np.concatenate([[0.0], rule.c])
    at = rng.random((3, 5))
    np.testing.assert_allclose(rule.basis(at) @ polynomial(nodes), polynomial(at), atol=1e-11)
    np.testing.assert_allclose(
        rule.slopes @ polynomial(nodes), polynomial.deriv()(rule.c), atol=1e-10
    )
    highest = polynomial.deriv(rule.m)(0.0)
    assert rule.highest @ polynomial(nodes) == pytest.approx(
        highest, abs=1e-9 * math.factorial(rule.m)
    )
    assert rule.at_one @ polynomial(nodes) == pytest.approx(polynomial(1.0), abs=1e-11)


def test_basis_is_one_at_its_own_node(rule):
    nodes = np.concatenate([[0.0], rule.c])
    np.testing.assert_allclose(rule.basis(nodes), np.eye(rule.m + 1), atol=1e-13)
