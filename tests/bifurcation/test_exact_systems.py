"""The oracles themselves: every closed form against integration and against Fourier series.

The field is written out by sympy anew and its variational equation is carried by complex steps, so
that nothing here rests on the code the oracles are meant for, except the exact multilinear forms.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.linalg import block_diag

from tests import exact_systems as exact
from tests.exact_systems import (
    ADAPTIVE_CONTROL_FLC,
    ADAPTIVE_CONTROL_PD,
    LORENZ_AB,
    LORENZ_BPC,
    VAN_DER_POL,
    BogdanovTakens,
    CriticalMode,
    ExactCycle,
    HopfHopf,
    OddPitchfork,
    Oscillators,
    TorusBirth,
    TwistedBand,
    ZeroHopf,
    bautin,
    cusp_of_cycles,
    hopf,
    sheared,
)
from wheelset.bifurcation.equilibria.lyapunov import critical_pair, first_lyapunov

TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}

# --- integration, apart from the package's own ----------------------------------------------------


def written_out(system):
    """f(x), x (n,) or (n, columns), real or complex, straight from the symbolic right-hand side."""
    f, p = _lambdified(system.field), system.p()
    return lambda x: np.array(f(x, p))


@cache
def _lambdified(field):
    return sp.lambdify((field.state, field.parameters), list(field.derivative), "numpy", cse=True)


def flow(system, x, t):
    """(x(t), Phi(t)): tangents travel as imaginary parts of 1e-40, without any truncation."""
    f, n = written_out(system), system.n

    def with_tangents(_, state):
        columns = state[:n, None] + 1e-40j * state[n:].reshape(n, n)
        rates = f(columns)
        return np.concatenate([rates[:, 0].real, rates.imag.ravel() * 1e40])

    start = np.concatenate([x, np.eye(n).ravel()])
    end = solve_ivp(with_tangents, (0, t), start, **TIGHT).y[:, -1]
    return end[:n], end[n:].reshape(n, n)


def jacobian(system, x):
    """df/dx, (n, n), by complex steps."""
    return written_out(system)(x[:, None] + 1e-40j * np.eye(system.n)).imag * 1e40


def assert_eigenvalues(matrix, expected, tolerance):
    """By characteristic polynomials: those of a defective matrix are still well conditioned."""
    np.testing.assert_allclose(np.poly(matrix), np.poly(expected), atol=tolerance)


def assert_solution(cycle, tolerance=2e-11):
    """The cycle closes (on half its period where it is symmetric) with the stated multipliers."""
    start = cycle.state(np.array([0.1]))[0]
    signs = np.array(cycle.signs or [1] * len(start))
    known = cycle.half_multipliers if cycle.signs else cycle.multipliers
    end, Phi = flow(cycle.system, start, cycle.period / (2 if cycle.signs else 1))
    np.testing.assert_allclose(signs * end, start, atol=tolerance)
    assert_eigenvalues(signs[:, None] * Phi, [*known, 1.0], tolerance * max(1, *abs(known)))


# --- Fourier series: the normal forms of Kuznetsov et al. (2005) on a trigonometric mesh ----------


#: Odd, and enough for every trigonometric polynomial below.
POINTS = 25


class Fourier:
    """A cycle at an odd number of equidistant phases, and its linearised problem."""

    def __init__(self, cycle: ExactCycle, points: int = POINTS):
        self.system, self.T, self.s = cycle.system, cycle.period, np.arange(points) / points
        self.u = cycle.state(self.s)
        self.A = [np.column_stack([self.system.form(x, None, e) for e in np.eye(self.system.n)])
                  for x in self.u]  # fmt: skip
        self.f = self.form()
        gap = np.subtract.outer(np.arange(points), np.arange(points))
        with np.errstate(divide="ignore"):
            D = np.pi * (-1.0) ** gap / np.sin(np.pi * gap / points)
        np.fill_diagonal(D, 0.0)
        self.D = np.kron(D, np.eye(self.system.n))

    def form(self, *directions):
        """D^k f(u)[...] along functions of shape (points, n)."""
        rows = zip(self.u, *directions, strict=True)
        return np.array([self.system.form(x, None, *v) for x, *v in rows])

    def times_A(self, v):
        return np.einsum("kij,kj->ki", self.A, v)

    def operator(self, turn=0.0):
        """v' - T A v + i turn v as a matrix; real without a turn."""
        L = self.D - self.T * block_diag(*self.A)
        return L + 1j * turn * np.eye(len(L)) if turn else L

    def null(self, L, count=1):
        """Right and left null vectors as functions, and a check that there are ``count``."""
        U, size, V = np.linalg.svd(L)
        assert size[-count] < 1e-8 < 1e-3 < size[-count - 1]
        shape = (count, *self.u.shape)
        return V[-count:].conj().reshape(shape), U[:, -count:].T.reshape(shape)

    def solve(self, L, right):
        """One solution of a consistent system; which one does not matter."""
        solution, *_ = np.linalg.lstsq(L, right.ravel(), rcond=1e-12)
        np.testing.assert_allclose(L @ solution, right.ravel(), atol=1e-9)
        return solution.reshape(right.shape)


