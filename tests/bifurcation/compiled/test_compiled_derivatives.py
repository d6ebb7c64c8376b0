"""Machine code of a field: along any direction, in any batch, to second order, without outcome
unnamed. The reference is the nilpotent arithmetic of ``form``, the independent model, or calculus.
"""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from tests import independent_model
from tests.bifurcation.fields.test_derivatives import POINTS, every_operation
from tests.systems import toy_wheelset
from tests.vehicle.readings import reading
from tests.vehicle.test_equations import ASYMMETRIC, READINGS, SCALE
from wheelset.bifurcation.compiled import codegen, kernels
from wheelset.bifurcation.compiled.program import Argument, Op, Program, read
from wheelset.bifurcation.fields.field import Condition, Switch, VectorField
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle


class Expanded:
    """sin(3 y) by its Taylor coefficients; undefined beyond |y| = 2."""

    def taylor(self, y, order):
        j = np.arange(order + 1)
        factorial = np.cumprod(np.maximum(j, 1.0))
        out = np.sin(3 * y[..., None] + j * np.pi / 2) * 3.0**j / factorial
        return np.where(np.abs(y[..., None]) < 2, out, np.nan)


def sampled_system():
    """x' = c g(x) y, y' = g(x)^2 - d y, where g is sampled."""
    x, y, c, d = sp.symbols("x y c d", real=True)
    g = sp.Function("g")(x)
    field = VectorField((x, y), (c, d), (c * g * y, g**2 - d * y))
    return System(field, {"c": 1.5, "d": 0.4}, {"g": Expanded()})


def switched_system():
    """x' = y, y' = -x, less k (|x| - c) x^2 beyond |x| = c."""
    x, y, k, c, region = sp.symbols("x y k c region", real=True)
    beyond = region**2 * k * (region * x - c) * x**2
    switch = Switch(region, x, (-c, c), (-1.0, 0.0, 1.0))
    field = VectorField((x, y), (k, c, region), (y, -x - beyond), switch=switch)
    return System(field, {"k": 3.0, "c": 0.5})


def guarded_system():
    """Smooth on sides of thresholds, where the formulas of the other side do not exist."""
    return System.from_function(
        lambda x, p: [
            sp.Piecewise((p[0] * sp.sqrt(x[0] - 1) * x[1], x[0] > 1), (p[0] * x[1] ** 3, True))
            + sp.Piecewise((x[1] ** 2 * sp.log(p[0] - 1), x[1] > 9), (x[0], True)),
            sp.Piecewise(
                (x[0] ** 2, x[0] > 3),
                (sp.sqrt(3 - x[0]) * x[1], x[0] > 1),
                (1 / sp.sqrt(1 - x[0]) + sp.log(3 - x[0]), True),
            ),
        ],
        ("x", "y"),
        {"c": 0.7},
    )


def paper_system():
    return hunting_system(load_vehicle("guo2021", overrides=["flange_law=exponential"]))


def wheelset():
    """Saturated, with spin moment, flange, damping and every coefficient of asymmetry."""
    options, values = READINGS["saturated, spin moment, reciprocal"]
    return reading(options, values | ASYMMETRIC)


SYSTEMS = {
    "every operation": lambda: System.from_function(
        every_operation, ("a", "b"), {"k": 1.3, "q": 2.4}
    ),
    "sampled": sampled_system,
    "switched": switched_system,
    "guarded": guarded_system,
    "wheelset": lambda: hunting_system(wheelset()),
}
STATES = {
    "every operation": np.array(POINTS),
    "sampled": np.array([[0.3, 1.0], [-1.2, 0.4]]),
    "switched": np.array([[0.2, 1.0], [0.8, -0.3], [-0.9, 0.1], [0.1, 0.1]]),
    "guarded": np.array([[2.0, 0.6], [0.5, -0.8], [3.5, 0.3]]),
}


