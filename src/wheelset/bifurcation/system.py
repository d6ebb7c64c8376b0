"""A dynamical system x' = f(x, p) to compute with: f, exact derivatives, named outcomes."""

from __future__ import annotations

import cmath
import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation import arrays, codegen, domain, multidual, regions
from wheelset.bifurcation.field import VectorField, vector_field
from wheelset.bifurcation.outcomes import NotFinite, as_tuple
from wheelset.bifurcation.tape import Tape, record

Array = NDArray[np.float64]


class TaylorFunction(Protocol):
    """A function of one variable that can be expanded anywhere: a spline, a sine, a table."""

    def taylor(self, y: Array, order: int) -> Array:
        """Coefficients f^(j)(y)/j!, j = 0..order, shape ``y.shape + (order + 1,)``."""
        ...


@dataclass(frozen=True)
class System:
    """A field together with parameter values and its sampled functions.

    field: the symbolic right-hand side. values: default value of every parameter, SI.
    functions: by name, what the field's sampled functions evaluate to.

    States x have shape (n,) or (points, n); parameter vectors p shape (m,), ordered as
    ``parameter_names``, and default to ``values``. Every evaluation returns finite numbers or
    raises a ``NumericalOutcome`` that says what left its domain.
    """

    field: VectorField
    values: Mapping[str, float]
    functions: Mapping[str, TaylorFunction] = dataclasses.field(default_factory=dict)

    def __post_init__(self) -> None:
        region = {self.field.switch.region.name} if self.field.switch else set()
        missing = set(self.parameter_names) - set(self.values) - region
        if missing:
            raise ValueError(f"no value for parameter {', '.join(sorted(missing))}; give one each")
        unsampled = {name for name, _ in self.tape.sampled} - set(self.functions)
        if unsampled:
            raise ValueError(f"no function given for {', '.join(sorted(unsampled))}")

    @classmethod
    def from_function(
        cls,
        f: Callable[..., Sequence[sp.Expr]],
        state: Sequence[str],
        values: Mapping[str, float],
    ) -> System:
        """A system from a plain Python function f(x, p); parameters are ordered as in values."""
        return cls(vector_field(f, state, tuple(values)), dict(values))

    # --- names and parameter vectors ---------------------------------------------------------

    @cached_property
    def tape(self) -> Tape:
        """The field as elementary operations."""
        return record(self.field)

    @property
    def n(self) -> int:
        """Number of state variables."""
        return len(self.field.state)

    @cached_property
    def state_names(self) -> tuple[str, ...]:
        """Names of the state variables, in order."""
        return self.field.state_names

    @cached_property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the parameters, in order."""
        return self.field.parameter_names

    def index(self, parameter: str) -> int:
        """Position of a parameter in p; ValueError with the names there are."""
        if parameter not in self.parameter_names:
            raise ValueError(
                f"unknown parameter {parameter!r}; it has {', '.join(self.parameter_names)}"
            )
        return self.parameter_names.index(parameter)

    def with_values(self, **values: float) -> System:
        """The same system with some parameters changed; what was compiled is kept."""
        for name in values:
            self.index(name)
        return dataclasses.replace(self, values={**self.values, **values})

    def p(self, **values: float) -> Array:
        """Parameter vector (m,) of the defaults, with some changed."""
        vector = self._defaults.copy()
        for name, value in values.items():
            vector[self.index(name)] = value
        return vector

    @cached_property
    def _defaults(self) -> Array:
        return np.array([self.values.get(name, 0.0) for name in self.parameter_names])

    def thresholds(self, p: Array | None = None) -> tuple[float, ...]:
        """Values of a piecewise field's switching thresholds at p; none for a smooth field."""
        return regions.thresholds(self.field, self._vector(p))

    def _vector(self, p: Array | None) -> Array:
        return self._defaults if p is None else np.asarray(p, dtype=np.float64)

    # --- f and its first derivatives, compiled -----------------------------------------------

    def rhs(self, x: ArrayLike, p: Array | None = None) -> Array:
        """f(x, p), shape of x."""
        return self.evaluate(x, p)[0]

    def jacobian(self, x: ArrayLike, p: Array | None = None) -> Array:
        """Exact df/dx, shape x.shape + (n,)."""
        return self.evaluate(x, p)[1]

    def evaluate(
        self, x: ArrayLike, p: Array | None = None, by: Sequence[str] | None = None
    ) -> tuple[Array, Array]:
        """f, shape of x, and its exact derivatives by states and parameters named in ``by``
        (default: the state), shape x.shape + (len(by),). Compiled on first use.
        """
        states = np.asarray(x, dtype=np.float64)
        points = np.ascontiguousarray(states.reshape(-1, self.n))
        slots = tuple(range(self.n)) if by is None else tuple(map(self._slot, by))
        if self.field.switch is None:
            f, jacobian = self._smooth(points, self._vector(p), slots)
        else:
            f, jacobian = np.empty_like(points), np.empty((*points.shape, len(slots)))
            for p_region, chosen in regions.split(self.field, points, self._vector(p)):
                f[chosen], jacobian[chosen] = self._smooth(points[chosen], p_region, slots)
        return f.reshape(states.shape), jacobian.reshape((*states.shape, len(slots)))

    def _smooth(self, points: Array, p: Array, slots: tuple[int, ...]) -> tuple[Array, Array]:
        f, jacobian = np.empty_like(points), np.empty((*points.shape, len(slots)))
        status = np.empty(len(points), dtype=np.int64)
        kernel = codegen.kernel(self.tape, slots)
        kernel(points, p, self._sampled(points, 1), f, jacobian, status)
        if status.any():
            self._raise_outcome(points[np.flatnonzero(status)[0]], p)
        return f, jacobian

    def _raise_outcome(self, x: Array, p: Array) -> None:
        """Say what the kernel met at a state: a condition violated, or an overflow."""
        sampled = dict(enumerate(self._sampled(x[np.newaxis], 0)[0, :, 0]))
        slots = arrays.evaluate(self.tape, [*x, *p], sampled)
        domain.check_slots(self.tape, slots, x, self.state_names)
        bad = ~np.isfinite(np.array(slots, dtype=np.float64))
        raise domain.not_finite(self.tape, bad, x, self.state_names)

    def _slot(self, name: str) -> int:
        if name in self.state_names:
            return self.state_names.index(name)
        return self.n + self.index(name)

    def _sampled(self, points: Array, order: int) -> Array:
        sampled = np.empty((len(points), len(self.tape.sampled), order + 1))
        for i, (name, state) in enumerate(self.tape.sampled):
            sampled[:, i] = self.functions[name].taylor(points[:, state], order)
            outside = ~np.isfinite(sampled[:, i]).all(axis=-1)
            if outside.any():
                x = as_tuple(points[np.argmax(outside)])
                raise NotFinite(f"sampled function {name}, outside its range", x, self.state_names)
        return sampled

    # --- derivatives of any order --------------------------------------------------------------

    def form(self, x: ArrayLike, p: Array | None, *directions: ArrayLike) -> NDArray[Any]:
        """The multilinear form D^k f(x, p)[v_1, ..., v_k], shape (n,), exact.

        Directions have length n (along the state) or n + m (along state and parameters), and may
        be complex. Nothing is compiled for a model.
        """
        state = np.asarray(x, dtype=np.float64)
        [(p_region, _)] = regions.split(self.field, state[np.newaxis], self._vector(p))
        rows = [np.asarray(v) for v in directions]
        kind = np.complex128 if any(row.dtype.kind == "c" for row in rows) else np.float64
        packed = np.zeros((len(rows), self.n + len(p_region)), dtype=kind)
        for i, row in enumerate(rows):
            packed[i, : len(row)] = row
        return self._propagate(state, p_region, packed)[:, -1]

    def _propagate(self, x: Array, p: Array, directions: NDArray[Any]) -> NDArray[Any]:
        """All coefficients of f along the directions, shape (n, 2^k)."""
        order, (code, constants) = len(directions), self.tape.packed
        sampled = self._sampled(x[np.newaxis], max(order, 1))[0]
        slots = multidual.propagate(code, constants, np.concatenate([x, p]), directions, sampled)
        domain.check_orders(self.tape, slots[:, 0].real, order, x, self.state_names)
        out = slots[self.tape.output_slots]
        if not cmath.isfinite(out.sum()):
            bad = ~np.asarray(np.isfinite(slots).all(axis=1))
            raise domain.not_finite(self.tape, bad, x, self.state_names)
        return out

    # --- named quantities on arrays ------------------------------------------------------------

    def quantities(self, names: Iterable[str], **given: ArrayLike) -> dict[str, Array]:
        """Named assignments (and "d<state>/dt") on arrays of states and parameters that
        broadcast together; what is not given is 0 for a state, the default for a parameter.
        """
        for name in set(given) - set(self.state_names):
            self.index(name)
        x = [np.asarray(given.get(s, 0.0), dtype=np.float64) for s in self.state_names]
        p = [given.get(name, self.values.get(name, 0.0)) for name in self.parameter_names]
        if self.field.switch:
            region = regions.region_of(self.field, np.broadcast_arrays(*x), self._defaults)
            p[self.index(self.field.switch.region.name)] = region
        sampled = {
            i: self.functions[name].taylor(x[state], 0)[..., 0]
            for i, (name, state) in enumerate(self.tape.sampled)
        }
        slots = arrays.evaluate(self.tape, [*x, *p], sampled)
        domain.check_slots(self.tape, slots, x, self.state_names)
        rates = zip((f"d{s}/dt" for s in self.state_names), self.tape.outputs, strict=True)
        where = {**self.tape.named, **dict(rates)}
        shape = np.broadcast_shapes(*(np.shape(v) for v in (*x, *p)))
        return {name: np.broadcast_to(slots[where[name]], shape) for name in names}