def mean_square(v):
    return (np.abs(v) ** 2).sum(axis=1).mean()


def lpc_coefficient(cycle):
    """w . (B(v,v) + 2 A v)/(2 w . v), v' - T A v = T f, int <v, f> = 0."""
    mesh = Fourier(cycle)
    L = mesh.operator()
    _, (w,) = mesh.null(L)
    v = mesh.solve(L, mesh.T * mesh.f)
    v -= mesh.f * np.vdot(mesh.f, v) / np.vdot(mesh.f, mesh.f)
    return np.vdot(w, mesh.form(v, v) + 2 * mesh.times_A(v)) / (2 * np.vdot(w, v))


def real_mode(mesh, v, w, psi):
    """(v, a, c) with int <v, v> = 1: c = w . (C(v,v,v) + 3 B(v,h) - 6 a A v)/(6 w . v)."""
    v = v / mean_square(v) ** 0.5
    vv = mesh.form(v, v)
    a = np.vdot(psi, vv) / (2 * np.vdot(psi, mesh.f))
    h = mesh.solve(mesh.operator(), mesh.T * (vv - 2 * a * mesh.f))
    third = mesh.form(v, v, v) + 3 * mesh.form(v, h) - 6 * a * mesh.times_A(v)
    return CriticalMode(lambda s: v, np.vdot(w, third) / (6 * np.vdot(w, v)), a)


def doubling_mode(cycle):
    """At a period doubling: v = e^{i pi s} times a null vector of v' - T A v + i pi v, real."""
    mesh = Fourier(cycle)
    _, (psi,) = mesh.null(mesh.operator())
    turned = np.exp(1j * np.pi * mesh.s)[:, None]
    real = []
    for null in mesh.null(mesh.operator(np.pi)):
        v = turned * null[0]
        v /= np.sqrt((v**2).sum())
        np.testing.assert_allclose(v.imag, 0, atol=1e-9)
        real.append(v.real)
    return real_mode(mesh, *real, psi)


def pitchfork_mode(cycle):
    """At a pitchfork the null vectors are f and v, told apart by their parity on half a period:
    <v, f> = 0, w . f = 0, psi . v = 0.
    """
    mesh = Fourier(cycle)
    rights, lefts = mesh.null(mesh.operator(), count=2)
    v = without(rights, mesh.f)
    return real_mode(mesh, v, without(lefts, mesh.f), without(lefts, v))


def without(pair, direction):
    """The combination of two functions that is orthogonal to a third."""
    first, second = (np.vdot(x, direction) for x in pair)
    return second * pair[0] - first * pair[1]


def torus_mode(cycle):
    """v' - T A v + i theta v = 0; a = psi . B(v,v-)/psi . f;
    c = w . (C(v,v,v-) + 2 B(v,h11) + B(v-,h20) - 2 a (A v - i theta/T v))/(2 w . v).
    """
    mesh, theta = Fourier(cycle), cycle.mode.theta * cycle.period
    _, (psi,) = mesh.null(mesh.operator())
    (v,), (w,) = mesh.null(mesh.operator(theta))
    v = v / mean_square(v) ** 0.5
    mixed = mesh.form(v, v.conj()).real
    a = np.vdot(psi, mixed) / np.vdot(psi, mesh.f)
    h11 = mesh.solve(mesh.operator(), mesh.T * (mixed - a * mesh.f))
    h20 = mesh.solve(mesh.operator(2 * theta), mesh.T * mesh.form(v, v))
    third = mesh.form(v, v, v.conj()) + 2 * mesh.form(v, h11) + mesh.form(v.conj(), h20)
    third -= 2 * a * (mesh.times_A(v) - 1j * theta / mesh.T * v)
    return CriticalMode(lambda s: v, np.vdot(w, third) / (2 * np.vdot(w, v)), a)