@pytest.fixture(scope="module", params=SYSTEMS)
def case(request):
    """A system, states, and random directions: v, psi a row a state, D two of the parameters."""
    system, rng = SYSTEMS[request.param](), np.random.default_rng(7)
    X = STATES.get(request.param, rng.uniform(-1, 1, (5, 4)) * SCALE)
    v, psi = rng.normal(size=(2, *X.shape)) * (SCALE if system.n == 4 else 1.0)
    D = rng.normal(size=(2, len(system.parameter_names))) * system.p()
    return system, X, v, psi, D


def in_full(system, D):
    """Unit vectors of the states and the directions of the parameters, each of length n + m."""
    n = system.n
    return np.block([[np.eye(n), np.zeros((n, D.shape[1]))], [np.zeros((len(D), n)), D]])


def assert_close(got, expected, tolerance=1e-12):
    """To a tolerance relative to the largest entry of each column."""
    scale = np.maximum(np.abs(expected).max(axis=0), 1e-300)
    np.testing.assert_allclose(got / scale, expected / scale, rtol=0, atol=tolerance)


def test_jacobian_along_directions_equals_the_forms(case):
    system, X, _, _, D = case
    f, jacobian = system.evaluate(X, along=D)
    expected = [system.forms(X, None, e) for e in in_full(system, D)]
    assert_close(jacobian, np.moveaxis(expected, 0, -1))
    assert_close(f, system.forms(X, None))


def test_curvature_equals_the_second_forms(case):
    system, X, v, psi, D = case
    expected = [np.sum(psi * system.forms(X, None, v, e), axis=1) for e in in_full(system, D)]
    assert_close(system.curvature(X, None, v, psi, D), np.transpose(expected), 1e-11)


def test_curvature_is_the_slope_of_the_jacobian(case):
    """Central differences of psi . J v, whose error is of the order of the step squared."""
    system, X, v, psi, D = case
    rng, step = np.random.default_rng(1), 1e-5
    move, turn = rng.normal(size=X.shape) * np.abs(X).max(axis=0), rng.normal(size=len(D))
    ahead, behind = (
        system.evaluate(X + h * move, system.p() + h * turn @ D)[1] for h in (step, -step)
    )
    slope = np.einsum("ij,ijk,ik->i", psi, (ahead - behind) / (2 * step), v)
    gradient = system.curvature(X, None, v, psi, D)
    terms = gradient * np.concatenate([move, np.tile(turn, (len(X), 1))], axis=1)
    np.testing.assert_allclose(
        slope, terms.sum(axis=1), rtol=0, atol=1e-5 * np.abs(terms).sum(axis=1).max()
    )


def test_the_three_kernels_agree_and_write_in_place(case):
    system, X, v, psi, D = case
    p, F, G = system.p(), np.empty_like(X), np.empty((len(X), system.n + 2))
    f, jacobian = np.empty_like(X), np.empty((*X.shape, system.n + 2))
    assert system.field_kernel()(X, p, F) is None
    assert system.jacobian_kernel(2)(X, p, D, f, jacobian) is None
    assert system.curvature_kernel(2)(X, p, D, v, psi, G) is None
    np.testing.assert_array_equal(F, f)
    np.testing.assert_array_equal(jacobian, system.evaluate(X, p, along=D)[1])
    np.testing.assert_array_equal(G, system.curvature(X, p, v, psi, D))


