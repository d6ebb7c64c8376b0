"""Exact derivatives: against closed forms, against sympy, and against each other."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tests.systems import toy_wheelset
from wheelset.bifurcation.fields.field import Condition, VectorField, vector_field
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite
from wheelset.bifurcation.system import System


def every_operation(x, p):
    """A field that uses every rule of the tape."""
    a, b = x
    k, q = p
    return [
        sp.exp(a * b) / (1 + a**2) + sp.log(2 + b) * sp.sin(k * a) - b**-3 * sp.tan(a / 3),
        sp.cosh(b) * sp.sqrt(1 + a**2) ** q
        + sp.Piecewise((a**3 * b, a < b), (a**2 + b**5 / 7, True))
        - sp.cos(a - 2 * b) ** 2
        + sp.Float(1.5),
    ]


@pytest.fixture(scope="module")
def system():
    return System.from_function(every_operation, ("a", "b"), {"k": 1.3, "q": 2.4})


POINTS = [(0.3, 0.8), (0.9, 0.4), (-0.5, 1.7)]


def chosen(cases, state, x):
    """The branch of a piecewise expression that holds at x."""
    at = dict(zip(state, x, strict=True))
    return next(value for value, condition in cases if condition == True or condition.subs(at))  # noqa: E712


def symbolic_form(field: VectorField, values, x, *directions):
    """The same form by repeated symbolic differentiation along the directions."""
    t = sp.symbols(f"t:{len(directions)}")
    shift = {
        s: sp.Float(xi, 40)
        + sum(ti * sp.Float(d[i], 40) for ti, d in zip(t, directions, strict=True))
        for i, (s, xi) in enumerate(zip(field.state, x, strict=True))
    }
    numbers = {q: sp.Float(values[q.name], 40) for q in field.parameters}
    out = []
    for expression in field.derivative:
        e = expression.replace(sp.Piecewise, lambda *cases: chosen(cases, field.state, x))
        e = e.subs(numbers).subs(shift)
        for ti in t:
            e = e.diff(ti)
        out.append(complex(e.subs(dict.fromkeys(t, 0)).evalf(30)))
    return np.array(out)


@pytest.mark.parametrize("x", POINTS)
@pytest.mark.parametrize("order", [1, 2, 3])
def test_forms_equal_symbolic_differentiation(system, x, order):
    rng = np.random.default_rng(order)
    directions = rng.normal(size=(order, 2))
    expected = symbolic_form(system.field, system.values, x, *directions)
    np.testing.assert_allclose(system.form(x, None, *directions), expected.real, rtol=1e-12)


def test_complex_directions_are_linear(system):
    u, w = np.array([1.0, 2.0]), np.array([-0.5, 0.3])
    z = system.form(POINTS[0], None, u + 1j * w, u - 1j * w)
    real = system.form(POINTS[0], None, u, u) + system.form(POINTS[0], None, w, w)
    np.testing.assert_allclose(z, real, rtol=1e-13)


@pytest.mark.parametrize("x", POINTS)
def test_compiled_jacobian_equals_nilpotent_derivatives(system, x):
    _, jacobian = system.evaluate(x, by=("a", "b", "k", "q"))
    columns = [system.form(x, None, d) for d in np.eye(4)]
    np.testing.assert_allclose(jacobian, np.transpose(columns), rtol=1e-13, atol=1e-14)


def test_three_evaluators_give_one_field(system):
    a, b = np.transpose(POINTS)
    arrays = system.quantities(["da/dt", "db/dt"], a=a, b=b)
    lambdified = sp.lambdify(
        [*system.field.state, *system.field.parameters], system.field.derivative
    )
    expected = [lambdified(*x, 1.3, 2.4) for x in POINTS]
    np.testing.assert_allclose(system.rhs(POINTS), expected, rtol=1e-13)
    np.testing.assert_allclose(np.transpose(list(arrays.values())), expected, rtol=1e-13)


def test_fifth_order_of_a_monomial_is_its_factorial():
    power = System.from_function(lambda x, p: [p[0] * x[0] ** 5], ("x",), {"c": 2.0})
    assert power.form([0.7], None, *[[1.0]] * 5) == pytest.approx([240.0], rel=1e-14)


def test_an_infinite_derivative_is_an_outcome_in_real_and_complex_directions():
    root = System.from_function(lambda x, p: [sp.sqrt(x[0]) * p[0]], ("x",), {"c": 1.0})
    for direction in ([1.0], [1.0j]):
        with pytest.raises(NotFinite, match="x = 0"):
            root.form([0.0], None, direction)


def test_points_are_independent_of_batch():
    toy = toy_wheelset()
    X = np.random.default_rng(1).normal(size=(7, 4)) * [1e-3, 1e-3, 0.1, 0.1]
    F, J = toy.evaluate(X)
    for i, x in enumerate(X):
        f, jacobian = toy.evaluate(x)
        np.testing.assert_array_equal(F[i], f)
        np.testing.assert_array_equal(J[i], jacobian)


class TestOutcomes:
    def guarded(self):
        x, c = sp.symbols("x c", real=True)
        depth = sp.Symbol("depth", real=True)
        field = VectorField(
            (x,), (c,), (sp.sqrt(depth),), ((depth, c - x),),
            (Condition(depth, "depth", "of the well", "m"),),
        )  # fmt: skip
        return System(field, {"c": 1.0})

    def test_domain_left_names_quantity_place_value_and_state(self):
        with pytest.raises(DomainLeft) as left:
            self.guarded().rhs([1.5])
        assert (left.value.quantity, left.value.where, left.value.value) == (
            "depth",
            "of the well",
            -0.5,
        )
        assert left.value.state == (1.5,)
        assert "depth, of the well = -0.5 m must exceed 0 at x = 1.5" in str(left.value)

    @pytest.mark.parametrize(
        "evaluate",
        [
            lambda s: s.rhs([[0.0], [2.0]]),
            lambda s: s.jacobian([2.0]),
            lambda s: s.form([2.0], None, [1.0]),
            lambda s: s.quantities(["depth"], x=np.array([0.0, 2.0])),
        ],
    )
    def test_every_route_reports_it(self, evaluate):
        with pytest.raises(DomainLeft, match="x = 2"):
            evaluate(self.guarded())

    def test_overflow_is_an_outcome_not_an_infinity(self):
        system = System.from_function(lambda x, p: [sp.exp(p[0] * x[0])], ("x",), {"c": 1e3})
        with pytest.raises(NotFinite, match="x = 5"):
            system.rhs([5.0])
        with pytest.raises(NotFinite):
            system.form([5.0], None, [1.0])

    def test_a_model_that_is_not_a_number(self):
        system = System.from_function(lambda x, p: [sp.log(x[0]) * p[0]], ("x",), {"c": 1.0})
        with pytest.raises(NotFinite):
            system.rhs([-1.0])


class TestBadInput:
    def test_unknown_symbol_names_the_place(self):
        x, c = sp.symbols("x c", real=True)
        with pytest.raises(ValueError, match="unknown symbol c in the derivative of x"):
            VectorField((x,), (), (c * x,))

    def test_missing_value(self):
        with pytest.raises(ValueError, match="no value for parameter c"):
            System(vector_field(lambda x, p: [p[0] * x[0]], ("x",), ("c",)), {})

    def test_unknown_parameter_lists_the_known_ones(self, system):
        with pytest.raises(ValueError, match="unknown parameter 'kk'; it has k, q"):
            system.p(kk=1.0)

    def test_unknown_function_is_named(self):
        with pytest.raises(ValueError, match="no rule for besselj"):
            System.from_function(lambda x, p: [sp.besselj(0, x[0]) + p[0]], ("x",), {"c": 1.0})

    def test_wrong_number_of_derivatives(self):
        x, y = sp.symbols("x y", real=True)
        with pytest.raises(ValueError, match="1 derivatives for 2 state variables"):
            VectorField((x, y), (), (x,))
