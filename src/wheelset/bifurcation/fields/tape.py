"""A vector field as a tape: a straight list of elementary operations, each done once.

The tape is the one intermediate form between sympy and numbers. It is read by three evaluators:
``arrays`` (numpy, any shape, every named quantity), ``multidual`` (derivatives of any order) and
``recording`` (programs for machine code: f, exact Jacobians, curvatures).

Slots are numbered: [ state n | parameters m | operations ... ].
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property, lru_cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from wheelset.bifurcation.fields.field import Condition, VectorField


class Kind(IntEnum):
    """Elementary operations; a, b, c are slots, k a constant."""

    CONSTANT = 0  # k
    ADD = 1  # a + b
    MUL = 2  # a b
    SHIFT = 3  # a + k
    SCALE = 4  # k a
    POWER = 5  # a^k
    EXP = 6
    LOG = 7
    SIN = 8
    COS = 9
    SAMPLED = 10  # function number b of slot a, from its Taylor coefficients
    SELECT = 11  # b where a > 0, else c


@dataclass(frozen=True)
class Operation:
    """One elementary operation: its kind, argument slots and constant."""

    kind: Kind
    a: int = 0
    b: int = 0
    c: int = 0
    k: float = 0.0

    @property
    def arguments(self) -> tuple[int, ...]:
        """The slots it is applied to; of a choice, the one that decides comes first."""
        count = {Kind.CONSTANT: 0, Kind.ADD: 2, Kind.MUL: 2, Kind.SELECT: 3}
        return (self.a, self.b, self.c)[: count.get(self.kind, 1)]


@dataclass(frozen=True, eq=False)
class Tape:
    """A recorded field; equal only to itself, so that it can key a cache.

    operations: in order of evaluation, the i-th fills slot ``n + m + i``.

    outputs: slots of f, length n. named: slot of every assigned symbol.
    conditions: (slot, condition) in the order of evaluation.
    sampled: (function name, index of the state variable it is evaluated at), by function number.
    """

    n: int
    m: int
    operations: tuple[Operation, ...]
    outputs: tuple[int, ...]
    named: dict[str, int]
    conditions: tuple[tuple[int, Condition], ...]
    sampled: tuple[tuple[str, int], ...]

    @cached_property
    def packed(self) -> tuple[NDArray[np.uint64], NDArray[np.float64]]:
        """(kind, a, b, c) as rows of an array of integers, unsigned since compiled code is quicker
        with indices that cannot count from the end; and the constants.
        """
        rows = [(o.kind, o.a, o.b, o.c) for o in self.operations]
        return (
            np.array(rows, dtype=np.uint64).reshape(-1, 4),
            np.array([o.k for o in self.operations], dtype=np.float64),
        )

    @cached_property
    def output_slots(self) -> NDArray[np.int64]:
        """``outputs`` as an index array."""
        return np.array(self.outputs, dtype=np.int64)

    @cached_property
    def fixed(self) -> NDArray[np.bool_]:
        """Which operations depend on parameters only."""
        still = [False] * self.n + [True] * self.m
        for o in self.operations:
            still.append(o.kind != Kind.SAMPLED and all(still[a] for a in o.arguments))
        return np.array(still[self.n + self.m :], dtype=np.bool_)

    def name_of(self, slot: int) -> str:
        """The first named quantity at or after a slot: for messages."""
        later = [(s, name) for name, s in self.named.items() if s >= slot]
        return min(later)[1] if later else "the time derivative"


@lru_cache(maxsize=64)
def record(field: VectorField) -> Tape:
    """The tape of a field; equal subexpressions are evaluated once."""
    return _Recorder(field).tape()


class _Recorder:
    """Writes operations down, reusing every one that is already there."""

    def __init__(self, field: VectorField) -> None:
        self.field = field
        self.offset = len(field.state) + len(field.parameters)
        self.operations: list[Operation] = []
        self.seen: dict[Operation, int] = {}
        self.sampled: list[tuple[str, int]] = []
        self.slots = {s: i for i, s in enumerate((*field.state, *field.parameters))}

    def tape(self) -> Tape:
        for symbol, expression in self.field.assignments:
            self.slots[symbol] = self.slot(expression)
        outputs = tuple(self.slot(e) for e in self.field.derivative)
        n, m = len(self.field.state), len(self.field.parameters)
        named = {s.name: self.slots[s] for s, _ in self.field.assignments}
        conditions = tuple((self.slots[c.symbol], c) for c in self.field.domain)
        return Tape(n, m, tuple(self.operations), outputs, named, conditions, tuple(self.sampled))

    def emit(self, kind: Kind, a: int = 0, b: int = 0, c: int = 0, k: float = 0.0) -> int:
        if kind in (Kind.ADD, Kind.MUL) and a > b:
            a, b = b, a
        operation = Operation(kind, a, b, c, k)
        if operation not in self.seen:
            self.operations.append(operation)
            self.seen[operation] = self.offset + len(self.operations) - 1
        return self.seen[operation]

    def slot(self, e: sp.Expr) -> int:
        if isinstance(e, sp.Symbol):
            return self.slots[e]
        if e.is_number:
            return self.emit(Kind.CONSTANT, k=float(e))
        if isinstance(e, sp.Add):
            return self.sum(e)
        if isinstance(e, sp.Mul):
            return self.product(e)
        if isinstance(e, sp.Pow):
            return self.power(e.base, e.exp)
        if isinstance(e, sp.Piecewise):
            return self.piecewise(e)
        return self.function(e)

    def sum(self, e: sp.Expr) -> int:
        number, rest = e.as_coeff_Add()
        slots = [self.slot(term) for term in sp.Add.make_args(rest)]
        total = slots[0]
        for s in slots[1:]:
            total = self.emit(Kind.ADD, total, s)
        return self.emit(Kind.SHIFT, total, k=float(number)) if number else total

    def product(self, e: sp.Expr) -> int:
        number, rest = e.as_coeff_Mul()
        if isinstance(rest, sp.Mul):
            over, under = _fraction(rest)
        else:
            over, under = [rest], []
        out = self.multiply(over) if over else None
        if under:
            inverse = self.emit(Kind.POWER, self.multiply(under), k=-1.0)
            out = inverse if out is None else self.emit(Kind.MUL, out, inverse)
        assert out is not None
        return out if number == 1 else self.emit(Kind.SCALE, out, k=float(number))

    def multiply(self, factors: list[sp.Expr]) -> int:
        slots = [self.slot(f) for f in factors]
        out = slots[0]
        for s in slots[1:]:
            out = self.emit(Kind.MUL, out, s)
        return out

    def power(self, base: sp.Expr, exponent: sp.Expr) -> int:
        if base == sp.E:
            return self.emit(Kind.EXP, self.slot(exponent))
        if not exponent.is_number:
            return self.slot(sp.exp(exponent * sp.log(base)))
        if exponent.is_Integer and 1 < abs(exponent) <= 16:
            positive = self.integer_power(self.slot(base), abs(int(exponent)))
            return positive if exponent > 0 else self.emit(Kind.POWER, positive, k=-1.0)
        return self.emit(Kind.POWER, self.slot(base), k=float(exponent))

    def integer_power(self, a: int, exponent: int) -> int:
        if exponent == 1:
            return a
        half = self.integer_power(a, exponent // 2)
        square = self.emit(Kind.MUL, half, half)
        return self.emit(Kind.MUL, square, a) if exponent % 2 else square

    def piecewise(self, e: sp.Piecewise) -> int:
        (value, condition), *rest = e.args
        if condition == True or not rest:  # noqa: E712  (a sympy truth value)
            return self.slot(value)
        decider = self.slot(condition.gts - condition.lts)
        return self.emit(
            Kind.SELECT, decider, self.slot(value), self.slot(sp.Piecewise(*rest, evaluate=False))
        )

    def function(self, e: sp.Expr) -> int:
        elementary = {sp.exp: Kind.EXP, sp.log: Kind.LOG, sp.sin: Kind.SIN, sp.cos: Kind.COS}
        if isinstance(e, AppliedUndef):
            return self.sample(e)
        if e.func in elementary:
            return self.emit(elementary[e.func], self.slot(e.args[0]))
        if e.func is sp.tan:
            return self.slot(sp.sin(e.args[0], evaluate=False) / sp.cos(e.args[0], evaluate=False))
        rewritten = e.rewrite(sp.exp)
        if rewritten == e:
            raise ValueError(
                f"no rule for {e.func.__name__} in {e}; use + - * / **, exp, log, sin, cos, tan, "
                "sinh, cosh, tanh, sqrt, Piecewise or a sampled function"
            )
        return self.slot(rewritten)

    def sample(self, e: AppliedUndef) -> int:
        (argument,) = e.args
        if argument not in self.field.state:
            raise ValueError(f"sampled function {e} has to be evaluated at a state variable")
        entry = (e.func.__name__, self.field.state.index(argument))
        if entry not in self.sampled:
            self.sampled.append(entry)
        return self.emit(Kind.SAMPLED, self.slot(argument), self.sampled.index(entry))


def _fraction(product: sp.Mul) -> tuple[list[sp.Expr], list[sp.Expr]]:
    """Factors over and under the fraction line."""
    over: list[sp.Expr] = []
    under: list[sp.Expr] = []
    for factor in product.args:
        base, exponent = factor.as_base_exp()
        if exponent.is_Rational and exponent < 0:
            under.append(base ** (-exponent))
        else:
            over.append(factor)
    return over, under
