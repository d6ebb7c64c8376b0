"""Hopf points of many parameter rows at once: what a fit of a model to Hopf data asks for.

One equilibrium and one pair of eigenvalues a row are followed to the imaginary axis by Newton's
method on exact derivatives. A row that fails keeps its own outcome and holds up no other row.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.outcomes import NoConvergence, NumericalOutcome
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]
Numbers = NDArray[Any]

MAX_ITERATIONS = 30

#: Newton's last step relative to the parameter; the error left is of the order of its square.
LAST_STEP = 1e-7

#: Longest step relative to the parameter.
LONGEST_STEP = 0.3

#: An imaginary part this small relative to the largest eigenvalue belongs to no oscillation.
TINY = 1e-9


@dataclass(frozen=True, eq=False)
class HopfBatch:
    """Hopf points by row: values of the ``parameter``, frequencies rad/s, lyapunov (MATCONT's FLC,
    SI state), each (rows,), and states (rows, n).

    outcomes: by row None, or why there is no point; its numbers are NaN then and ``found`` False.
    """

    parameter: str
    values: Array
    frequencies: Array
    lyapunov: Array
    states: Array
    outcomes: tuple[NumericalOutcome | None, ...]

    @property
    def found(self) -> NDArray[np.bool_]:
        """Which rows have a Hopf point, (rows,)."""
        return np.array([outcome is None for outcome in self.outcomes])


@dataclass(frozen=True, eq=False)
class _Rows:
    """Where each row stands: p (rows, m), x (rows, n), w (rows,) rad/s; ``column`` of p is free."""

    system: System
    column: int
    p: Array
    x: Array
    w: Array

    def some(self, chosen: Any) -> _Rows:
        return replace(self, p=self.p[chosen], x=self.x[chosen], w=self.w[chosen])

    def form(self, *directions: Numbers) -> Numbers:
        return self.system.forms(self.x, self.p, *directions)

    def jacobians(self) -> Array:
        return np.stack([self.form(e) for e in np.eye(self.x.shape[1])], axis=-1)

    def moved(self, along: Array) -> Array:
        """Directions of states ``along`` (rows, n) together with the free parameter's unit."""
        out = np.zeros((len(along), along.shape[1] + self.p.shape[1]))
        out[:, : along.shape[1]] = along
        out[:, along.shape[1] + self.column] = 1.0
        return out


def hopf_batch(
    system: System,
    parameter: str,
    rows: ArrayLike,
    frequencies: ArrayLike | None = None,
    states: ArrayLike | None = None,
) -> HopfBatch:
    """The Hopf point beside each row of parameters, with its first Lyapunov coefficient.

    rows (rows, m): parameter vectors as ``System.p`` makes them; ``parameter`` is free and starts
    at the row's value. frequencies (rows,) rad/s: of the pair to follow; default: the oscillating
    pair nearest to the imaginary axis. states (rows, n): where the equilibria are sought (default:
    the origin). Nothing is compiled. Raises ValueError for rows of the wrong shape.
    """
    column, p = system.index(parameter), _checked(system, rows)
    x = np.zeros((len(p), system.n)) if states is None else np.array(states, dtype=np.float64)
    w = np.full(len(p), np.nan) if frequencies is None else np.array(frequencies, dtype=np.float64)
    if x.shape != (len(p), system.n) or w.shape != (len(p),):
        raise ValueError(
            f"states {x.shape} and frequencies {w.shape} for {len(p)} rows; give one each a row"
        )
    return _solved(_Rows(system, column, p, x, w), parameter)


def _checked(system: System, rows: ArrayLike) -> Array:
    p = np.array(rows, dtype=np.float64)
    m = len(system.parameter_names)
    if p.ndim != 2 or p.shape[1] != m or not np.isfinite(p).all():
        raise ValueError(f"rows of shape {p.shape}; give (rows, {m}) finite numbers, as System.p")
    return p


def _solved(rows: _Rows, parameter: str) -> HopfBatch:
    """All rows together; where one raises, the halves apart, so that each fails for itself."""
    try:
        return _together(rows, parameter)
    except NumericalOutcome as outcome:
        if len(rows.p) == 1:
            return _failed(rows, parameter, outcome)
    middle = len(rows.p) // 2
    parts = [_solved(rows.some(part), parameter) for part in (np.s_[:middle], np.s_[middle:])]
    return _joined(parts)


def _failed(rows: _Rows, parameter: str, outcome: NumericalOutcome) -> HopfBatch:
    return _filled(rows, parameter, np.zeros(len(rows.p), dtype=bool), (outcome,) * len(rows.p))


def _filled(
    rows: _Rows,
    parameter: str,
    found: NDArray[np.bool_],
    outcomes: tuple[NumericalOutcome | None, ...],
) -> HopfBatch:
    """The rows found with their numbers, and the others without."""
    table = np.full((len(rows.p), 3 + rows.x.shape[1]), np.nan)
    if found.any():
        good = rows.some(found)
        table[found] = np.column_stack([good.p[:, good.column], *_numbers(good), good.x])
    value, frequency, lyapunov = table[:, :3].T
    return HopfBatch(parameter, value, frequency, lyapunov, table[:, 3:], outcomes)


