"""Second Lyapunov coefficient of a Hopf point, for any field, even terms included.

Kuznetsov, SIAM J. Numer. Anal. 36 (1999) 1104, and Elements of Applied Bifurcation Theory, section
8.7; in MATCONT's normalisation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.equilibria.lyapunov import CriticalPair, resolvent
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]
Vector = NDArray[Any]
Form = Callable[..., Vector]


class Manifold(NamedTuple):
    """Coefficients of the centre manifold sum h_jk z^j conj(z)^k / (j! k!), vectors (n,), and c1 of
    the normal form z' = i w z + c1 z |z|^2 + c2 z |z|^4.
    """

    h20: Vector
    h11: Vector
    c1: complex
    h30: Vector
    h21: Vector
    h31: Vector
    h22: Vector


def second_lyapunov(system: System, x: Array, p: Array, pair: CriticalPair) -> float:
    """SLC = Re c2 = 1/12 Re <p, r32> at a Hopf point (x, p), with exact fifth derivatives.

    For an odd field only E(q,q,q,q-,q-) + 6 C(q,q-,h21) + 3 C(q,q,h21-) + C(q-,q-,h30) is left of
    r32. It depends on the units of the state: |q| = 1 in SI; scaling q by s scales it by s^4.
    Independent of coordinates only where FLC = 0. Raises DomainLeft where the field has no fifth
    derivative, SingularSystem where a multiple of i w is an eigenvalue too.
    """

    def form(*directions: Vector) -> Vector:
        return system.form(x, p, *directions)

    manifold = centre_manifold(form, pair)
    return float(np.vdot(pair.p, _quintic(form, pair.q, manifold)).real / 12)


def centre_manifold(form: Form, pair: CriticalPair) -> Manifold:
    """The manifold's coefficients up to the fourth order, and c1."""
    q, r = pair.q, pair.q.conj()
    h20 = resolvent(pair, 2, form(q, q))
    h11 = resolvent(pair, 0, form(q, r)).real
    cubic = form(q, q, r) + form(r, h20) + 2 * form(q, h11)
    c1 = complex(np.vdot(pair.p, cubic)) / 2
    h30 = resolvent(pair, 3, form(q, q, q) + 3 * form(q, h20))
    h21 = _bordered(pair, cubic - 2 * c1 * q)
    h31 = resolvent(pair, 2, _h31_terms(form, q, h20, h11, h30, h21) - 6 * c1 * h20)
    h22 = resolvent(pair, 0, _h22_terms(form, q, h20, h11, h21) - 8 * c1.real * h11)
    return Manifold(h20, h11, c1, h30, h21, h31, h22.real)


def _h31_terms(form: Form, q: Vector, h20: Vector, h11: Vector, h30: Vector, h21: Vector) -> Vector:
    r = q.conj()
    return (
        form(q, q, q, r)
        + 3 * form(q, q, h11)
        + 3 * form(q, r, h20)
        + 3 * form(h20, h11)
        + form(r, h30)
        + 3 * form(q, h21)
    )


def _h22_terms(form: Form, q: Vector, h20: Vector, h11: Vector, h21: Vector) -> Vector:
    r = q.conj()
    one_sided = form(r, r, h20) + 2 * form(r, h21)  # its conjugate stands beside it
    return (
        form(q, q, r, r)
        + 4 * form(q, r, h11)
        + 2 * one_sided.real
        + 2 * form(h11, h11)
        + form(h20.conj(), h20)
    )


def _quintic(form: Form, q: Vector, h: Manifold) -> Vector:
    """r32, the fifth order terms of the homological equation, from the fifth form to the second."""
    r, h02, h12 = q.conj(), h.h20.conj(), h.h21.conj()
    fourth = form(q, q, q, h02) + 3 * form(q, r, r, h.h20) + 6 * form(q, q, r, h.h11)
    third = (
        form(r, r, h.h30)
        + 3 * form(q, q, h12)
        + 6 * form(q, r, h.h21)
        + 3 * form(q, h02, h.h20)
        + 6 * form(q, h.h11, h.h11)
        + 6 * form(r, h.h20, h.h11)
    )
    second = 2 * form(r, h.h31) + 3 * form(q, h.h22) + form(h02, h.h30)
    second = second + 3 * form(h12, h.h20) + 6 * form(h.h11, h.h21)
    return form(q, q, q, r, r) + fourth + third + second


def _bordered(pair: CriticalPair, rhs: Vector) -> Vector:
    """The solution h of (i w - A) h = rhs with <p, h> = 0, for a rhs across p."""
    n = len(rhs)
    matrix = np.zeros((n + 1, n + 1), dtype=complex)
    matrix[:n, :n] = pair.eigenvalue * np.eye(n) - pair.jacobian
    matrix[:n, n], matrix[n, :n] = pair.q, pair.p.conj()
    try:
        return np.asarray(np.linalg.solve(matrix, np.append(rhs, 0.0))[:n])
    except np.linalg.LinAlgError:
        raise SingularSystem("A - i w, bordered: i w is a double eigenvalue") from None
