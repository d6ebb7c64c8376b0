"""A program as machine code: one numba function that runs it over all points of a mesh."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from wheelset.bifurcation.compiled import elementary
from wheelset.bifurcation.compiled.lanes import INTEGER, Lanes
from wheelset.bifurcation.compiled.program import Argument, Node, Op, Program, read

#: Points worked on at once.
WIDTH = 8


def runner(arguments: tuple[Argument, ...], listing: str, width: int = WIDTH) -> Any:
    """``run(arrays)`` of a program, for compiled code; arrays is a tuple, as in ``arguments``.

    It returns 0; or 1 + the number of the first point that violates a bound or is not finite, and
    not all points beyond that one are written; or -1 where shapes do not fit.
    """

    @intrinsic
    def run(typing_context: Any, arrays: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            parts = cgutils.unpack_tuple(builder, values[0])
            given = [
                context.make_array(kind)(context, builder, part)
                for kind, part in zip(signature.args[0], parts, strict=True)
            ]
            program = read(arguments, listing.strip())
            return _Emission(program, builder, given, width).answer()

        return types.int64(arrays), generate

    return run


@dataclass
class _Emission:
    """Writes the instructions of a program; ``given`` are numba's structures of its arrays."""

    program: Program
    builder: Any
    given: Sequence[Any]
    width: int

    def answer(self) -> Any:
        """What ``run`` returns."""
        shapes = [cgutils.unpack_tuple(self.builder, array.shape) for array in self.given]
        points = shapes[0][0]
        answer = cgutils.alloca_once_value(self.builder, points.type(-1))
        with self.builder.if_then(self._fits(shapes, points)):
            self.builder.store(points.type(0), answer)
            self._run(points, answer)
        return self.builder.load(answer)

    def _fits(self, shapes: Sequence[Sequence[Any]], points: Any) -> Any:
        out = cgutils.true_bit
        for argument, shape in zip(self.program.arguments, shapes, strict=True):
            lengths = [points.type(length) for length in argument.shape]
            wanted = [points, *lengths] if argument.each else lengths
            for length, expected in zip(shape, wanted, strict=True):
                same = self.builder.icmp_signed("==", length, expected)
                out = self.builder.and_(out, same)
        return out

    def _run(self, points: Any, answer: Any) -> None:
        """The loop over blocks of points; what does not vary is computed before it."""
        builder, integer, needed = self.builder, points.type, self.program.needed()
        once = self._once([i for i in needed if not self.program.varies[i]])
        each = [i for i in needed if self.program.varies[i]]
        blocks = builder.sdiv(builder.add(points, integer(self.width - 1)), integer(self.width))
        with cgutils.for_range(builder, blocks) as loop:
            at = builder.mul(loop.index, integer(self.width))
            lanes = [self._clamped(at, lane, points) for lane in range(self.width)]
            refused = self._block(lanes, dict(once), each)
            with builder.if_then(builder.icmp_signed("!=", refused, refused.type(0)), likely=False):
                first = builder.zext(builder.cttz(refused, cgutils.true_bit), integer)
                builder.store(builder.add(builder.add(at, first), integer(1)), answer)
                loop.do_break()

    def _clamped(self, at: Any, lane: int, points: Any) -> Any:
        """The point of a lane; beyond the last point that one again."""
        builder = self.builder
        index = builder.add(at, at.type(lane))
        last = builder.sub(points, at.type(1))
        return builder.select(builder.icmp_signed("<", index, points), index, last)

    def _once(self, nodes: Sequence[int]) -> dict[int, Any]:
        single, values = Lanes(self.builder, 1), dict[int, Any]()
        for i in nodes:
            values[i] = self._node(single, values, [INTEGER(0)], self.program.nodes[i])
        lanes = Lanes(self.builder, self.width)
        wanted = self._outer(nodes)
        return {i: lanes.spread(values[i]) if i in wanted else values[i] for i in nodes}

    def _outer(self, nodes: Sequence[int]) -> set[int]:
        program = self.program
        used = {node for _, _, node in program.stores} | {node for node, _ in program.bounds}
        for i, node in enumerate(program.nodes):
            if program.varies[i]:
                used.update(program.inputs(node))
        return used.intersection(nodes)

    def _block(self, points: Sequence[Any], values: dict[int, Any], nodes: Sequence[int]) -> Any:
        """Compute and store one block; the points to be refused, as the bits of an integer."""
        lanes = Lanes(self.builder, self.width)
        for i in nodes:
            values[i] = self._node(lanes, values, points, self.program.nodes[i])
        total = lanes.number(0.0)
        for array, element, node in self.program.stores:
            lanes.scatter(
                values[node], self.given[array].data, self._offsets(array, element, points)
            )
            total = lanes.add(total, values[node])
        good = lanes.exceeds(lanes.number(math.inf), lanes.magnitude(total))
        for node, least in self.program.bounds:
            inside = lanes.exceeds(values[node], lanes.number(least))
            good = self.builder.and_(good, inside)
        return lanes.mask(self.builder.not_(good))

    def _offsets(self, array: int, element: int, points: Sequence[Any]) -> list[Any]:
        argument, builder = self.program.arguments[array], self.builder
        if not argument.each:
            return [points[0].type(element)]
        step = points[0].type(math.prod(argument.shape))
        return [builder.add(builder.mul(p, step), p.type(element)) for p in points]

    def _node(self, e: Lanes, values: dict[int, Any], points: Sequence[Any], node: Node) -> Any:
        if node.op is Op.LOAD:
            array, element = node.of
            return e.gather(self.given[array].data, self._offsets(array, element, points))
        if node.op is Op.CONSTANT:
            return e.number(node.number)
        inputs = [values[i] for i in node.of]
        if node.op is Op.POWER:
            return elementary.power(e, inputs[0], node.number)
        return _RULES[node.op](e, *inputs)


_RULES: dict[Op, Callable[..., Any]] = {
    Op.SELECT: lambda e, a, b, c: e.choose(e.exceeds(a, e.number(0.0)), b, c),
    Op.ADD: Lanes.add,
    Op.SUBTRACT: Lanes.subtract,
    Op.MULTIPLY: Lanes.multiply,
    Op.DIVIDE: Lanes.divide,
    Op.NEGATE: Lanes.negate,
    Op.ROOT: Lanes.root,
    Op.EXP: elementary.exp,
    Op.LOG: elementary.log,
    Op.SIN: elementary.sin,
    Op.COS: elementary.cos,
}