def assert_mode(cycle, found):
    """Vector up to a phase, a, c and the coefficient with int_0^T <v, v> dt = 1."""
    known, s = cycle.mode.sized(), np.arange(POINTS) / POINTS
    v, w = known.vector(s), found.vector(s)
    phase = np.vdot(v, w) / np.vdot(v, v)
    assert abs(phase) == pytest.approx(1.0, rel=1e-9)
    np.testing.assert_allclose(w, phase * v, atol=1e-8)
    assert found.a == pytest.approx(known.a, rel=1e-8, abs=1e-9)
    assert found.c == pytest.approx(known.c, rel=1e-8)
    assert found.c / cycle.period == pytest.approx(cycle.coefficient, rel=1e-8)


# --- cycles ---------------------------------------------------------------------------------------

LARGE = bautin().squared_radii()[1]
SMALL = bautin().squared_radii()[0]

CYCLES = {
    "hopf": hopf().cycle(0.2),
    "bautin, stable": bautin().cycle(LARGE),
    "bautin, unstable": bautin().cycle(SMALL),
    "fold": bautin().at_fold(0.25).cycle(0.25),
    "cusp": cusp_of_cycles().cycle(1.0),
    "chain of 3, fold": bautin(count=3).at_fold(0.25).cycle(0.25),
    "period doubling": TwistedBand().cycle(),
    "before it": TwistedBand(mu=-0.2).cycle(),
    "doubled": TwistedBand(mu=0.1).bifurcated(),
    "sign symmetry": TwistedBand(2, mu=0.1).cycle(),
    "sign symmetry broken": TwistedBand(2, mu=0.1).bifurcated(-1),
    "torus": TorusBirth(mu=0.02).cycle(),
    "odd": OddPitchfork(mu=0.1).cycle(),
    "odd broken": OddPitchfork(mu=0.1).bifurcated(),
    "odd kept": OddPitchfork(1, mu=0.1).bifurcated(),
    "zero-Hopf": ZeroHopf(b2=0.01).cycle(),
    "zero-Hopf torus": ZeroHopf().cycle(),
    "Hopf-Hopf 1": HopfHopf().first_cycle(),
    "Hopf-Hopf 2": HopfHopf().second_cycle(),
}


@pytest.mark.parametrize("name", CYCLES)
@pytest.mark.parametrize("change", [lambda cycle: cycle, sheared], ids=["plain", "sheared"])
def test_cycle_closes_with_its_multipliers(name, change):
    assert_solution(change(CYCLES[name]))


@pytest.mark.parametrize("name", CYCLES)
def test_half_multipliers_square_to_multipliers(name):
    cycle = CYCLES[name]
    if cycle.signs:
        np.testing.assert_allclose(cycle.half_multipliers**2, cycle.multipliers, rtol=1e-13)


@pytest.mark.parametrize("name", CYCLES)
def test_package_evaluates_the_same_field(name):
    cycle = sheared(CYCLES[name])
    x = cycle.state(np.array([0.3]))[0] + 0.01
    np.testing.assert_allclose(
        cycle.system.form(x, None), written_out(cycle.system)(x), rtol=1e-12, atol=1e-14
    )


# --- coefficients ---------------------------------------------------------------------------------

CHANGES = pytest.mark.parametrize(
    "change", [lambda cycle: cycle, sheared], ids=["plain", "sheared"]
)


@CHANGES
@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("R", [0.25, 0.6])
def test_coefficient_of_a_fold_of_cycles(change, count, R):
    for family in (bautin(count=count), Oscillators(b3=3.0, b4=-1.0, count=count)):
        at = family.at_fold(R)
        assert lpc_coefficient(change(at.cycle(R))) == pytest.approx(
            at.lpc_coefficient(R), rel=1e-8
        )


@CHANGES
def test_coefficient_of_a_period_doubling(change):
    cycle = change(TwistedBand().cycle())
    assert_mode(cycle, doubling_mode(cycle))


@CHANGES
@pytest.mark.parametrize("oracle", [TwistedBand(2), OddPitchfork(2), OddPitchfork(0)])
def test_coefficient_of_a_pitchfork(change, oracle):
    cycle = change(oracle.cycle())
    assert_mode(cycle, pitchfork_mode(cycle))