class TestAgainstTheIndependentModel:
    """At 40 digits, by the states and along two directions of all parameters."""

    @pytest.fixture
    def model(self):
        system, vehicle, rng = hunting_system(wheelset()), wheelset(), np.random.default_rng(8)
        options = vehicle.options.model_dump()
        names, D = system.parameter_names, rng.normal(size=(2, len(system.parameter_names)))
        D *= 0.01 * system.p()

        def derivative(z):
            """f at the state z[:4] and p + z[4] D[0] + z[5] D[1], and zeros: as long as z."""
            q = {name: mp.mpf(value) for name, value in vehicle.values.items()}
            shift = dict(zip(names, z[4] * D[0] + z[5] * D[1], strict=True))
            q |= {name: mp.mpf(system.values[name]) + shift[name] for name in names}
            return [*independent_model.derivative(z[:4], q["v"], q, options), mp.mpf(0), mp.mpf(0)]

        return system, derivative, D

    def form(self, derivative, x, *directions):
        out = independent_model.multilinear_form(derivative, [*x, 0, 0], *directions, digits=40)
        return np.array([float(value) for value in out[:4]])

    def test_jacobian(self, model):
        system, derivative, D = model
        x, units = 0.7 * SCALE, np.diag([*SCALE, 1.0, 1.0])
        expected = np.transpose([self.form(derivative, x, e) for e in units])
        assert_close(system.evaluate(x, along=D)[1] @ units, expected)

    def test_curvature(self, model):
        system, derivative, D = model
        x, units, rng = 0.7 * SCALE, np.diag([*SCALE, 1.0, 1.0]), np.random.default_rng(3)
        v, psi = rng.normal(size=4) * SCALE, rng.normal(size=4)
        expected = [psi @ self.form(derivative, x, [*v, 0, 0], e) for e in units]
        got = system.curvature(x, None, v, psi, D) @ units
        np.testing.assert_allclose(got, expected, rtol=1e-10)


class TestBatches:
    def test_a_point_does_not_depend_on_its_neighbours(self):
        toy, rng = toy_wheelset(), np.random.default_rng(1)
        X = rng.normal(size=(19, 4)) * SCALE
        D = rng.normal(size=(2, len(toy.parameter_names)))
        F, J = toy.evaluate(X, along=D)
        G = toy.curvature(X, None, X[::-1], X, D)
        for points in (slice(0, 1), slice(3, 11), slice(10, 19)):
            f, jacobian = toy.evaluate(X[points], along=D)
            np.testing.assert_array_equal(F[points], f)
            np.testing.assert_array_equal(J[points], jacobian)
            part = toy.curvature(X[points], None, X[::-1][points], X[points], D)
            np.testing.assert_array_equal(G[points], part)

    def test_more_directions_change_nothing_of_the_others(self):
        toy, rng = toy_wheelset(), np.random.default_rng(1)
        X, D = rng.normal(size=(3, 4)) * SCALE, rng.normal(size=(2, 14))
        wide, narrow = toy.evaluate(X, along=D), toy.evaluate(X)
        np.testing.assert_array_equal(wide[1][..., :4], narrow[1])
        gradients = [toy.curvature(X, None, X, X[::-1], along) for along in (D, None)]
        np.testing.assert_array_equal(gradients[0][:, :4], gradients[1])

    def test_no_points(self):
        f, jacobian = toy_wheelset().evaluate(np.empty((0, 4)))
        assert (f.shape, jacobian.shape) == ((0, 4), (0, 4, 4))

    def test_shape_of_the_states_is_kept(self):
        toy, D = toy_wheelset(), toy_wheelset().directions("v", "q")
        X = np.random.default_rng(2).normal(size=(2, 3, 4)) * SCALE
        f, jacobian = toy.evaluate(X, along=D)
        assert (f.shape, jacobian.shape) == ((2, 3, 4), (2, 3, 4, 6))
        np.testing.assert_array_equal(jacobian[1, 2], toy.evaluate(X[1, 2], along=D)[1])
        gradient = toy.curvature(X, None, X[0, 0], X, D)
        assert gradient.shape == (2, 3, 6)
        np.testing.assert_array_equal(
            gradient[1, 2], toy.curvature(X[1, 2], None, X[0, 0], X[1, 2], D)
        )

    def test_forms_at_many_points_are_the_forms_at_each(self):
        paper, rng = paper_system(), np.random.default_rng(5)
        X = rng.uniform(-1, 1, (4, 4)) * SCALE
        u, w = rng.normal(size=(2, 4, 4)) @ np.diag(SCALE)
        z = rng.normal(size=4 + len(paper.parameter_names)) * 1e-3
        for directions in ((u,), (u, w), (u, u + 1j * w, w[0]), (u, z), (z, w[1], u)):
            got = paper.forms(X, None, *directions)
            rows = [np.broadcast_to(d, (4, np.shape(d)[-1])) for d in directions]
            expected = [paper.form(X[i], None, *(r[i] for r in rows)) for i in range(4)]
            np.testing.assert_array_equal(got, expected)

    def test_forms_of_a_monomial(self):
        """D^3 (c x^5) [u, v, w] = 60 c x^2 u v w, and with one of them along c, 20 x^3 u v."""
        power = System.from_function(lambda x, p: [p[0] * x[0] ** 5], ("x",), {"c": 2.0})
        x = np.array([[0.5], [2.0]])
        np.testing.assert_allclose(
            power.forms(x, None, [1.0], [2.0], [[1j], [3.0]]),
            240 * x**2 * [[1j], [3.0]],
            rtol=1e-14,
        )
        mixed = power.forms(x, None, [1.0], [2.0], [0.0, 1.0])
        np.testing.assert_allclose(mixed, 40 * x**3, rtol=1e-14)


