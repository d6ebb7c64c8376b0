"""The second Lyapunov coefficient against codes, normal forms and exact centre manifolds."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp

from tests.exact_systems import bautin
from tests.systems import hopf_normal_form, toy_wheelset
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.lyapunov import CriticalPair, critical_pair, first_lyapunov
from wheelset.bifurcation.equilibria.second_lyapunov import second_lyapunov
from wheelset.bifurcation.fields.field import Condition, VectorField
from wheelset.bifurcation.outcomes import DomainLeft
from wheelset.bifurcation.system import System

#: Toy wheelset at its GH point: MATCONT to its print, AUTO (the point).
TOY_A3, TOY_SLC = 0.0234438188506, -0.130504562189


def pair_at_origin(system: System, frequency: float) -> CriticalPair:
    """Without compiling anything: the Jacobian from first forms."""
    x, p = np.zeros(system.n), system.p()
    A = np.column_stack([system.form(x, p, unit) for unit in np.eye(system.n)])
    return critical_pair(A, frequency)


def coefficients(system: System, frequency: float) -> tuple[float, float]:
    x, p, pair = np.zeros(system.n), system.p(), pair_at_origin(system, frequency)
    return first_lyapunov(system, x, p, pair), second_lyapunov(system, x, p, pair)


def rotating(x, y, w, a5, b3, b5):
    """r' = a5 r^5, phi' = w + b3 r^2 + b5 r^4: FLC = 0 and, with |q| = 1, SLC = 4 a5."""
    r2 = x**2 + y**2
    grow, turn = a5 * r2**2, w + b3 * r2 + b5 * r2**2
    return [grow * x - turn * y, turn * x + grow * y]


@cache
def toy() -> tuple[System, float]:
    """The toy wheelset at its generalized Hopf point, and the frequency there."""
    system = toy_wheelset(TOY_A3)
    hopf = hopf_point(system, "v", 50.0)
    return system.with_values(v=hopf.value), hopf.frequency


class TestOddFields:
    def test_toy_wheelset(self):
        """a3 is known to 12 digits."""
        assert coefficients(*toy())[1] == pytest.approx(TOY_SLC, rel=1e-9)

    def test_the_short_formula_for_odd_fields(self):
        """With B = D = 0, as in the literature for such fields, written out independently."""
        system, w = toy()
        x, p, pair = np.zeros(4), system.p(), pair_at_origin(system, w)
        A, q, adjoint = pair.jacobian, pair.q, pair.p
        C = lambda *v: system.form(x, p, *v)  # noqa: E731
        r = q.conj()
        c1 = np.vdot(adjoint, C(q, q, r)) / 2
        h30 = np.linalg.solve(3j * w * np.eye(4) - A, C(q, q, q))
        bordered = np.block(
            [[A - 1j * w * np.eye(4), q[:, None]], [adjoint.conj()[None], np.zeros((1, 1))]]
        )
        h21 = np.linalg.solve(bordered, np.append(2 * c1 * q - C(q, q, r), 0))[:4]
        r32 = C(q, q, q, r, r) + 6 * C(q, r, h21) + 3 * C(q, q, h21.conj()) + C(r, r, h30)
        exact = np.vdot(adjoint, r32).real / 12
        assert second_lyapunov(system, x, p, pair) == pytest.approx(exact, rel=1e-10)

    def test_bautin_normal_form(self):
        exact = bautin(b1=0.0, b2=0.0)
        flc, slc = coefficients(exact.system, exact.w)
        assert flc == pytest.approx(0.0, abs=1e-15)
        assert slc == pytest.approx(exact.slc, rel=1e-13)

    def test_units_of_the_state_scale_it_by_the_fourth_power(self):
        """In millimetres |q| = 1 is a thousandth of the amplitude."""
        system, w = toy()
        mm = 1000

        def f(y, p):
            values = dict(zip((*system.field.state, *system.field.parameters), (*y, *p)))  # noqa: B905
            small = {s: values[s] / mm for s in system.field.state}
            return [mm * e.xreplace(values | small) for e in system.field.derivative]

        scaled = System.from_function(f, system.state_names, system.values)
        assert coefficients(scaled, w)[1] * mm**4 == pytest.approx(TOY_SLC, rel=1e-9)


class TestEvenTerms:
    """B and D do not vanish, and the answer is known."""

    @pytest.mark.parametrize("seed", range(3))
    def test_slaved_directions(self, seed):
        """z_j = h_j(x, y) on the manifold, exactly; what the z_j do to x and y vanishes on it.

        z' = Dh . (x', y') + M (z - h); x' and y' get products with z - h. Every form from the
        second to the fifth takes part, and none of it may show: SLC = 4 a5.
        """
        rng = np.random.default_rng(seed)
        w, a5, b3, b5 = 1.3, -0.7, 0.6, 0.4
        monomials = [(i, d - i) for d in (2, 3, 4) for i in range(d + 1)]
        h_of = rng.normal(size=(2, len(monomials))).round(2)
        M, push = rng.normal(size=(2, 2)).round(2) - 2 * np.eye(2), rng.normal(size=(2, 2, 3))

        def f(state, p):
            x, y, *z = state
            h = [sum(c * x**i * y**j for c, (i, j) in zip(row, monomials)) for row in h_of]  # noqa: B905
            off = [one - other for one, other in zip(z, h, strict=True)]
            plane = rotating(x, y, w, a5, b3, b5)
            plane = [
                e + sum(o * (g[0] + g[1] * x + g[2] * z[0] * y) for o, g in zip(off, push[k]))  # noqa: B905
                for k, e in enumerate(plane)
            ]
            moved = [sp.diff(e, x) * plane[0] + sp.diff(e, y) * plane[1] for e in h]
            return [*plane, *(m + M[k] @ np.array(off) for k, m in enumerate(moved))]

        system = System.from_function(f, ("x", "y", "z1", "z2"), {"unused": 0.0})
        flc, slc = coefficients(system, w)
        assert flc == pytest.approx(0.0, abs=1e-12)
        assert slc == pytest.approx(4 * a5, rel=1e-11)

    @pytest.mark.parametrize("seed", range(2))
    def test_other_coordinates(self, seed):
        """x = (linear map) of y + Q(y), a random quadratic and cubic Q: z -> z / |S q| in size.

        f(y) = (I + DQ)^-1 S^-1 g(S (y + Q)) is rational; even and odd forms of every order.
        """
        rng = np.random.default_rng(seed)
        w, a5 = 1.7, 0.5
        S = np.array([[1.5, 0.4], [-0.3, 0.8]])
        monomials = [(i, d - i) for d in (2, 3) for i in range(d + 1)]
        Q_of = rng.normal(size=(2, len(monomials))).round(2)

        def f(y, p):
            u, v = y
            Q = [sum(c * u**i * v**j for c, (i, j) in zip(row, monomials)) for row in Q_of]  # noqa: B905
            new = [u + Q[0], v + Q[1]]
            turned = [S[k, 0] * new[0] + S[k, 1] * new[1] for k in (0, 1)]
            g = np.linalg.inv(S) @ np.array(rotating(*turned, w, a5, 0.3, -0.2))
            (a, b), (c, d) = [[sp.diff(e, s) for s in (u, v)] for e in new]
            det = a * d - b * c
            return [(d * g[0] - b * g[1]) / det, (a * g[1] - c * g[0]) / det]

        system = System.from_function(f, ("u", "v"), {"unused": 0.0})
        flc, slc = coefficients(system, w)
        size = np.linalg.norm(S @ pair_at_origin(system, w).q)
        assert flc == pytest.approx(0.0, abs=1e-13)
        assert slc == pytest.approx(4 * a5 * size**4, rel=1e-11)

    @pytest.mark.parametrize("order", [2, 3, 4, 5])
    def test_every_form_counts(self, order):
        """Without any one of them the answer is another one."""
        system = _even_and_odd()
        x, p, pair = np.zeros(2), system.p(), pair_at_origin(system, 1.0)
        whole = second_lyapunov(system, x, p, pair)
        assert second_lyapunov(_Without(system, order), x, p, pair) != pytest.approx(
            whole, rel=1e-3
        )


def _even_and_odd() -> System:
    def f(s, p):
        x, y = s
        more = x**2 + x * y + x**3 + x**2 * y**2 + x**4 + x**5
        return [-y + more, x + y**2 - x * y + y**3 + x * y**3 + x**4 * y]

    return System.from_function(f, ("x", "y"), {"unused": 0.0})


class _Without:
    """A system one of whose forms is taken for zero."""

    def __init__(self, system: System, order: int) -> None:
        self.system, self.order, self.n = system, order, system.n

    def form(self, x, p, *directions):
        there = self.system.form(x, p, *directions)
        return there * (len(directions) != self.order)


def test_a_field_without_a_fifth_derivative_says_so():
    """|x|^3 x stands for any law that is only piecewise smooth; here a declared condition."""
    x, y, gap, unused = sp.symbols("x y gap unused", real=True)
    field = VectorField(
        (x, y), (unused,), (-y, x), ((gap, x**2),), (Condition(gap, "gap", order=5, unit="m2"),)
    )
    system = System(field, {"unused": 0.0})
    pair = pair_at_origin(system, 1.0)
    assert math.isfinite(first_lyapunov(system, np.zeros(2), system.p(), pair))
    with pytest.raises(DomainLeft, match="gap"):
        second_lyapunov(system, np.zeros(2), system.p(), pair)


def test_a_cubic_normal_form_has_none():
    """r' = a r^3 exactly: the fifth order vanishes, whatever the twist."""
    assert coefficients(hopf_normal_form(a=-1.0, b=0.5), 2.0)[1] == pytest.approx(0.0, abs=1e-13)