@CHANGES
@pytest.mark.parametrize(
    "cycle",
    [
        TorusBirth().cycle(),
        ZeroHopf().cycle(),
        ZeroHopf(b1=0.03, s=-1.0, theta=0.7).cycle(),
        HopfHopf().at_torus_birth().first_cycle(),
    ],
    ids=["torus", "zero-Hopf", "zero-Hopf, s = -1", "Hopf-Hopf"],
)
def test_coefficient_of_a_torus_bifurcation(change, cycle):
    assert_mode(change(cycle), torus_mode(change(cycle)))


# --- the same coefficients from return maps -------------------------------------------------------


def returned(system, x):
    """State and time of the next upward passage through x_2 = 0 from a state with x_2 = 0."""
    f = written_out(system)
    run = solve_ivp(lambda t, x: f(x), (0, 5), x, events=lambda t, x: x[1], **TIGHT)
    late = np.argmax(run.t_events[0] > 2.0)
    return run.y_events[0][late], run.t_events[0][late]


def extrapolated(g, h):
    """g(0) of an even function, from two steps."""
    return (4 * g(h / 2) - g(h)) / 3


def radial_map(at, R, power, h=0.02):
    """(r1 - r)/(r - r0)^power and d(return time)/dr at the cycle r0^2 = R, both per period."""
    period = at.cycle(R).period

    def step(d):
        x, t = returned(at.system, [R**0.5 + d, 0.0])
        return np.array([x[0] - R**0.5 - d, t])

    def growth(d):
        return (step(d) + (-1) ** power * step(-d))[0] / (2 * d**power * period)

    def slope(d):
        return (step(d) - step(-d))[1] / (2 * d * period)

    return extrapolated(growth, h), extrapolated(slope, h)


def test_fold_of_cycles_from_its_return_map():
    """xi = relative return time is what makes dtau/dt = 1 - xi; then xi1 = xi0 + b T xi0^2."""
    at = bautin().at_fold(0.5)
    growth, slope = radial_map(at, 0.5, 2)
    assert growth / slope == pytest.approx(at.lpc_coefficient(0.5), rel=1e-5)


def test_cusp_of_cycles_from_its_return_map():
    at = cusp_of_cycles()
    growth, slope = radial_map(at, 1.0, 3)
    assert growth / slope**2 == pytest.approx(at.cusp_coefficient(), rel=1e-4)
    assert at.lpc_coefficient(at.cusp) == pytest.approx(0.0, abs=1e-12)


def test_period_doubling_from_its_return_map():
    """xi1 = -(xi0 + c T xi0^3 + ...) with the c of a unit vector v."""
    oracle = TwistedBand()
    period = oracle.cycle().period

    def cubic(xi):
        x, _ = returned(oracle.system, [1 + xi, 0.0, 0.0])
        return -(x[0] - 1 + xi) / xi**3 / period

    assert extrapolated(cubic, 0.05) / period == pytest.approx(oracle.cycle().coefficient, rel=1e-4)


def test_motion_on_the_torus():
    oracle = TorusBirth(mu=0.05)
    f, t = written_out(oracle.system), np.linspace(0.0, 20.0, 5)
    run = solve_ivp(lambda _, x: f(x), (0, 20), oracle.torus(t[:1])[0], t_eval=t, **TIGHT)
    np.testing.assert_allclose(run.y.T, oracle.torus(t), atol=1e-9)


# --- equilibria -----------------------------------------------------------------------------------


def residual(oracle, x):
    return np.abs(written_out(oracle.system)(x)).max()


def lyapunov(system, frequency):
    """FLC at the origin."""
    zero = np.zeros(system.n)
    return first_lyapunov(
        system, zero, system.p(), critical_pair(jacobian(system, zero), frequency)
    )


def second_lyapunov_of_odd_field(system, frequency):
    """SLC = Re <p, E + 6 C(q,q-,h21) + 3 C(q,q,h21-) + C(q-,q-,h30)>/12."""
    zero, one = np.zeros(system.n), np.eye(system.n)
    pair = critical_pair(jacobian(system, zero), frequency)
    A, q, p, conj = pair.jacobian, pair.q, pair.p, pair.q.conj()

    def form(*directions):
        return system.form(zero, None, *directions)

    border = np.block([[A - 1j * frequency * one, q[:, None]], [p.conj()[None], np.zeros((1, 1))]])
    cubic = form(q, q, conj)
    h21 = np.linalg.solve(border, np.append(np.vdot(p, cubic) * q - cubic, 0))[:-1]
    h30 = np.linalg.solve(3j * frequency * one - A, form(q, q, q))
    r32 = form(q, q, q, conj, conj) + 6 * form(q, conj, h21)
    return np.vdot(p, r32 + 3 * form(q, q, h21.conj()) + form(conj, conj, h30)).real / 12


