"""The linearised equations of an orbit, factored once for all border rows and right-hand sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.cycles import condensed
from wheelset.bifurcation.cycles.collocation import Collocation
from wheelset.bifurcation.cycles.elimination import eliminate
from wheelset.bifurcation.cycles.reduction import reduce
from wheelset.bifurcation.cycles.transposed import transposed

Array = NDArray[np.float64]

_NONE = np.empty(0)


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
        N, m, n = space.shape
        further = space.no_forcing if extra is None else extra
        count, rule, signs = 1 + J.shape[3] - n + further.shape[3], space.rule, space.sign_tuple
        responses = np.empty((N, (m + 1) * n + count, (m + 1) * n))
        links, forced = np.empty((N, 3 * n, 2 * n)), np.empty((N, count, n))
        stages, singular = eliminate(
            J, f, further, space.kappa, period, space.h, rule.slopes, rule.at_one, signs, responses
        )
        if singular >= 0:
            raise SingularSystem(f"collocation equations of mesh interval {singular}")
        sign = stages * reduce(responses, rule.at_one, signs, links, forced)
        if sign == 0.0:
            raise SingularSystem("collocation equations of neighbouring mesh intervals")
        return cls(space, (responses, links, forced), sign)

    @property
    def pencil(self) -> tuple[Array, Array]:
        """(G, E) with G x_0 + E x_N = 0 for every solution of X' = A X."""
        n, links = self.collocation.shape[2], self.arrays[1]
        return links[0, :n, :n], links[0, :n, n:]

    def step(
        self, rows: Array, D: Array, row: Array, rhs: Array | None, last: float
    ) -> tuple[float, Array]:
        """A Newton step or a tangent: unknown scalars are the period and the k free parameters.

        rows (k, N, m n), D (k, k + 1): fixed border rows. row (size,): one more, laid out as the
        unknowns, with no entries for mesh values. rhs: [stages | mesh | boundary | rows] or None
        for zero; last: the row's. Returns the determinant up to a positive factor, and the vector
        of unknowns. Raises SingularSystem.
        """
        space, k = self.collocation, len(rows)
        x, e = np.empty(space.size), np.zeros(k + 1)
        right, e[k] = _NONE, last
        if rhs is not None:
            right, e[:k] = rhs, rhs[-k:]
        determinant = condensed.solve(
            self.arrays, space.rule.at_one, space.sign_tuple, space.scalars, rows.reshape(-1), D,
            row, right, e, x,
        )  # fmt: skip
        return self._checked(determinant), x

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
        u = np.empty(inner + n + len(columns))
        determinant = condensed.solve(
            self.arrays, space.rule.at_one, self._signs(signs), columns, weights.reshape(-1), D,
            _NONE, _NONE if right is None else right, e, u,
        )  # fmt: skip
        blocks, x = u[:inner].reshape(N, (m + 1) * n), u[: inner + n]
        mesh = np.append(blocks[:, :n], x[inner:]).reshape(N + 1, n)
        return self._checked(determinant), mesh, blocks[:, n:].copy(), u[inner + n :]

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