class TestDirections:
    def test_names_are_unit_directions(self):
        toy, x = toy_wheelset(), 0.3 * SCALE
        _, by = toy.evaluate(x, by=("v", "psi", "a3", "y"))
        _, along = toy.evaluate(x, along=toy.directions("v", "a3"))
        np.testing.assert_array_equal(by, along[:, [4, 1, 5, 0]])

    def test_a_parameter_that_does_not_act_has_no_slope(self):
        system = System.from_function(lambda x, p: [p[0] * x[0]], ("x",), {"c": 2.0, "unused": 1.0})
        _, jacobian = system.evaluate([3.0], along=[[1.0, 0.0], [0.0, 1.0]])
        np.testing.assert_array_equal(jacobian, [[2.0, 3.0, 0.0]])

    def test_one_kernel_for_all_directions(self):
        toy, x = toy_wheelset(), 0.3 * SCALE
        toy.evaluate(x, along=toy.directions("q", "m"))
        made = kernels.jacobian_kernel.cache_info().misses
        toy.with_values(v=30.0).evaluate(x, by=("Kx", "y", "v"))
        assert kernels.jacobian_kernel.cache_info().misses == made

    def test_bad_directions_are_named(self):
        toy = toy_wheelset()
        with pytest.raises(ValueError, match=r"directions of shape \(1, 3\); give rows of 14"):
            toy.evaluate(np.zeros(4), along=[[1.0, 0.0, 0.0]])
        with pytest.raises(ValueError, match="by names and along directions"):
            toy.evaluate(np.zeros(4), by=("y",), along=toy.directions("v"))
        with pytest.raises(ValueError, match="unknown parameter 'w'"):
            toy.directions("w")
        with pytest.raises(ValueError, match="a direction has 3 components; give 4"):
            toy.form(np.zeros(4), None, np.zeros(3))

    def test_arrays_that_do_not_fit_are_named(self):
        toy, X = toy_wheelset(), np.zeros((3, 4))
        with pytest.raises(ValueError, match=r"3 points need X \(3, 4\), p \(14,\), F \(3, 4\)"):
            toy.field_kernel()(X, toy.p(), np.empty((2, 4)))


def well(switch: bool = False) -> System:
    """x' = sqrt(c - x), whose second derivatives are only wanted for c - x > 1/4."""
    x, c, depth, side = sp.symbols("x c depth side", real=True)
    return System(
        VectorField(
            (x,),
            (c, side) if switch else (c,),
            (sp.sqrt(depth),),
            ((depth, c - x),),
            (
                Condition(depth, "depth", "of the well", "m"),
                Condition(depth, "depth", "to bend", "m", 0.25, order=2),
            ),
            Switch(side, x, (sp.Integer(0),), (0.0, 1.0)) if switch else None,
        ),
        {"c": 1.0},
    )


