"""Elementary operations on a program: their values, first and second derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable

from wheelset.bifurcation.compiled.program import Op, Program
from wheelset.bifurcation.fields.tape import Kind, Operation

#: The ``order``-th Taylor coefficient of sampled function number ``b``, as a node.
Sampled = Callable[[int, int], int]


def value(g: Program, o: Operation, a: int, b: int, c: int, sampled: Sampled) -> int:
    """An operation applied to the nodes a, b, c."""
    rules: dict[Kind, Callable[[], int]] = {
        Kind.CONSTANT: lambda: g.constant(o.k),
        Kind.ADD: lambda: g.add(a, b),
        Kind.MUL: lambda: g.multiply(a, b),
        Kind.SHIFT: lambda: g.add(a, g.constant(o.k)),
        Kind.SCALE: lambda: g.multiply(a, g.constant(o.k)),
        Kind.POWER: lambda: power(g, a, o.k),
        Kind.EXP: lambda: g.node(Op.EXP, a),
        Kind.LOG: lambda: g.node(Op.LOG, a),
        Kind.SIN: lambda: g.node(Op.SIN, a),
        Kind.COS: lambda: g.node(Op.COS, a),
        Kind.SAMPLED: lambda: sampled(o.b, 0),
        Kind.SELECT: lambda: g.select(a, b, c),
    }
    return rules[o.kind]()


def first(g: Program, o: Operation, a: int, sampled: Sampled) -> int:
    """First derivative of an operation of one argument."""
    rules: dict[Kind, Callable[[], int]] = {
        Kind.SHIFT: lambda: g.constant(1),
        Kind.SCALE: lambda: g.constant(o.k),
        Kind.POWER: lambda: _power_slope(g, a, o.k, 1),
        Kind.EXP: lambda: g.node(Op.EXP, a),
        Kind.LOG: lambda: g.divide(g.constant(1), a),
        Kind.SIN: lambda: g.node(Op.COS, a),
        Kind.COS: lambda: g.negate(g.node(Op.SIN, a)),
        Kind.SAMPLED: lambda: sampled(o.b, 1),
    }
    return rules[o.kind]()


def second(g: Program, o: Operation, a: int, sampled: Sampled) -> int:
    """Second derivative of an operation of one argument."""
    rules: dict[Kind, Callable[[], int]] = {
        Kind.SHIFT: lambda: g.constant(0),
        Kind.SCALE: lambda: g.constant(0),
        Kind.POWER: lambda: _power_slope(g, a, o.k, 2),
        Kind.EXP: lambda: g.node(Op.EXP, a),
        Kind.LOG: lambda: g.negate(power(g, a, -2.0)),
        Kind.SIN: lambda: g.negate(g.node(Op.SIN, a)),
        Kind.COS: lambda: g.negate(g.node(Op.COS, a)),
        Kind.SAMPLED: lambda: g.multiply(g.constant(2), sampled(o.b, 2)),
    }
    return rules[o.kind]()


def power(g: Program, a: int, k: float) -> int:
    """a^k: by products, one quotient and a square root where 2 k is an integer."""
    if k % 1 == 0.5:
        return g.multiply(g.node(Op.ROOT, a), power(g, a, k - 0.5))
    if k % 1 == 0:
        return _product(g, a if k > 0 else g.divide(g.constant(1), a), abs(int(k)))
    return g.node(Op.POWER, a, number=k)


def _product(g: Program, a: int, count: int) -> int:
    """a a ... a, by squaring."""
    if count < 2:
        return a if count else g.constant(1)
    half = _product(g, a, count // 2)
    square = g.multiply(half, half)
    return g.multiply(square, a) if count % 2 else square


def _power_slope(g: Program, a: int, k: float, order: int) -> int:
    """k (k - 1) ... a^(k - order); a power that is no product is not raised a second time."""
    factor = g.constant(math.prod(k - j for j in range(order)))
    if (2 * k) % 1 == 0:
        return g.multiply(factor, power(g, a, k - order))
    inverse = power(g, a, -order)
    return g.multiply(g.multiply(factor, power(g, a, k)), inverse)