@CHANGES
@pytest.mark.parametrize("count", [1, 3])
def test_lyapunov_coefficients_of_the_oscillators(change, count):
    hopf_point, degenerate = bautin(0.0, 0.5, count), bautin(0.0, 0.0, count)
    system = change(hopf_point.cycle(0.5)).system
    assert lyapunov(system, 2.0) == pytest.approx(hopf_point.flc, rel=1e-12)
    system = change(degenerate.cycle(0.5)).system
    assert lyapunov(system, 2.0) == pytest.approx(0.0, abs=1e-13)
    assert second_lyapunov_of_odd_field(system, 2.0) == pytest.approx(degenerate.slc, rel=1e-12)


def test_fold_curve_of_the_bautin_form():
    at = bautin().at_fold(0.25)
    assert at.b2**2 + 4 * at.b1 == pytest.approx(0.0, abs=1e-15)
    assert at.b2 / 2 == pytest.approx(0.25, rel=1e-15)


@pytest.mark.parametrize(
    ("form", "count"),
    [
        (exact.fold(), 2),
        (exact.fold(0.1), 0),
        (exact.transcritical(), 2),
        (exact.pitchfork(), 3),
        (exact.pitchfork(-0.1), 1),
        (exact.cusp(0.005), 3),
        (exact.cusp(0.5), 1),
    ],
)
def test_equilibria_of_static_forms(form, count):
    assert len(form.equilibria()) == count
    assert all(residual(form, x) < 1e-13 for x in form.equilibria())


@pytest.mark.parametrize("form", [exact.fold(), exact.cusp(), exact.StaticForm(a=0.7, c=-0.4)])
@pytest.mark.parametrize("x", [-0.3, 0.0, 0.2])
def test_folds_of_static_forms(form, x):
    at, state = form.at_fold(x), np.array([x, x**2])
    assert residual(at, state) < 1e-15
    assert np.linalg.det(jacobian(at.system, state)) == pytest.approx(0.0, abs=1e-15)


def test_folds_of_the_cusp_form():
    at = exact.cusp().at_fold(0.3)
    assert 27 * at.p1**2 == pytest.approx(4 * at.p2**3, rel=1e-14)


def test_coefficients_of_static_forms():
    zero, q = np.zeros(2), np.array([1.0, 0.0])
    fold, cusp = exact.StaticForm(a=0.7).system, exact.StaticForm(c=-0.4).system
    assert fold.form(zero, None, q, q)[0] / 2 == pytest.approx(0.7)
    h = np.array([0.0, cusp.form(zero, None, q, q)[1]])  # -A h = B(q, q) off the null vector
    cubic = cusp.form(zero, None, q, q, q) + 3 * cusp.form(zero, None, q, h)
    assert cubic[0] / 6 == pytest.approx(-0.4)


@pytest.mark.parametrize("s", [-1.0, 1.0])
def test_bogdanov_takens(s):
    at_hopf, inside = BogdanovTakens(s=s), BogdanovTakens(b1=-0.1, s=s)
    w = at_hopf.frequency
    assert_eigenvalues(jacobian(at_hopf.system, np.zeros(2)), [1j * w, -1j * w], 1e-14)
    assert lyapunov(at_hopf.system, w) == pytest.approx(at_hopf.flc, rel=1e-12)
    focus, saddle = inside.equilibria()
    assert max(residual(inside, focus), residual(inside, saddle)) < 1e-15
    assert np.linalg.det(jacobian(inside.system, saddle)) < 0
    assert np.linalg.det(jacobian(inside.system, focus)) > 0


def test_folds_of_the_bogdanov_takens_form():
    merged = BogdanovTakens(b1=0.25 * 0.4**2, b2=-0.4)
    np.testing.assert_allclose(merged.equilibria(), [[0.2, 0.0]] * 2, atol=1e-8)
    assert len(BogdanovTakens(b1=0.05, b2=-0.4).equilibria()) == 0


