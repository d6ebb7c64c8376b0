"""A straight-line program: what is loaded, computed and stored for every point of a mesh.

It stands between a tape and machine code. Nodes are numbered as they are written; one that is
already there is used again, and structural zeros and ones disappear, so that a derivative costs
only what depends on its variable. Whatever no store needs is never computed.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import Enum


class Op(Enum):
    """Operations; a, b, c are nodes, k a number."""

    CONSTANT = "constant"  # k
    LOAD = "load"  # element b of argument number a
    ADD = "add"
    SUBTRACT = "subtract"
    MULTIPLY = "multiply"
    DIVIDE = "divide"
    NEGATE = "negate"
    ROOT = "root"
    POWER = "power"  # a^k, neither k nor 2 k an integer
    EXP = "exp"
    LOG = "log"
    SIN = "sin"
    COS = "cos"
    SELECT = "select"  # b where a > 0, else c


@dataclass(frozen=True)
class Node:
    """One operation, the nodes it is applied to (for a load: argument, element), its number."""

    op: Op
    of: tuple[int, ...] = ()
    number: float = 0.0


@dataclass(frozen=True)
class Argument:
    """An array a program reads or writes.

    shape: of one point's part where ``each`` point has its own, so that the array has shape
        (points, *shape); of the whole array otherwise.
    """

    name: str
    shape: tuple[int, ...]
    each: bool = True
    written: bool = False


@dataclass
class Program:
    """Nodes in the order of evaluation, and what becomes of them.

    arguments: the arrays in the order of the call; the first has a row for every point.
    varies: whether a node differs from point to point. stores: (argument, element, node).
    bounds: (node, least): a point where the node does not exceed ``least`` is refused, and so is
        one where a stored number is not finite.
    """

    arguments: tuple[Argument, ...]
    nodes: list[Node] = field(default_factory=list)
    varies: list[bool] = field(default_factory=list)
    stores: list[tuple[int, int, int]] = field(default_factory=list)
    bounds: list[tuple[int, float]] = field(default_factory=list)
    seen: dict[Node, int] = field(default_factory=dict)

    def node(self, op: Op, *of: int, number: float = 0.0) -> int:
        """The place of a node, written down if it is new."""
        node = Node(op, of, number)
        if node not in self.seen:
            self.seen[node] = len(self.nodes)
            self.nodes.append(node)
            own = self.arguments[of[0]].each if op is Op.LOAD else False
            self.varies.append(own or any(self.varies[i] for i in self.inputs(node)))
        return self.seen[node]

    @staticmethod
    def inputs(node: Node) -> tuple[int, ...]:
        """The nodes that a node is computed from."""
        return () if node.op is Op.LOAD else node.of

    def needed(self) -> list[int]:
        """The nodes that stores and bounds depend on, in order."""
        wanted = {node for _, _, node in self.stores} | {node for node, _ in self.bounds}
        for i in range(len(self.nodes) - 1, -1, -1):
            if i in wanted:
                wanted.update(self.inputs(self.nodes[i]))
        return sorted(wanted)

    def argument(self, name: str) -> int:
        """The number of an argument."""
        return [a.name for a in self.arguments].index(name)

    def load(self, name: str, element: int) -> int:
        """An element of an argument (of a point's part of it), counted in C order."""
        return self.node(Op.LOAD, self.argument(name), element)

    def store(self, name: str, nodes: Iterable[int]) -> None:
        """Write nodes to the elements of an argument (of a point's part of it), in C order."""
        argument = self.argument(name)
        self.stores += [(argument, element, node) for element, node in enumerate(nodes)]

    # --- arithmetic, without structural zeros and ones ---------------------------------------

    def constant(self, number: float) -> int:
        """A number."""
        return self.node(Op.CONSTANT, number=float(number))

    def add(self, a: int, b: int) -> int:
        """a + b."""
        if 0 in (self._number(a), self._number(b)):
            return b if self._number(a) == 0 else a
        for term, other in ((b, a), (a, b)):
            if (opposite := self._opposite(term)) is not None:
                return self.node(Op.SUBTRACT, other, opposite)
        return self.node(Op.ADD, *sorted((a, b)))

    def multiply(self, a: int, b: int) -> int:
        """A product a b; its sign is carried outwards."""
        for factor, other in ((a, b), (b, a)):
            if self._number(factor) in (0, 1):
                return factor if self._number(factor) == 0 else other
            if self._number(factor) == -1:
                return self.negate(other)
            if (opposite := self._opposite(factor)) is not None:
                return self.negate(self.multiply(opposite, other))
        return self.node(Op.MULTIPLY, *sorted((a, b)))

    def negate(self, a: int) -> int:
        """Minus a."""
        number, opposite = self._number(a), self._opposite(a)
        if number is not None:
            return self.constant(-number)
        return self.node(Op.NEGATE, a) if opposite is None else opposite

    def divide(self, a: int, b: int) -> int:
        """A quotient a / b."""
        return a if self._number(a) == 0 else self.node(Op.DIVIDE, a, b)

    def select(self, a: int, b: int, c: int) -> int:
        """b where a > 0, else c."""
        return b if b == c else self.node(Op.SELECT, a, b, c)

    def _number(self, i: int) -> float | None:
        node = self.nodes[i]
        return node.number if node.op is Op.CONSTANT else None

    def _opposite(self, i: int) -> int | None:
        node = self.nodes[i]
        return node.of[0] if node.op is Op.NEGATE else None

    # --- as text ------------------------------------------------------------------------------

    def listing(self) -> str:
        """The needed nodes, stores and bounds, one a line, as ``read`` understands them."""
        lines = [
            " ".join([str(i), node.op.value, *map(str, node.of), repr(node.number)])
            for i, node in ((i, self.nodes[i]) for i in self.needed())
        ]
        lines += [f"store {argument} {element} {node}" for argument, element, node in self.stores]
        lines += [f"bound {node} {least!r}" for node, least in self.bounds]
        return "\n".join(lines)


def read(arguments: tuple[Argument, ...], listing: str) -> Program:
    """The program of a listing."""
    program = Program(arguments)
    place: dict[str, int] = {}
    for line in listing.splitlines():
        first, *words = line.split()
        if first == "store":
            program.stores.append((int(words[0]), int(words[1]), place[words[2]]))
        elif first == "bound":
            program.bounds.append((place[words[0]], float(words[1])))
        else:
            name, *of, number = words
            op = Op(name)
            inputs = (int(word) if op is Op.LOAD else place[word] for word in of)
            place[first] = program.node(op, *inputs, number=float(number))
    return program
