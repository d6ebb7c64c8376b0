"""A vector field x' = f(x, p), written down once, in sympy, as a list of short assignments.

The assignments are kept apart (a rolling radius, then a creepage, then a force) instead of being
substituted into one long expression: the list is what a book prints, what differentiates quickly,
and what a domain condition can point at.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import sympy as sp

Assignment = tuple[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Condition:
    """``symbol`` has to exceed ``least`` for the field to be defined (order 0) or for its
    derivatives of that order and above to exist.

    quantity, where, unit: the words of the message, e.g. "sum of curvatures", "left wheel", "1/m".
    """

    symbol: sp.Symbol
    quantity: str
    where: str = ""
    unit: str = ""
    least: float = 0.0
    order: int = 0


@dataclass(frozen=True)
class Switch:
    """A piecewise smooth field: ``region`` is a parameter that takes ``values[k]`` where ``k``
    thresholds lie below ``variable``. Inside a region the field is smooth; nothing is smeared.

    thresholds: increasing expressions in the parameters; one fewer than values.
    """

    region: sp.Symbol
    variable: sp.Symbol
    thresholds: tuple[sp.Expr, ...]
    values: tuple[float, ...]


@dataclass(frozen=True)
class VectorField:
    """x' = f(x, p) as assignments.

    state, parameters: the symbols of x, shape (n,), and of p, shape (m,).
    assignments: (symbol, expression) in the order of evaluation; each expression may use the
        state, the parameters, earlier symbols, and sampled functions of one state variable
        (``sympy.Function("name")(y)``) whose Taylor coefficients are supplied later.
    derivative: the n expressions of f.
    domain: conditions under which the assignments make sense.
    switch: for a piecewise smooth field.
    """

    state: tuple[sp.Symbol, ...]
    parameters: tuple[sp.Symbol, ...]
    derivative: tuple[sp.Expr, ...]
    assignments: tuple[Assignment, ...] = ()
    domain: tuple[Condition, ...] = ()
    switch: Switch | None = None

    def __post_init__(self) -> None:
        _check_closed(self)

    @property
    def state_names(self) -> tuple[str, ...]:
        """Names of the state variables, in order."""
        return tuple(s.name for s in self.state)

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the parameters, in order."""
        return tuple(s.name for s in self.parameters)


def vector_field(
    f: Callable[..., Sequence[sp.Expr]], state: Sequence[str], parameters: Sequence[str]
) -> VectorField:
    """A field from a plain Python function ``f(x, p)`` written with operators and sympy functions.

    ``x`` and ``p`` arrive as sequences of symbols in the given order; f returns n expressions.
    """
    x = tuple(sp.Symbol(name, real=True) for name in state)
    p = tuple(sp.Symbol(name, real=True) for name in parameters)
    return VectorField(x, p, tuple(sp.sympify(e) for e in f(x, p)))


def _check_closed(field: VectorField) -> None:
    """Every symbol has to be known when it is used."""
    known = set(field.state) | set(field.parameters)
    for symbol, expression in field.assignments:
        _check_known(expression, known, f"assignment of {symbol}")
        known.add(symbol)
    if len(field.derivative) != len(field.state):
        raise ValueError(
            f"{len(field.derivative)} derivatives for {len(field.state)} state variables; "
            "give one expression a state variable"
        )
    for name, expression in zip(field.state_names, field.derivative, strict=True):
        _check_known(expression, known, f"derivative of {name}")


def _check_known(expression: sp.Expr, known: set[sp.Symbol], place: str) -> None:
    unknown = sorted(str(s) for s in expression.free_symbols - known)
    if unknown:
        raise ValueError(
            f"unknown symbol {', '.join(unknown)} in the {place}; "
            "declare it as a state variable, a parameter or an earlier assignment"
        )
