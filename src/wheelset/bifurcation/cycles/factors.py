"""The linearised equations of an orbit, factored once for all border rows and right-hand sides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.cycles import condensed
from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.factorisation import factorise
from wheelset.bifurcation.cycles.transposed import transposed

Array = NDArray[np.float64]

_NONE, _NOTHING = np.empty(0), np.empty((0, 0))


@dataclass(frozen=True, eq=False)
class Factors:
    """The linear problem X' = A X + G c of an orbit: see ``condensed``.

    Scalars c by column: 0 the period (forcing kappa f), 1 .. k the free parameters (kappa T f_p),
    then further forcings. arrays: responses, links, forced. sign: of the determinant of what was
    eliminated.
    """

    collocation: Collocation
    arrays: tuple[Array, Array, Array]
    sign: float

    @classmethod
    def of(
        cls, space: Collocation, J: Array, f: Array, period: float, extra: Array | None = None
    ) -> Factors:
        """Factors from f (N, m, n) and its derivatives J (N, m, n, n + k) at the stages.

        extra (N, m, n, e): further forcings. Raises SingularSystem.
        """
        none = space.no_weights
        return cls._with(space, J, f, period, extra, (_NONE, none, 0.0, _NONE))

    @classmethod
    def at(
        cls, space: Collocation, u: Array, row: Array, level: float, extra: Array | None = None
    ) -> Linearised:
        """The factors at a vector of unknowns, with what they are made of.

        row (N, m n), level: the phase condition is row . X = level. Raises SingularSystem, or what
        the field raises.
        """
        orbit = space.split(u)
        f, J = space.evaluate(orbit)
        residual = np.empty(space.inner + len(space.signs) + 1)
        phase = u, row, level, residual
        return Linearised(residual, cls._with(space, J, f, orbit.period, extra, phase), orbit, J)

    @classmethod
    def _with(
        cls, space: Collocation, J: Array, f: Array, period: float, extra: Array | None,
        phase: tuple[Array, Array, float, Array],
    ) -> Factors:  # fmt: skip
        """phase: unknowns, row and level of the phase condition, and the residual to be filled."""
        N, m, n = space.shape
        further, rule = space.no_forcing if extra is None else extra, space.rule
        count, (u, row, level, residual) = 1 + J.shape[3] - n + further.shape[3], phase
        arrays = (
            np.empty((N, (m + 1) * n + count, (m + 1) * n)),
            np.empty((N, 3 * n, 2 * n)),
            np.empty((N, count, n)),
        )
        sign, singular = factorise(
            u, f, J, further, row, level, space.kappa, period, space.h, rule.slopes, rule.at_one,
            space.sign_tuple, residual, arrays,
        )  # fmt: skip
        if singular >= 0:
            raise SingularSystem(f"collocation equations of mesh interval {singular}")
        if sign == 0.0:
            raise SingularSystem("collocation equations of neighbouring mesh intervals")
        return cls(space, arrays, sign)

    @property
    def pencil(self) -> tuple[Array, Array]:
        """(G, E) with G x_0 + E x_N = 0 for every solution of X' = A X."""
        n, links = self.collocation.shape[2], self.arrays[1]
        return links[0, :n, :n], links[0, :n, n:]

    def newton(
        self, rows: Array, D: Array, row: Array, residual: Array
    ) -> tuple[float, Array, Array]:
        """A Newton step and the tangent: unknown scalars are the period and the k free parameters.

        rows (k N m n, in any shape), D (k, k + 1): fixed border rows. row (size,): one more, laid
        out as the unknowns, without entries for mesh values. residual: [stages | mesh | boundary |
        rows].
        Returns the determinant up to a positive factor, x with J x = residual, row . x = 0, and t
        with J t = 0, row . t = 1. Raises SingularSystem.
        """
        space = self.collocation
        both = np.empty((2, space.size))
        determinant = condensed.solve(
            self.arrays, space.rule.at_one, space.sign_tuple, space.scalars, rows.reshape(-1), D,
            row, residual[np.newaxis], space.last_row, both,
        )  # fmt: skip
        return self._checked(determinant), both[0], both[1]

    def solve(
        self, columns: NDArray[np.int64], weights: Array, D: Array, right: Array | None, e: Array,
        signs: Array | None = None,
    ) -> tuple[float, Array, Array, Array]:  # fmt: skip
        """Solve for mesh values, stages and the scalars of the given columns.

        weights (k, N, m n), D (k, k): border rows, e (k,) their right-hand sides; right: [stages |
        mesh | boundary] or None for zero. signs: of the boundary condition (default: the orbit's).
        Returns the determinant up to a positive factor, x (N + 1, n), X (N, m n), c (k).
        """
        space = self.collocation
        (N, m, n), inner = space.shape, space.inner
        u = np.empty((1, inner + n + len(columns)))
        determinant = condensed.solve(
            self.arrays, space.rule.at_one, self._signs(signs), columns, weights.reshape(-1), D,
            _NONE, _NOTHING if right is None else right[np.newaxis], e[np.newaxis], u,
        )  # fmt: skip
        blocks, x = u[0, :inner].reshape(N, (m + 1) * n), u[0, : inner + n]
        mesh = np.append(blocks[:, :n], x[inner:]).reshape(N + 1, n)
        return self._checked(determinant), mesh, blocks[:, n:].copy(), u[0, inner + n :]

    def transposed(
        self,
        columns: NDArray[np.int64],
        weights: Array,
        D: Array,
        t: Array,
        signs: Array | None = None,
    ) -> tuple[Array, Array]:
        """Multipliers psi (N, m, n) of a forcing and eta (k,) of the rows: the t . c that a forcing
        g and right-hand sides e cause is sum psi g + eta . e.
        """
        space = self.collocation
        psi, eta = np.empty(space.shape), np.empty(len(columns))
        self._checked(
            transposed(
                self.arrays, space.rule.at_one, self._signs(signs), space.h, columns,
                weights.reshape(-1), D, t, psi.reshape(-1, space.rule.m * space.shape[2]), eta,
            )
        )  # fmt: skip
        return psi, eta

    def _signs(self, signs: Array | None) -> tuple[float, ...]:
        return self.collocation.sign_tuple if signs is None else tuple(signs.tolist())

    def _checked(self, determinant: float) -> float:
        if not abs(determinant) > 0.0:
            raise SingularSystem("collocation equations with their border rows")
        return self.sign * determinant


class Linearised(NamedTuple):
    """The equations at a vector of unknowns.

    residual: [stages | mesh | boundary | phase], see ``condensed``. orbit: the unknowns' parts.
    J (N, m, n, n + k): derivatives of f at the stages.
    """

    residual: Array
    factors: Factors
    orbit: Orbit
    J: Array
