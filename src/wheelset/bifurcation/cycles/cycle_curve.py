"""Limit cycles along one parameter, as a zero problem."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numba import njit
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import Finding, Point, Renewal
from wheelset.bifurcation.cycles import cycle_points, meshes, refinement
from wheelset.bifurcation.cycles.collocation import Collocation
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.factors import Factors
from wheelset.bifurcation.cycles.floquet import Floquet

Array = NDArray[np.float64]


#: A relative error beyond which a cycle on the finest mesh allowed is no longer believed.
UNRESOLVED = 1e-4

#: An error this far below what is asked for is estimated again after so many renewals only.
SPARE, LEISURE = 1e-2, 4

#: Distance of the trivial multiplier from +1 beyond which no multiplier is believed.
LOST = 1e-3


@dataclass(frozen=True)
class Meshing:
    """How the mesh of cycles follows them.

    every: it is equidistributed every so many steps (0: never). accuracy: relative error of period
    and mesh values above which intervals are added then (None: their number stays). most: intervals
    allowed.
    """

    every: int = 5
    accuracy: float | None = 1e-8
    most: int = 400

    def __post_init__(self) -> None:
        if self.accuracy is not None and not 1e-13 < self.accuracy < 1:
            raise ValueError(f"accuracy = {self.accuracy}: must lie in 1e-13 .. 1, or be None")


#: The default.
MESHING = Meshing()


@dataclass(frozen=True, eq=False)
class Anchor:
    """What a cycle is compared with: the last one accepted.

    row (N, m n), level: the phase condition is row . X = level, that is
    int <u - reference, reference'> ds = 0. birth (unknowns,): weights of
    <u, reference - its mean>, negative once a cycle has passed size zero.
    """

    row: Array
    level: float
    birth: Array

    @classmethod
    def at(cls, space: Collocation, u: Array) -> Anchor:
        """The anchor at a vector of unknowns."""
        rule = space.rule
        return cls(*_anchor(u, rule.slopes, space.h, rule.b, space.weights, space.flips))


@njit(cache=True, error_model="numpy")
def _anchor(
    u: Array, slopes: Array, h: Array, b: Array, weights: Array, flips: NDArray[np.bool_]
) -> tuple[Array, float, Array]:
    N, m, n = weights.shape
    row, birth, level = np.empty((N, m * n)), np.zeros(u.shape[0]), 0.0
    mean, width = np.zeros(n), (m + 1) * n  # of one interval in u: x_j and its stages
    for j in range(N):
        for i in range(m):
            for r in range(n):
                if not flips[r]:
                    mean[r] += h[j] * b[i] * u[j * width + (i + 1) * n + r]
    for j in range(N):
        for i in range(m):
            for r in range(n):
                slope = 0.0
                for q in range(m + 1):
                    slope += slopes[i, q] * u[j * width + q * n + r]
                weight, place = weights[j, i, r], j * width + (i + 1) * n + r
                row[j, i * n + r] = weight * slope / h[j]
                birth[place] = weight * (u[place] - mean[r])
                level += row[j, i * n + r] * u[place]
    return row, level, birth


@dataclass(eq=False)
class CycleLinearisation:
    """The collocation equations with their phase condition, linearised and factored.

    residual: [stages N m n | mesh N n | boundary n | phase 1]. solved: the determinant bordered by
    the last row asked about, and the direction t that it led to.
    """

    curve: CycleCurve
    residual: Array
    factors: Factors
    solved: tuple[float, Array] | None = None

    def newton(self, row: Array) -> tuple[Array, Array]:
        """x and t with J x = residual, row . x = 0, and J t = 0, row . t = 1."""
        phase, none = self.curve.anchor.row, self.curve.space.no_scalars
        determinant, x, t = self.factors.newton(phase, none, row, self.residual)
        self.solved = determinant, t
        return x, t

    def determinant(self, row: Array) -> float:
        """det [J; row] up to a positive factor; row: the unit tangent's."""
        if self.solved is None:
            self.newton(row)
        assert self.solved is not None
        determinant, t = self.solved  # t is the unit tangent over its product with the row
        return determinant * math.sqrt(self.curve.metric @ (t * t))

    @cached_property
    def floquet(self) -> Floquet:
        """Multipliers at the point of linearisation."""
        return Floquet.of(self.factors)