def _joined(parts: list[HopfBatch]) -> HopfBatch:
    names = ("values", "frequencies", "lyapunov", "states")
    columns = {n: np.concatenate([getattr(part, n) for part in parts]) for n in names}
    outcomes = tuple(outcome for part in parts for outcome in part.outcomes)
    return HopfBatch(parts[0].parameter, **columns, outcomes=outcomes)


def _together(rows: _Rows, parameter: str) -> HopfBatch:
    at, last = _on_the_axis(rows)
    there = np.abs(last) <= LAST_STEP
    outcomes = tuple(
        None if ok else NoConvergence(f"Hopf point in {parameter} near {start:.6g}", (abs(step),))
        for ok, start, step in zip(there, rows.p[:, rows.column], last, strict=True)
    )
    return _filled(at, parameter, there, outcomes)


def _on_the_axis(rows: _Rows) -> tuple[_Rows, Array]:
    """Every row moved to its Hopf point, and Newton's last steps relative to the parameter.

    A row is left where it is once its step is short, or its pair has become real (step inf).
    """
    last, active = np.full(len(rows.p), np.inf), np.arange(len(rows.p))
    p, x, w = rows.p.copy(), rows.x.copy(), rows.w.copy()
    for _ in range(MAX_ITERATIONS):
        step, rest, along, w[active] = _newton(replace(rows, p=p, x=x, w=w).some(active))
        size = np.abs(p[active, rows.column]) + TINY
        known = np.isfinite(step)
        step = np.clip(np.where(known, step, 0.0), -LONGEST_STEP * size, LONGEST_STEP * size)
        p[active, rows.column] += step
        x[active] += rest + along * step[:, np.newaxis]
        last[active] = np.where(known, step / size, np.inf)
        active = active[known & (np.abs(last[active]) > LAST_STEP)]
        if not len(active):
            break
    return replace(rows, p=p, x=x, w=w), last


def _newton(rows: _Rows) -> tuple[Array, Array, Array, Array]:
    """Newton's step of the free parameter for Re l = 0 (NaN where the pair is real or at rest).

    With it the states move by ``rest + along step``: dx = -A^-1 (f + f_p dp). The eigenvalue
    moves by <p, B(q, dx)> + <p, A_p q> dp. Returns step (rows,), rest, along (rows, n), w (rows,).
    """
    jacobian = rows.jacobians()
    rest = _divided(jacobian, -rows.form())
    along = _divided(jacobian, -rows.form(rows.moved(np.zeros_like(rows.x))))
    value, q, adjoint = _pairs(jacobian, rows.w)
    drift = _inner(adjoint, rows.form(q, rest)).real
    slope = _inner(adjoint, rows.form(q, rows.moved(along))).real
    moving = (value.imag > TINY * np.abs(jacobian).max(axis=(1, 2))) & (slope != 0.0)
    step = np.full(len(slope), np.nan)
    step[moving] = -(value.real + drift)[moving] / slope[moving]
    return step, rest, along, value.imag


def _pairs(jacobian: Array, w: Array) -> tuple[Numbers, Numbers, Numbers]:
    """Eigenvalues nearest to i w (w NaN: the oscillating ones nearest to the imaginary axis), with
    q, |q| = 1, and the adjoint p, <p, q> = 1: (rows,), (rows, n), (rows, n).
    """
    values, vectors = np.linalg.eig(jacobian)
    oscillating = values.imag > TINY * np.abs(values).max(axis=1, keepdims=True)
    leading = np.where(oscillating, np.abs(values.real), np.inf)
    distance = np.abs(values - 1j * np.nan_to_num(w)[:, np.newaxis])
    chosen = np.argmin(np.where(np.isnan(w)[:, np.newaxis], leading, distance), axis=1)
    each = np.arange(len(values))
    try:
        adjoint = np.linalg.inv(vectors)[each, chosen].conj()
    except np.linalg.LinAlgError:
        raise NoConvergence("a Jacobian has no full set of eigenvectors", ()) from None
    return values[each, chosen], vectors[each, :, chosen].astype(complex), adjoint


def _inner(p: Numbers, v: Numbers) -> Numbers:
    """<p, v> by row."""
    return np.einsum("ij,ij->i", p.conj(), v)


def _divided(matrices: Numbers, vectors: Numbers) -> Numbers:
    try:
        return np.asarray(np.linalg.solve(matrices, vectors[..., np.newaxis])[..., 0])
    except np.linalg.LinAlgError:
        raise SingularSystem("A or A - 2 i w at a Hopf point") from None


def _numbers(rows: _Rows) -> tuple[Array, Array]:
    """Frequency, and FLC = 1/2 Re <p, C(q,q,q-) + 2 B(q,h11) + B(q-,h20)>, of Hopf points; as
    ``lyapunov.first_lyapunov``.
    """
    jacobian = rows.jacobians()
    value, q, adjoint = _pairs(jacobian, rows.w)
    conj, shift = q.conj(), 2j * value.imag[:, np.newaxis, np.newaxis] * np.eye(q.shape[1])
    h11 = -_divided(jacobian, rows.form(q, conj))
    h20 = _divided(shift - jacobian, rows.form(q, q))
    cubic = rows.form(q, q, conj) + 2 * rows.form(q, h11) + rows.form(conj, h20)
    return value.imag, np.asarray(_inner(adjoint, cubic).real / 2)
