"""Condensed linear problems against a dense matrix that is built by another route.

The dense matrix differentiates Lagrange polynomials (barycentric weights); the solver starts from
Runge-Kutta coefficients. Two backward-stable solutions of M u = r differ by some eps cond(M), so
errors are measured in this unit.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from numba.core.errors import TypingError

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.cycles.collocation import Collocation
from wheelset.bifurcation.cycles.defects import defects
from wheelset.bifurcation.cycles.factors import Factors

EPS = np.finfo(float).eps
STATES, INTERVALS = (1, 2, 3, 4, 8), (1, 2, 7, 20)


# --- problems, and their dense matrices ----------------------------------------------------------


def collocation(n, N, free=1, half=True, seed=0):
    """A discretisation of no particular system: the linear problem asks it for n alone."""
    rng = np.random.default_rng([seed, n, N])
    h = rng.uniform(0.5, 1.5, N)
    signs = rng.choice([-1.0, 1.0], n)
    names = tuple(f"p{i}" for i in range(free))
    return Collocation(
        SimpleNamespace(n=n), np.zeros(free), names, h / h.sum(), signs, half, np.ones(n)
    )


def random_problem(space, size=3.0, extra=0, seed=1):
    """J (N, m, n, n + k), f (N, m, n), period, further forcings, as ``Factors.of`` takes them."""
    rng = np.random.default_rng([seed, *space.shape])
    (N, m, n), k = space.shape, len(space.free)
    J = rng.normal(size=(N, m, n, n + k)) * size
    return J, rng.normal(size=(N, m, n)), 0.7, rng.normal(size=(N, m, n, extra))


def columns_of(space, J, f, period, extra):
    """Forcings by all scalars, (N, m, n, q)."""
    n = space.shape[2]
    own = [f[..., np.newaxis], period * J[..., n:]]
    return np.concatenate([space.kappa * np.concatenate(own, axis=-1), extra], axis=-1)


def lagrange(c):
    """Derivatives at c_1 .. c_m and values at 1 of the Lagrange basis on (0, c_1, ..., c_m)."""
    nodes = np.concatenate([[0.0], c])
    gaps = nodes[:, np.newaxis] - nodes + np.eye(len(nodes))
    weights = 1 / gaps.prod(axis=1)
    D = weights / weights[:, np.newaxis] / gaps
    np.fill_diagonal(D, 0.0)
    np.fill_diagonal(D, -D.sum(axis=1))
    at_one = weights / (1 - nodes)
    return D[1:], at_one / at_one.sum()


def dense(space, A, G, weights, D, signs=None):
    """M (size, size): columns as the vector of unknowns, rows as the residual."""
    (N, m, n), k = space.shape, G.shape[-1]
    slopes, at_one = lagrange(space.rule.c)
    block, size = (m + 1) * n, N * (m + 1) * n + n + k
    one = np.eye(n)
    stages, mesh = np.zeros((N, m, n, size)), np.zeros((N, n, size))
    rows = np.zeros((k, size))
    for j in range(N):
        inner = slice(j * block, (j + 1) * block)
        stages[j, :, :, inner] = np.kron(slopes, one).reshape(m, n, block)
        for i in range(m):
            own = slice(j * block + (i + 1) * n, j * block + (i + 2) * n)
            stages[j, i, :, own] -= space.h[j] * A[j, i]
        stages[j, :, :, size - k :] = -space.h[j] * G[j]
        mesh[j, :, inner] = -np.kron(at_one, one)
        mesh[j, :, (j + 1) * block : (j + 1) * block + n] = one
        rows[:, j * block + n : (j + 1) * block] = weights[:, j]
    boundary = np.zeros((n, size))
    boundary[:, N * block : N * block + n] = one
    boundary[:, :n] = -np.diag(space.signs if signs is None else signs)
    rows[:, size - k :] = D
    return np.concatenate([stages.reshape(-1, size), mesh.reshape(-1, size), boundary, rows])


def solved(M, right):
    """M^-1 right by LAPACK, and the unit of errors."""
    answer = np.linalg.solve(M, right)
    return answer, EPS * np.linalg.cond(M) * np.abs(answer).max()


def unit_row(rng, space):
    """A row laid out as the unknowns, without entries for mesh values."""
    N, m, n = space.shape
    row = rng.normal(size=space.size)
    row[: space.inner].reshape(N, m + 1, n)[:, 0] = 0.0
    row[space.inner : space.inner + n] = 0.0
    return row


def bordered(rng, space, k):
    """k border rows on the stages and k x k entries for the scalars."""
    N, m, n = space.shape
    return rng.normal(size=(k, N, m * n)), rng.normal(size=(k, k))


# --- the solver ----------------------------------------------------------------------------------


@pytest.mark.parametrize("N", INTERVALS)
@pytest.mark.parametrize("n", STATES)
def test_a_step_solves_the_dense_system(n, N):
    space = collocation(n, N)
    problem, rng = random_problem(space), np.random.default_rng(2)
    factors = Factors.of(space, *problem)
    rows, D = rng.normal(size=(1, N, 4 * n)), rng.normal(size=(1, 2))
    row, right = unit_row(rng, space), rng.normal(size=space.size - 1)
    own = row[: space.inner].reshape(N, -1)[:, n:]
    M = dense(
        space, space.kappa * 0.7 * problem[0][..., :n], columns_of(space, *problem),
        np.stack([rows[0], own]), np.stack([D[0], row[-2:]]),
    )  # fmt: skip
    determinant, *found = factors.newton(rows, D, row, right)
    assert np.sign(determinant) == np.linalg.slogdet(M)[0]
    for x, full in zip(found, (np.append(right, 0.0), np.eye(len(M))[-1]), strict=True):
        expected, unit = solved(M, full)
        assert np.abs(x - expected).max() < 50 * unit


@pytest.mark.parametrize("N", INTERVALS)
@pytest.mark.parametrize("n", STATES)
def test_any_scalars_and_signs_are_solved_for_and_transposed(n, N):
    """Two parameters and two more forcings, of which one parameter and one forcing are unknown."""
    space, k = collocation(n, N, free=2), 2
    problem, rng = random_problem(space, extra=2), np.random.default_rng(3)
    factors, columns = Factors.of(space, *problem), np.array([2, 4])
    weights, D = bordered(rng, space, k)
    right, e, t = rng.normal(size=space.inner + n), rng.normal(size=k), rng.normal(size=k)
    A, G = space.kappa * 0.7 * problem[0][..., :n], columns_of(space, *problem)[..., columns]
    M = dense(space, A, G, weights, D, -space.signs)
    expected, unit = solved(M, np.concatenate([right, e]))
    determinant, x, X, c = factors.solve(columns, weights, D, right, e, -space.signs)
    found = np.concatenate([np.hstack([x[:-1], X]).ravel(), x[-1], c])
    assert np.abs(found - expected).max() < 50 * unit
    assert np.sign(determinant) == np.linalg.slogdet(M)[0]

    multipliers, unit = solved(M.T, np.concatenate([np.zeros(len(M) - k), t]))
    psi, eta = factors.transposed(columns, weights, D, t, -space.signs)
    stages = multipliers[: psi.size].reshape(psi.shape) * space.h[:, np.newaxis, np.newaxis]
    assert np.abs(psi - stages).max() < 50 * unit
    assert np.abs(eta - multipliers[-k:]).max() < 50 * unit


def test_multipliers_weigh_forcings_and_rows():
    """t . c = psi . g + eta . e, and psi . G_q - eta . D_q = -t_q."""
    space = collocation(4, 7)
    problem, rng = random_problem(space), np.random.default_rng(4)
    factors, columns = Factors.of(space, *problem), np.arange(2)
    weights, D = bordered(rng, space, 2)
    t, e, g = rng.normal(size=2), rng.normal(size=2), rng.normal(size=space.shape)
    psi, eta = factors.transposed(columns, weights, D, t)
    c = factors.solve(columns, weights, D, space.forcing(g), e)[3]
    assert (psi * g).sum() + eta @ e == pytest.approx(t @ c, rel=1e-10)
    G = columns_of(space, *problem)
    np.testing.assert_allclose(np.einsum("jir,jirq->q", psi, G) - eta @ D, -t, atol=1e-10)


@pytest.mark.parametrize("N", INTERVALS)
def test_pencil_gives_the_multipliers_of_a_constant_matrix(N):
    """R(l h_1) ... R(l h_N) for each eigenvalue l, with R the diagonal Pade approximant of exp."""
    space = collocation(4, N, half=False)
    A = np.random.default_rng(5).normal(size=(4, 4))
    J = np.zeros((*space.shape, 5))
    J[..., :4] = A
    G, E = Factors.of(space, J, np.ones(space.shape), 2.0).pencil
    z = 2.0 * np.linalg.eigvals(A)[:, np.newaxis] * space.h
    numerator = np.polynomial.Polynomial([1, 1 / 2, 3 / 28, 1 / 84, 1 / 1680])
    expected = np.prod(numerator(z) / numerator(-z), axis=1)
    found = np.linalg.eigvals(-np.linalg.solve(E, G))
    np.testing.assert_allclose(np.sort_complex(found), np.sort_complex(expected), rtol=1e-11)


# --- hard problems -------------------------------------------------------------------------------


def diagonalised(space, values, seed):
    """J whose Df has these eigenvalues on an orthogonal basis that varies from stage to stage."""
    rng = np.random.default_rng(seed)
    (N, m, n), k = space.shape, len(space.free)
    J = rng.normal(size=(N, m, n, n + k))
    Q = np.linalg.qr(np.eye(n) + 0.02 * rng.normal(size=(N, m, n, n)))[0]
    J[..., :n] = (Q * np.asarray(values)) @ np.swapaxes(Q, -1, -2) / space.kappa
    return J


@pytest.mark.parametrize("rate", [120.0, 1000.0])
@pytest.mark.parametrize("N", [7, 20])
def test_growing_and_decaying_modes_cost_no_digits(rate, N):
    """Modes exp(+-rate) over the mesh: products of the interval matrices would reach 1e50. Known
    unknowns come back, with an error that the dense solution's is the measure of.
    """
    space = collocation(4, N)
    J = diagonalised(space, [rate, -rate, 1.0, -1.0], 6)
    f, rng = np.random.default_rng(7).normal(size=space.shape), np.random.default_rng(8)
    weights, D = bordered(rng, space, 2)
    extra = space.no_forcing
    M = dense(space, space.kappa * J[..., :4], columns_of(space, J, f, 1.0, extra), weights, D)
    known = rng.normal(size=len(M))
    right, (answer, unit) = M @ known, solved(M, M @ known)
    _, x, X, c = Factors.of(space, J, f, 1.0).solve(
        np.arange(2), weights, D, right[:-2], right[-2:]
    )
    found = np.concatenate([np.hstack([x[:-1], X]).ravel(), x[-1], c])
    assert np.linalg.cond(M) < 1e7  # the problem itself is well posed
    assert np.abs(found - known).max() < max(50 * np.abs(answer - known).max(), 1e-10)
    assert np.abs(found - known).max() < unit


def stage_that_vanishes(space, J, period, interval, stage):
    """J with Df zero but in one stage, where it makes the pivot block on the first state vanish."""
    b = np.linalg.inv(space.rule.a)
    minors = [1.0, *(np.linalg.det(b[:i, :i]) for i in range(1, 5))]
    J = J.copy()
    J[interval, ..., :2] = np.diag([0.0, -1.0])
    pivot = minors[stage + 1] / minors[stage]
    J[interval, stage, 0, 0] = pivot / (space.h[interval] * space.kappa * period)
    return J


@pytest.mark.parametrize("stage", range(3))
def test_a_stage_that_cannot_be_eliminated_in_order_is_pivoted(stage):
    space = collocation(2, 3)
    J, f, period, extra = random_problem(space)
    J = stage_that_vanishes(space, J, period, 1, stage)
    rng = np.random.default_rng(9)
    weights, D = bordered(rng, space, 2)
    A = space.kappa * period * J[..., :2]
    M = dense(space, A, columns_of(space, J, f, period, extra), weights, D)
    right = rng.normal(size=len(M))
    expected, unit = solved(M, right)
    determinant, x, X, c = Factors.of(space, J, f, period).solve(
        np.arange(2), weights, D, right[:-2], right[-2:]
    )
    found = np.concatenate([np.hstack([x[:-1], X]).ravel(), x[-1], c])
    assert np.abs(found - expected).max() < 50 * unit
    assert np.sign(determinant) == np.linalg.slogdet(M)[0]


def test_a_singular_interval_is_named():
    """With the last pivot block the whole matrix of the stages is singular."""
    space = collocation(2, 3)
    J, f, period, _ = random_problem(space)
    with pytest.raises(SingularSystem, match="mesh interval 1"):
        Factors.of(space, stage_that_vanishes(space, J, period, 1, 3), f, period)


def test_a_singular_system_is_named():
    space = collocation(4, 7)
    factors, rng = Factors.of(space, *random_problem(space)), np.random.default_rng(11)
    weights, D = bordered(rng, space, 2)
    weights[1], D[1] = 0.0, 0.0
    with pytest.raises(SingularSystem, match="border rows"):
        factors.solve(np.arange(2), weights, D, None, np.ones(2))
    with pytest.raises(SingularSystem, match="border rows"):
        factors.transposed(np.arange(2), weights, D, np.ones(2))
    with pytest.raises(SingularSystem, match="border rows"):
        factors.newton(weights[:1], D[:1], np.zeros(space.size), np.zeros(space.size - 1))


def test_memory_is_linear_in_the_number_of_intervals():
    def doubles(N):
        space = collocation(4, N)
        return sum(a.size for a in Factors.of(space, *random_problem(space)).arrays)

    assert doubles(40) == 2 * doubles(20) == 20 * doubles(2)


def test_arrays_with_gaps_are_refused():
    space = collocation(2, 2)
    factors = Factors.of(space, *random_problem(space))
    row = np.zeros(2 * space.size)[::2]
    with pytest.raises(TypingError, match="contiguous"):
        factors.newton(np.ones((1, 2, 8)), np.ones((1, 2)), row, np.zeros(space.size - 1))


# --- unknowns and residuals ----------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 4])
def test_polynomials_of_degree_four_have_no_defects(n):
    """For u' = kappa T f known along a polynomial u; the boundary and the phase as they are."""
    space, rng = collocation(n, 5), np.random.default_rng(12)
    mesh = np.concatenate([[0.0], np.cumsum(space.h)])
    curve = np.polynomial.Polynomial(rng.normal(size=5))
    sizes, period = rng.normal(size=n), 0.3
    at = mesh[:-1, np.newaxis] + space.h[:, np.newaxis] * space.rule.c
    X = curve(at)[..., np.newaxis] * sizes
    x = curve(mesh)[:, np.newaxis] * sizes
    f = curve.deriv()(at)[..., np.newaxis] * sizes / (space.kappa * period)
    u = space.join(x, X, period, np.array([2.0]))
    row = rng.normal(size=(5, 4 * n))
    residual = space.residual(u, f, row, 0.25)
    assert np.abs(residual[: space.inner]).max() < 1e-12
    np.testing.assert_allclose(residual[space.inner : -1], x[-1] - space.signs * x[0], atol=1e-14)
    assert residual[-1] == pytest.approx((row * X.reshape(5, -1)).sum() - 0.25, rel=1e-12)


