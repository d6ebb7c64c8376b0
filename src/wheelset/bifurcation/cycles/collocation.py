"""A periodic orbit on a mesh: unknowns, residual, and its condensed linear problem.

The orbit solves u' = kappa T f(u, p) on s in [0, 1] with u(1) = S u(0): a full period has
kappa = 1 and S the identity; an orbit with the symmetry u(t + T/2) = S u(t) needs half a period,
kappa = 1/2. S is diagonal, a vector of signs.

    u = [ x_0, X_01 .. X_0m | x_1, ... | .. X_{N-1,m} | x_N | T | free parameters ]
          n    m n            n                         n     1   k
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.defects import defects
from wheelset.bifurcation.cycles.gauss import DEGREE, Gauss, gauss
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: Cached properties of ``Collocation`` that all meshes share, and all of so many intervals.
_SAME_ON_ALL = {
    "rule", "kappa", "sign_tuple", "flips", "fixed", "scalars", "last_row", "no_scalars",
    "no_weights", "stage_weights", "where", "along", "_kernel", "_second",
}  # fmt: skip
_SAME_FOR_EQUAL = {"shape", "inner", "size", "no_forcing"}


class Orbit(NamedTuple):
    """The parts of a vector of unknowns (or of a direction in it), as views.

    nodes (N, m + 1, n): x_j and the stages X_j1 .. X_jm of every interval; last (n,): x_N;
    period in s; free (k,): values of the free parameters.
    """

    nodes: Array
    last: Array
    period: float
    free: Array

    @property
    def stages(self) -> Array:
        """X (N, m, n)."""
        return self.nodes[:, 1:]

    @property
    def mesh_values(self) -> Array:
        """x_0 .. x_N, shape (N + 1, n)."""
        return np.concatenate([self.nodes[:, 0], self.last[np.newaxis]])

    @property
    def vector(self) -> Array:
        """All of it as one vector of unknowns."""
        return np.concatenate([self.nodes.ravel(), self.last, [self.period], self.free])


@dataclass(frozen=True, eq=False)
class Collocation:
    """How a system's orbits are discretised.

    system; p (m,): all parameter values, of which ``free`` are replaced by unknowns.
    h (N,): interval lengths, sum 1. signs (n,): diagonal of S. half: half a period.
    scales (n,): typical size of each state, for norms.
    """

    system: System
    p: Array
    free: tuple[str, ...]
    h: Array
    signs: Array
    half: bool
    scales: Array

    @cached_property
    def rule(self) -> Gauss:
        """The collocation method."""
        return gauss(DEGREE)

    @cached_property
    def kappa(self) -> float:
        """Length of s in [0, 1], in periods."""
        return 0.5 if self.half else 1.0

    @cached_property
    def shape(self) -> tuple[int, int, int]:
        """(N, m, n)."""
        return len(self.h), self.rule.m, self.system.n

    @cached_property
    def mesh(self) -> Array:
        """Mesh points 0 .. 1, (N + 1,)."""
        mesh = np.zeros(len(self.h) + 1)
        np.cumsum(self.h, out=mesh[1:])
        mesh /= mesh[-1]
        return mesh

    @cached_property
    def inner(self) -> int:
        """Number of unknowns before x_N."""
        N, m, n = self.shape
        return N * (m + 1) * n

    @cached_property
    def size(self) -> int:
        """Number of unknowns."""
        return self.inner + self.system.n + 1 + len(self.free)

    @cached_property
    def sign_tuple(self) -> tuple[float, ...]:
        """The signs as a tuple: compiled code is made for its length."""
        return tuple(self.signs.tolist())

    @cached_property
    def flips(self) -> NDArray[np.bool_]:
        """Which states (n,) change their sign after half a period, where that is computed."""
        return np.asarray((self.signs < 0) & self.half)

    @cached_property
    def fixed(self) -> dict[str, float]:
        """All parameters by name, with p's values of the free ones."""
        return dict(zip(self.system.parameter_names, self.p.tolist(), strict=True))

    @cached_property
    def scalars(self) -> NDArray[np.int64]:
        """Columns of the period and the free parameters in ``Factors``."""
        return np.arange(1 + len(self.free))

    @cached_property
    def last_row(self) -> Array:
        """Right-hand sides (2, 1 + k) of border rows: none, and 1 for the last."""
        sides = np.zeros((2, 1 + len(self.free)))
        sides[1, -1] = 1.0
        return sides

    @cached_property
    def no_scalars(self) -> Array:
        """Entries (1, 1 + k) of a border row that has none for the period and the parameters."""
        return np.zeros((1, 1 + len(self.free)))

    @cached_property
    def no_forcing(self) -> Array:
        """Forcings of a linear problem that has no more than its own, (N, m, n, 0)."""
        return np.empty((*self.shape, 0))

    @cached_property
    def no_weights(self) -> Array:
        """In place of a phase condition, (0, m n)."""
        return np.empty((0, self.shape[1] * self.shape[2]))

    @cached_property
    def where(self) -> NDArray[np.int64]:
        """Positions of the free parameters in p."""
        return np.array([self.system.index(name) for name in self.free], dtype=np.int64)

    @cached_property
    def along(self) -> Array:
        """Unit directions of the free parameters, (k, m)."""
        return self.system.directions(*self.free)

    @cached_property
    def quadrature(self) -> Array:
        """Gauss weights h_j b_i, (N, m, 1)."""
        return (self.h[:, np.newaxis] * self.rule.b)[:, :, np.newaxis]

    @cached_property
    def weights(self) -> Array:
        """Weights of the inner product of two orbits on the stages, (N, m, n)."""
        return self.h[:, np.newaxis, np.newaxis] * self.stage_weights

    @cached_property
    def stage_weights(self) -> Array:
        """The same for an interval of length one, (m, n)."""
        return self.rule.b[:, np.newaxis] / self.scales**2

    @cached_property
    def _kernel(self) -> Any:
        return self.system.jacobian_kernel(len(self.free))

    @cached_property
    def _second(self) -> Any:
        return self.system.curvature_kernel(len(self.free))

    def on(self, h: Array) -> Collocation:
        """The same on another mesh; what does not depend on the mesh is kept."""
        other = Collocation(self.system, self.p, self.free, h, self.signs, self.half, self.scales)
        known = _SAME_ON_ALL | _SAME_FOR_EQUAL if len(h) == len(self.h) else _SAME_ON_ALL
        other.__dict__.update((k, v) for k, v in self.__dict__.items() if k in known)
        return other

    def split(self, u: Array) -> Orbit:
        """The parts of a vector of unknowns, as views."""
        N, m, n = self.shape
        inner = self.inner
        nodes, end = u[:inner].reshape(N, m + 1, n), inner + n
        return Orbit(nodes, u[inner:end], float(u[end]), u[end + 1 :])

    def join(self, x: Array, X: Array, period: float, free: Array) -> Array:
        """A vector of unknowns from mesh values (N + 1, n) and stages (N, m, n)."""
        N, m, n = self.shape
        u = np.empty(self.size)
        nodes, end = u[: self.inner].reshape(N, m + 1, n), self.inner + n
        nodes[:, 0], nodes[:, 1:], u[self.inner : end] = x[:-1], X.reshape(N, m, n), x[-1]
        u[end], u[end + 1 :] = period, free
        return u

    def mean(self, stages: Array) -> Array:
        """Mean (n,) over the full period of a function given at the stages."""
        mean = (self.quadrature * stages).sum(axis=(0, 1))
        return np.where(self.flips, 0.0, mean)

    def parameters(self, free: Array) -> Array:
        """All parameter values (m,) with the free ones in place."""
        p = self.p.copy()
        p[self.where] = free
        return p

    def evaluate(self, orbit: Orbit) -> tuple[Array, Array]:
        """f (N, m, n) and its derivatives by states and free parameters (N, m, n, n + k)."""
        (N, m, n), k = self.shape, len(self.free)
        f, J = np.empty((N * m, n)), np.empty((N * m, n, n + k))
        X = orbit.nodes[:, 1:].reshape(-1, n)
        self._kernel(X, self.parameters(orbit.free), self.along, f, J)
        return f.reshape(N, m, n), J.reshape(N, m, n, n + k)

    def curvature(self, orbit: Orbit, v: Array, psi: Array) -> Array:
        """Gradient of psi . (Df v) at every stage by states and free parameters (N, m, n + k)."""
        N, m, n = self.shape
        out = np.empty((N, m, n + len(self.free)))
        self._second(
            orbit.nodes[:, 1:].reshape(-1, n), self.parameters(orbit.free), self.along,
            v.reshape(-1, n), psi.reshape(-1, n), out.reshape(N * m, -1),
        )  # fmt: skip
        return out

    def residual(self, u: Array, f: Array, row: Array, level: float) -> Array:
        """[stages N m n | mesh N n | boundary n | phase 1], see ``condensed``; f (N, m, n) at u.

        row (N, m n), level: the phase condition is row . X = level.
        """
        end, rule = self.inner + len(self.signs), self.rule
        out, time = np.empty(end + 1), self.kappa * float(u[end])
        defects(u, f, row, level, time, self.h, rule.slopes, rule.at_one, self.sign_tuple, out)
        return out

    def forcing(self, g: Array) -> Array:
        """Right-hand side [stages | mesh | boundary] of X' = A X + G c + g, for g (N, m, n)."""
        right = np.zeros(self.inner + self.system.n)
        right[: g.size] = (self.h[:, np.newaxis, np.newaxis] * g).ravel()
        return right
