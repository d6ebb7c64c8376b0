"""Arithmetic on several points at once: instructions for vectors of doubles, one lane a point.

A thin layer over numba's code builder. With one lane it is ordinary arithmetic, operation by
operation the same, so that a point's result does not depend on its neighbours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from llvmlite import ir  # the builder of numba itself

#: The sign of zero is free. Nothing else is: what is symmetric on paper cancels to the last bit.
FLAGS = ("nsz",)
DOUBLE, INTEGER = ir.DoubleType(), ir.IntType(64)


@dataclass(frozen=True)
class Lanes:
    """Writes instructions for ``width`` points at a time."""

    builder: Any
    width: int

    def typed(self, scalar: Any) -> Any:
        """The vector type of a scalar type."""
        return scalar if self.width == 1 else ir.VectorType(scalar, self.width)

    def number(self, x: float) -> Any:
        """A double in every lane."""
        return self._constant(DOUBLE, float(x))

    def integer(self, i: int) -> Any:
        """A 64-bit integer in every lane."""
        return self._constant(INTEGER, i)

    def _constant(self, scalar: Any, value: float) -> Any:
        return ir.Constant(self.typed(scalar), value if self.width == 1 else [value] * self.width)

    def spread(self, scalar: Any) -> Any:
        """A scalar in every lane."""
        if self.width == 1:
            return scalar
        undefined = ir.Constant(self.typed(DOUBLE), ir.Undefined)
        first = self.builder.insert_element(undefined, scalar, ir.IntType(32)(0))
        mask = ir.Constant(ir.VectorType(ir.IntType(32), self.width), [0] * self.width)
        return self.builder.shuffle_vector(first, undefined, mask)

    def gather(self, base: Any, offsets: Sequence[Any]) -> Any:
        """The doubles at one offset a lane."""
        values = [self.builder.load(self.builder.gep(base, [o])) for o in offsets]
        if self.width == 1:
            return values[0]
        out = ir.Constant(self.typed(DOUBLE), ir.Undefined)
        for lane, value in enumerate(values):
            out = self.builder.insert_element(out, value, ir.IntType(32)(lane))
        return out

    def scatter(self, x: Any, base: Any, offsets: Sequence[Any]) -> None:
        """Write each lane to its offset."""
        for lane, offset in enumerate(offsets):
            value = x if self.width == 1 else self.builder.extract_element(x, ir.IntType(32)(lane))
            self.builder.store(value, self.builder.gep(base, [offset]))

    def add(self, a: Any, b: Any) -> Any:
        """a + b."""
        return self.builder.fadd(a, b, flags=FLAGS)

    def subtract(self, a: Any, b: Any) -> Any:
        """a - b."""
        return self.builder.fsub(a, b, flags=FLAGS)

    def multiply(self, a: Any, b: Any) -> Any:
        """A product a b."""
        return self.builder.fmul(a, b, flags=FLAGS)

    def divide(self, a: Any, b: Any) -> Any:
        """A quotient a / b."""
        return self.builder.fdiv(a, b, flags=FLAGS)

    def negate(self, a: Any) -> Any:
        """Minus a."""
        return self.builder.fneg(a)

    def root(self, a: Any) -> Any:
        """The square root; nan below zero."""
        return self._call("llvm.sqrt", a)

    def magnitude(self, a: Any) -> Any:
        """|a|."""
        return self._call("llvm.fabs", a)

    def fused(self, a: Any, b: Any, c: Any) -> Any:
        """a b + c, rounded once."""
        return self._call("llvm.fma", a, b, c)

    def _call(self, intrinsic: str, *arguments: Any) -> Any:
        kind = arguments[0].type
        suffix = "f64" if self.width == 1 else f"v{self.width}f64"
        name, module = f"{intrinsic}.{suffix}", self.builder.module
        function = module.globals.get(name) or ir.Function(
            module, ir.FunctionType(kind, [kind] * len(arguments)), name
        )
        return self.builder.call(function, arguments)

    def exceeds(self, a: Any, b: Any) -> Any:
        """Whether a > b, lane by lane; nan exceeds nothing."""
        return self.builder.fcmp_ordered(">", a, b)

    def choose(self, condition: Any, a: Any, b: Any) -> Any:
        """A where the condition holds, else b."""
        return self.builder.select(condition, a, b)

    def mask(self, condition: Any) -> Any:
        """A condition as an integer, its lowest bit the first lane."""
        whole = ir.IntType(self.width)
        return condition if self.width == 1 else self.builder.bitcast(condition, whole)

    def bits(self, a: Any) -> Any:
        """The pattern of a double as an integer."""
        return self.builder.bitcast(a, self.typed(INTEGER))

    def pattern(self, i: Any) -> Any:
        """The double of a pattern."""
        return self.builder.bitcast(i, self.typed(DOUBLE))