class TestOutcomes:
    @pytest.mark.parametrize("switch", [False, True])
    def test_the_first_point_outside_is_named(self, switch):
        system = well(switch)
        X = np.linspace(-1, 0.7, 20)[:, None]
        X[[12, 17], 0] = 1.5, 2.5
        for evaluate in (system.rhs, lambda X: system.curvature(X, None, X, X)):
            with pytest.raises(DomainLeft, match=r"of the well = -0.5 m must exceed 0 at x = 1.5"):
                evaluate(X)

    def test_curvature_keeps_the_conditions_of_second_derivatives(self):
        system = well()
        assert system.rhs([0.8]) == pytest.approx([np.sqrt(0.2)], rel=1e-15)
        with pytest.raises(DomainLeft, match=r"to bend = 0.2 m must exceed 0.25"):
            system.curvature([0.8], None, [1.0], [1.0])

    def test_forms_name_the_point(self):
        with pytest.raises(DomainLeft, match=r"to bend = 0.1 m must exceed 0.25 at x = 0.9"):
            well().forms([[0.2], [0.9]], None, [1.0], [1.0])
        assert well().forms([[0.2], [0.9]], None, [1.0]).shape == (2, 1)

    def test_beyond_the_samples(self):
        system = sampled_system()
        X = np.array([[0.1, 0.0], [2.5, 1.0]])
        for evaluate in (
            system.rhs,
            lambda X: system.curvature(X, None, X, X),
            lambda X: system.forms(X, None, X, X),
        ):
            with pytest.raises(NotFinite, match=r"outside its range at x = 2.5"):
                evaluate(X)

    def test_states_that_are_not_numbers(self):
        with pytest.raises(NotFinite):
            toy_wheelset().rhs([[0.0, 0.0, 0.0, 0.0], [np.nan, 0.0, 0.0, 0.0]])

    def test_symmetric_forces_cancel_to_the_last_bit(self):
        paper = paper_system()
        np.testing.assert_array_equal(paper.rhs(np.zeros(4)), 0.0)


class TestPrograms:
    """What is left out of the machine code."""

    def program(self):
        return Program((Argument("X", (2,)), Argument("p", (1,), each=False), Argument("F", (1,))))

    def test_structural_zeros_and_ones_disappear(self):
        g = self.program()
        x, zero, one = g.load("X", 0), g.constant(0), g.constant(1)
        assert g.add(x, zero) == g.multiply(one, x) == g.negate(g.negate(x)) == x
        assert g.multiply(x, zero) == g.divide(zero, x) == zero
        assert g.multiply(x, g.constant(-1)) == g.negate(x)
        y = g.load("X", 1)
        assert g.add(x, g.negate(y)) == g.node(Op.SUBTRACT, x, y)
        assert g.multiply(y, x) == g.multiply(x, y)

    def test_parameters_are_worked_on_once_a_call(self):
        system = System.from_function(lambda x, p: [sp.exp(p[0]) ** 2 * x[0]], ("x",), {"c": 1.0})
        g = kernels.jacobian(system.tape, 1)
        ops = {g.nodes[i].op for i in g.needed() if g.varies[i]}
        assert ops == {Op.LOAD, Op.MULTIPLY}
        assert sum(g.varies[i] for i in g.needed()) == 3  # x, c' x, and the slope of c' along D

    def test_a_listing_is_read_back(self):
        system = SYSTEMS["guarded"]()
        g = kernels.curvature(system.tape, 1)
        again = read(g.arguments, g.listing())
        assert again.listing() == read(again.arguments, again.listing()).listing()
        assert len(again.nodes) == len(g.needed())
        assert [again.nodes[n].op for _, _, n in again.stores] == [
            g.nodes[n].op for _, _, n in g.stores
        ]

    def test_modules_are_kept_and_used_again(self, tmp_path, monkeypatch):
        monkeypatch.setenv("WHEELSET_CACHE_DIR", str(tmp_path))
        g = kernels.values(System.from_function(lambda x, p: [-x[0]], ("x",), {"c": 1.0}).tape)
        codegen.compiled(g)
        (module,) = tmp_path.glob("kernel_*.py")
        codegen.compiled(g)
        assert list(tmp_path.glob("kernel_*.py")) == [module]
        assert list((tmp_path / "__pycache__").glob(f"{module.stem}*.nbc"))
        module.unlink()
