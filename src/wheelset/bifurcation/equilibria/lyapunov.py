"""First Lyapunov coefficient of a Hopf point, in MATCONT's normalisation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CriticalPair:
    """Eigenvectors of an eigenvalue l: A q = l q, A^T p = conj(l) p, |q|_2 = 1, <p, q> = 1.

    jacobian (n, n), eigenvalue in 1/s (i w at a Hopf point), q and p complex (n,).
    """

    jacobian: Array
    eigenvalue: complex
    q: NDArray[Any]
    p: NDArray[Any]

    @property
    def frequency(self) -> float:
        """Imaginary part of the eigenvalue, rad/s."""
        return self.eigenvalue.imag


def critical_pair(jacobian: Array, frequency: float) -> CriticalPair:
    """The eigenpair nearest to i times ``frequency`` [rad/s] of a matrix, and its adjoint.

    The adjoint is a row of the inverse of the eigenvectors, so that <p, q> = 1.
    """
    values, vectors = np.linalg.eig(jacobian)
    k = int(np.argmin(np.abs(values - 1j * frequency)))
    q, p = vectors[:, k].astype(complex), _inverse(vectors)[k].conj()
    return CriticalPair(jacobian, complex(values[k]), q, p)


def _inverse(vectors: NDArray[Any]) -> NDArray[Any]:
    try:
        return np.linalg.inv(vectors)
    except np.linalg.LinAlgError:
        raise NoConvergence("the Jacobian has no full set of eigenvectors", ()) from None


def first_lyapunov(system: System, x: Array, p: Array, pair: CriticalPair) -> float:
    """FLC = 1/2 Re <p, C(q,q,q-) + 2 B(q,h11) + B(q-,h20)> at a Hopf point (x, p).

    With h11 = -A^-1 B(q,q-) and h20 = (2iw - A)^-1 B(q,q). It is MATCONT's number: not divided by
    w (Kuznetsov's l1 = FLC / w), and dependent on the units of the state, here SI. Raises
    SingularSystem where 0 or 2iw is an eigenvalue too, or the field's own outcome.
    Kuznetsov, Elements of Applied Bifurcation Theory, Eq. (5.39).
    """
    q, conj = pair.q, pair.q.conj()
    h11 = resolvent(pair, 0, system.form(x, p, q, conj))
    h20 = resolvent(pair, 2, system.form(x, p, q, q))
    cubic = (
        system.form(x, p, q, q, conj) + 2 * system.form(x, p, q, h11) + system.form(x, p, conj, h20)
    )
    return float(np.vdot(pair.p, cubic).real / 2)


def resolvent(pair: CriticalPair, multiple: int, rhs: NDArray[Any]) -> NDArray[Any]:
    """(multiple i w - A)^-1 rhs; SingularSystem where that is an eigenvalue too."""
    shift = multiple * 1j * pair.frequency * np.eye(len(rhs))
    try:
        return np.asarray(np.linalg.solve(shift - pair.jacobian, rhs))
    except np.linalg.LinAlgError:
        raise SingularSystem(f"A - {multiple} i w, beside a pair +-i w") from None
