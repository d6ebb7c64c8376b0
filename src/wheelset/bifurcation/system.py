"""A dynamical system x' = f(x, p) to compute with: f, exact derivatives, named outcomes."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.compiled import kernels
from wheelset.bifurcation.compiled.batched import MeshKernel, mesh_kernel
from wheelset.bifurcation.compiled.kernels import Kernel
from wheelset.bifurcation.fields import arrays, domain, forms, regions, sampling
from wheelset.bifurcation.fields.field import VectorField, vector_field
from wheelset.bifurcation.fields.sampling import TaylorFunction
from wheelset.bifurcation.fields.tape import Tape, record

Array = NDArray[np.float64]


@dataclass(frozen=True)
class System:
    """A field together with parameter values and its sampled functions.

    field: the symbolic right-hand side. values: default value of every parameter, SI.
    functions: by name, what the field's sampled functions evaluate to.
    scales: by name, the typical size of a state, for norms (default: 1).

    States x have shape (n,) or (points, n); parameter vectors p shape (m,), ordered as
    ``parameter_names``, and default to ``values``. Every evaluation returns finite numbers or
    raises a ``NumericalOutcome`` that says what left its domain.
    """

    field: VectorField
    values: Mapping[str, float]
    functions: Mapping[str, TaylorFunction] = dataclasses.field(default_factory=dict)
    scales: Mapping[str, float] = dataclasses.field(default_factory=dict)

    def __post_init__(self) -> None:
        region = {self.field.switch.region.name} if self.field.switch else set()
        missing = set(self.parameter_names) - set(self.values) - region
        if missing:
            raise ValueError(f"no value for parameter {', '.join(sorted(missing))}; give one each")
        unknown = set(self.scales) - set(self.state_names)
        if unknown or not all(size > 0 for size in self.scales.values()):
            raise ValueError(
                f"scales = {dict(self.scales)}: positive sizes of {', '.join(self.state_names)}"
            )
        unsampled = {name for name, _ in self.tape.sampled} - set(self.functions)
        if unsampled:
            raise ValueError(f"no function given for {', '.join(sorted(unsampled))}")

    @classmethod
    def from_function(
        cls,
        f: Callable[..., Sequence[sp.Expr]],
        state: Sequence[str],
        values: Mapping[str, float],
        scales: Mapping[str, float] | None = None,
    ) -> System:
        """A system from a plain Python function f(x, p); parameters are ordered as in values."""
        return cls(vector_field(f, state, tuple(values)), dict(values), {}, dict(scales or {}))

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

    @cached_property
    def state_scales(self) -> Array:
        """Typical sizes of the states, (n,)."""
        return np.array([self.scales.get(name, 1.0) for name in self.state_names])

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
        return self._defaults if p is None else np.ascontiguousarray(p, dtype=np.float64)

    # --- f and its first derivatives, compiled -----------------------------------------------

    def rhs(self, x: ArrayLike, p: Array | None = None) -> Array:
        """f(x, p), shape of x."""
        return self.evaluate(x, p)[0]

    def jacobian(self, x: ArrayLike, p: Array | None = None) -> Array:
        """Exact df/dx, shape x.shape + (n,)."""
        return self.evaluate(x, p)[1]

    def evaluate(
        self,
        x: ArrayLike,
        p: Array | None = None,
        by: Sequence[str] | None = None,
        along: ArrayLike | None = None,
    ) -> tuple[Array, Array]:
        """f, shape of x, and its exact first derivatives, shape x.shape + (columns,).

        Columns: the n states, followed by one for every row of ``along``, directions of the
        parameters, shape (k, m); or instead the states and parameters named in ``by``.
        Compiled on first use, once for every k.
        """
        if by is None:
            return self._first(x, p, self._along(along))
        if along is not None:
            raise ValueError("derivatives by names and along directions; ask for one of them")
        names = [name for name in by if name not in self.state_names]
        f, jacobian = self._first(x, p, self.directions(*names))
        columns = [*self.state_names, *names]
        if columns == list(by):
            return f, jacobian
        return f, jacobian[..., [columns.index(name) for name in by]]

    def directions(self, *names: str) -> Array:
        """Unit directions of parameters, shape (k, m)."""
        rows = np.zeros((len(names), len(self.parameter_names)))
        rows[np.arange(len(names)), [self.index(name) for name in names]] = 1.0
        return rows

    def _along(self, directions: ArrayLike | None) -> Array:
        m = len(self.parameter_names)
        if directions is None:
            return np.empty((0, m))
        rows = np.ascontiguousarray(directions, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != m:
            raise ValueError(f"directions of shape {rows.shape}; give rows of {m}, as p has")
        return rows

    def _first(self, x: ArrayLike, p: Array | None, along: Array) -> tuple[Array, Array]:
        states = np.asarray(x, dtype=np.float64)
        points, columns = self._points(states), self.n + len(along)
        f, jacobian = np.empty_like(points), np.empty((*points.shape, columns))
        self.jacobian_kernel(len(along))(points, self._vector(p), along, f, jacobian)
        return f.reshape(states.shape), jacobian.reshape((*states.shape, columns))

    def _points(self, states: Array) -> Array:
        return np.ascontiguousarray(states.reshape(-1, self.n))

    # --- kernels for hot loops -----------------------------------------------------------------

    def field_kernel(self) -> MeshKernel:
        """``kernel(X, p, F)`` writes f at the states X (points, n) to F (points, n)."""
        return self._kernel(kernels.field_kernel(self.tape))

    def jacobian_kernel(self, k: int = 0) -> MeshKernel:
        """``kernel(X, p, D, F, J)`` writes f to F (points, n) and its derivatives by the states
        and along the directions D (k, m) of the parameters to J (points, n, n + k).
        """
        return self._kernel(kernels.jacobian_kernel(self.tape, k))

    def curvature_kernel(self, k: int = 0) -> MeshKernel:
        """``kernel(X, p, D, V, W, G)`` writes ``curvature`` to G (points, n + k)."""
        return self._kernel(kernels.curvature_kernel(self.tape, k))

    def _kernel(self, kernel: Kernel) -> MeshKernel:
        return mesh_kernel(kernel, self.field, self.tape, self._sampled)

    def _sampled(self, points: Array, order: int) -> Array:
        return sampling.sampled(self.tape, self.functions, points, order, self.state_names)

    # --- higher derivatives --------------------------------------------------------------------

    def curvature(
        self,
        x: ArrayLike,
        p: Array | None,
        v: ArrayLike,
        psi: ArrayLike,
        along: ArrayLike | None = None,
    ) -> Array:
        """Gradient of psi . (Df(x, p) v) by the states and along the directions of the parameters
        ``along`` (k, m): shape x.shape[:-1] + (n + k,), exact.

        v and psi have the shape of x, or one row for all points. Compiled once for every k.
        """
        states, rows = np.asarray(x, dtype=np.float64), self._along(along)
        points = self._points(states)
        v, psi = (np.broadcast_to(np.asarray(a, float), states.shape) for a in (v, psi))
        out = np.empty((len(points), self.n + len(rows)))
        kernel = self.curvature_kernel(len(rows))
        kernel(points, self._vector(p), rows, self._points(v), self._points(psi), out)
        return out.reshape((*states.shape[:-1], self.n + len(rows)))

    def form(self, x: ArrayLike, p: Array | None, *directions: ArrayLike) -> NDArray[Any]:
        """The multilinear form D^k f(x, p)[v_1, ..., v_k], shape (n,), exact.

        Directions have length n (along the state) or n + m (along state and parameters), and may
        be complex. Nothing is compiled for a model.
        """
        return self.forms(np.asarray(x, dtype=np.float64)[np.newaxis], p, *directions)[0]

    def forms(self, x: ArrayLike, p: Array | None, *directions: ArrayLike) -> NDArray[Any]:
        """The form at many points x (points, n) at once, shape (points, n).

        Parameters and directions as in ``form``, one for all points or one row a point: p has
        shape (m,) or (points, m), the latter for a smooth field only.
        """
        points, vector = self._points(np.asarray(x, dtype=np.float64)), self._vector(p)
        if vector.ndim == 2 and (len(vector) != len(points) or self.field.switch is not None):
            raise ValueError(
                f"{len(vector)} rows of parameters for {len(points)} points; give one row, or for "
                "a smooth field one a point"
            )
        rows = forms.packed(self.tape, len(points), [np.asarray(v) for v in directions])
        if self.field.switch is None:
            return self._forms(points, vector, rows)
        out = np.empty(points.shape, rows.dtype)
        for p_region, chosen in regions.split(self.field, points, vector):
            out[chosen] = self._forms(points[chosen], p_region, rows[chosen])
        return out

    def _forms(self, points: Array, p: Array, directions: NDArray[Any]) -> NDArray[Any]:
        return forms.forms(self.tape, points, p, directions, self._sampled, self.state_names)

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