@dataclass(frozen=True, eq=False)
class CycleCurve:
    """Cycles of a system over its free parameter.

    space: the discretisation. sizes (1 + k,): of the period and the free parameters, for norms.
    metric (N,): weights of int sum (u_i / scale_i)^2 ds + (T / size)^2 + sum (p / size)^2; mesh
    values, which the stages determine, have none. anchor: phase reference. mesh: how it is renewed,
    age: steps since then; error: as last estimated, unchecked: renewals since. orientation: sign
    that keeps the branch test continuous where the number of intervals changes.
    """

    space: Collocation
    sizes: Array
    metric: Array
    anchor: Anchor
    mesh: Meshing
    age: int = 0
    error: float = 0.0
    unchecked: int = 0
    orientation: float = 1.0

    @classmethod
    def at(cls, space: Collocation, u: Array, sizes: Array, mesh: Meshing) -> CycleCurve:
        """The equations anchored at a vector of unknowns."""
        return cls(space, sizes, _metric(space, sizes), Anchor.at(space, u), mesh)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The free parameter."""
        return self.space.free

    def values(self, u: Array) -> Array:
        """The free parameters."""
        return self.space.split(u).free

    def residual(self, u: Array) -> Array:
        """[stages | mesh | boundary | phase], see ``condensed``."""
        f, _ = self.space.evaluate(self.space.split(u))
        return self.space.residual(u, f, self.anchor.row, self.anchor.level)

    def linearised(self, u: Array) -> CycleLinearisation:
        """Residual and condensed Jacobian."""
        at = Factors.at(self.space, u, self.anchor.row, self.anchor.level)
        return CycleLinearisation(self, at.residual, at.factors)

    def on(self, space: Collocation, u: Array) -> CycleCurve:
        """The same problem on another mesh, anchored at a vector of its unknowns."""
        fresh = CycleCurve.at(space, u, self.sizes, self.mesh)
        return replace(fresh, orientation=self.orientation)

    def renewed(self, point: Point) -> Renewal:
        """The phase reference moves along, and now and then the mesh is renewed."""
        if not self.due:
            return self.renewal(point.u)
        renewal = self.renewal(point.u, self.estimated(point.u, point.tangent))
        if len(renewal.problem.space.h) == len(self.space.h):
            return renewal
        return Renewal(_oriented(self, point, renewal), renewal.transfer)

    @property
    def due(self) -> bool:
        """Whether the mesh is renewed after this step."""
        return bool(self.mesh.every) and self.age + 1 >= self.mesh.every

    @property
    def known_error(self) -> float | None:
        """The error where it need not be estimated: 0 where no accuracy is asked, the last estimate
        while that is far below it; else None.
        """
        if self.mesh.accuracy is None:
            return 0.0
        spare = self.unchecked < LEISURE and 0 < self.error < SPARE * self.mesh.accuracy
        return self.error if spare else None

    def estimated(self, u: Array, tangent: Array) -> float:
        """Error of period and mesh values at a cycle of a branch."""
        known = self.known_error
        return refinement.mesh_error(self, u, tangent) if known is None else known

    def renewal(self, u: Array, error: float = 0.0) -> Renewal:
        """The problem anchored at u, where that is due on a mesh that suits an estimated error."""
        space, mesh = self.space, self.mesh
        if not self.due:
            older = CycleCurve(
                space, self.sizes, self.metric, Anchor.at(space, u), mesh, self.age + 1, self.error,
                self.unchecked, self.orientation,
            )  # fmt: skip
            return Renewal(older)
        orbit = space.split(u)
        count = refinement.intervals_for(len(space.h), error, mesh.accuracy or np.inf)
        moved = space.on(meshes.equidistributed(space, orbit, min(count, mesh.most)))

        def transfer(v: Array) -> Array:
            return meshes.moved(space, moved, v)

        unchecked = self.unchecked + 1 if error == self.error else 0
        fresh = CycleCurve(
            moved, self.sizes, _metric(moved, self.sizes), Anchor.at(moved, transfer(u)), mesh, 0,
            error, unchecked, self.orientation,
        )  # fmt: skip
        return Renewal(fresh, transfer)

    def tests(self, point: Point) -> Mapping[str, float]:
        """fold: the parameter turns; branch: another branch crosses; flip: a multiplier of what was
        computed passes -1; torus: two have the product one; birth: the cycle passes size zero.
        """
        watched = point.linearisation.floquet.watched
        return {
            "fold": float(point.tangent[-1]),
            "branch": self.orientation * point.determinant,
            "flip": watched.flip,
            "torus": watched.torus,
            "birth": self.alignment(point.u),
        }

    def size(self, u: Array) -> float:
        """Root mean square of u - mean, in the norm of the state's scales."""
        space, stages = self.space, self.space.split(u).stages
        return float(np.sqrt((space.weights * (stages - space.mean(stages)) ** 2).sum()))

    def alignment(self, u: Array) -> float:
        """<u, anchor - its mean>: negative once the cycle has passed size zero."""
        return float(self.anchor.birth @ u)

    def classify(self, test: str, point: Point) -> Finding:
        """LPC, BPC, PD, NS, or H where the cycle shrinks to an equilibrium."""
        return cycle_points.finding(self, test, point)

    def solution(self, point: Point) -> Cycle:
        """The cycle at a point."""
        return self.cycle(point.u, point.linearisation.floquet)

    def cycle(self, u: Array, floquet: Floquet) -> Cycle:
        """A vector of unknowns as a cycle that keeps nothing of the solver."""
        space, orbit = self.space, self.space.split(u)
        values = space.fixed | dict(zip(space.free, orbit.free.tolist(), strict=True))
        signs = space.sign_tuple if space.half else None
        return Cycle(
            space.system.state_names, values, orbit.period, space.mesh, orbit.nodes.copy(), signs,
            floquet.computed,
        )  # fmt: skip

    def ended(self, point: Point) -> str:
        """Ends where the cycle has shrunk to an equilibrium, or the mesh no longer resolves it."""
        if self.alignment(point.u) < 0:
            return "the cycle shrank to an equilibrium: a Hopf point"
        floquet = point.linearisation.floquet
        off = floquet.watched.trivial_error
        if off > LOST:
            return (
                f"the Floquet multipliers are lost: the trivial one is off by {off:.1e} beside "
                f"one of {abs(floquet.multipliers[0]):.1e}; the cycle touches a singularity of the "
                "field"
            )
        if self.error > UNRESOLVED and len(self.space.h) >= self.mesh.most:
            return (
                f"{len(self.space.h)} mesh intervals do not resolve the cycle: estimated relative "
                f"error {self.error:.1e}; allow more, or look for a singularity of the field"
            )
        return ""


def _oriented(old: CycleCurve, point: Point, renewal: Renewal) -> CycleCurve:
    """The renewed curve with the sign of its branch test as it was: on another number of intervals
    the determinant may change its sign.
    """
    new, u, t = renewal.problem, point.u, point.tangent
    assert renewal.transfer is not None
    linearisation = new.linearised(renewal.transfer(u))
    now = linearisation.determinant(new.metric * renewal.transfer(t))
    same = now * point.determinant > 0
    return replace(new, orientation=old.orientation if same else -old.orientation)


def _metric(space: Collocation, sizes: Array) -> Array:
    (N, m, n), inner = space.shape, space.inner
    metric = np.zeros(space.size)
    metric[:inner].reshape(N, m + 1, n)[:, 1:], metric[inner + n :] = space.weights, sizes**-2.0
    return metric