def test_the_residual_of_a_linear_system_is_its_dense_matrix():
    space, rng = collocation(3, 7), np.random.default_rng(13)
    A = rng.normal(size=(*space.shape, 3))
    M = dense(space, A, np.zeros((*space.shape, 1)), np.zeros((1, 7, 12)), np.eye(1))
    u = rng.normal(size=len(M) + 1)
    f = np.einsum("jirs,jis->jir", A, space.split(u).stages)
    out, row = np.empty(len(M)), np.zeros((7, 12))
    defects(
        u, f, row, 0.0, 1.0, space.h, space.rule.slopes, space.rule.at_one, space.sign_tuple, out
    )
    np.testing.assert_allclose(out[:-1], (M @ u[:-1])[:-1], atol=1e-11)


def test_unknowns_are_split_as_they_were_joined():
    space, rng = collocation(3, 7, free=2), np.random.default_rng(14)
    x, X, free = rng.normal(size=(8, 3)), rng.normal(size=(7, 4, 3)), rng.normal(size=2)
    u = space.join(x, X, 0.5, free)
    orbit = space.split(u)
    np.testing.assert_array_equal(orbit.mesh_values, x)
    np.testing.assert_array_equal(orbit.stages, X)
    assert orbit.period == 0.5
    np.testing.assert_array_equal(orbit.free, free)
    np.testing.assert_array_equal(orbit.vector, u)
    assert len(u) == space.size