def test_zero_hopf_equilibria():
    at = ZeroHopf().at_hopf(0.1)
    x = at.equilibria()[1]
    assert residual(at, x) < 1e-15
    assert_eigenvalues(jacobian(at.system, x), [2j, -2j, 0.2], 1e-14)


def test_hopf_hopf_equilibrium():
    system = HopfHopf(b1=0.0, b2=0.0).system
    assert_eigenvalues(jacobian(system, np.zeros(4)), [2j, -2j, 0.7j, -0.7j], 1e-14)
    assert lyapunov(system, 2.0) == pytest.approx(-2.0, rel=1e-12)
    assert lyapunov(system, 0.7) == pytest.approx(-3.0, rel=1e-12)


# --- systems without a closed form ----------------------------------------------------------------


@pytest.mark.parametrize("mu", VAN_DER_POL)
def test_van_der_pol_cycle(mu):
    """LSODA, whose tightest tolerance is good for eleven digits, against the Taylor series."""
    period, speed, log_multiplier = VAN_DER_POL[mu]
    f = written_out(exact.van_der_pol(mu))

    def field(_, x):
        return [*f(x[:2]), mu * (1 - x[0] ** 2)]

    def passage(_, x):
        return x[0]

    start = [0.0, speed, 0.0]
    tight = {"method": "LSODA", "rtol": 1e-13, "atol": 1e-14, "events": passage}
    run = solve_ivp(field, (0, 1.1 * period), start, **tight)
    t, x = run.t_events[0][-1], run.y_events[0][-1]
    assert t == pytest.approx(period, rel=1e-10)
    assert x[1] == pytest.approx(speed, rel=1e-10)
    assert x[2] == pytest.approx(log_multiplier, rel=1e-10)


def test_van_der_pol_chain_in_phase():
    period, speed, _ = VAN_DER_POL[1.0]
    start = np.tile([0.0, speed], 3)
    end, Phi = flow(exact.van_der_pol(1.0, count=3).with_values(coupling=0.2), start, period)
    np.testing.assert_allclose(end, start, atol=1e-10)
    assert np.linalg.det(Phi) < np.exp(-7)


@pytest.mark.parametrize("cycle", [LORENZ_AB, LORENZ_BPC], ids=["AB", "symmetry breaking"])
def test_lorenz_cycle_of_known_symmetry(cycle):
    signs, start = np.array([-1, -1, 1]), np.array(cycle.state)
    end, Phi = flow(exact.lorenz(cycle.parameter), start, cycle.period / 2)
    np.testing.assert_allclose(signs * end, start, rtol=1e-11)
    eigenvalues = np.linalg.eigvals(signs[:, None] * Phi)
    assert np.abs(eigenvalues - 1).min() < 1e-9
    assert np.abs(eigenvalues - (cycle.half or 1)).min() < 1e-9


def test_lorenz_hopf_points():
    r, w = exact.lorenz_hopf()
    x = (8 / 3 * (r - 1)) ** 0.5
    A = jacobian(exact.lorenz(r), np.array([x, x, r - 1]))
    assert_eigenvalues(A, [1j * w, -1j * w, np.trace(A)], 1e-10)


def test_adaptive_control_hopf_point():
    system = exact.adaptive_control(alpha=1.0)
    assert_eigenvalues(jacobian(system, np.zeros(3)), [1j, -1j, -1.0], 1e-14)
    assert lyapunov(system, 1.0) == pytest.approx(ADAPTIVE_CONTROL_FLC, rel=1e-12)


def test_adaptive_control_period_doubling():
    """Multiplier -1 at MATCONT's point; the coefficient that it prints otherwise normalised."""
    known = ADAPTIVE_CONTROL_PD
    system, start = exact.adaptive_control(known.parameter), np.array(known.state)
    end, Phi = flow(system, start, known.period)
    np.testing.assert_allclose(end, start, atol=1e-10)
    assert np.abs(np.linalg.eigvals(Phi) - known.multiplier).min() < 1e-9
    f = written_out(system)

    def state(s):
        t = s * known.period
        return solve_ivp(lambda _, x: f(x), (0, known.period), start, t_eval=t, **TIGHT).y.T

    found = doubling_mode(ExactCycle(system, known.period, state, ()))
    assert found.c / known.period == pytest.approx(known.coefficient, abs=5e-5)
