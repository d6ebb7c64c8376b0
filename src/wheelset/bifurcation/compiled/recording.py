"""A tape written down as a program, with first derivatives carried forward."""

from __future__ import annotations

from dataclasses import dataclass, field

from wheelset.bifurcation.compiled import rules
from wheelset.bifurcation.compiled.program import Argument, Program
from wheelset.bifurcation.fields.tape import Kind, Operation, Tape

#: Derivatives of a slot: variable -> node, structural zeros left out.
Slope = dict[int, int]


@dataclass
class Recording:
    """Slots of a tape as nodes of a program.

    value, slope: of every slot recorded so far; the variables are any numbers the caller chose.
    fixed_only: slopes of slots that vary from point to point are left out.
    """

    tape: Tape
    program: Program
    fixed_only: bool = False
    value: list[int] = field(default_factory=list)
    slope: list[Slope] = field(default_factory=list)

    def run(self, states: list[Slope], parameters: list[Slope]) -> Recording:
        """Record everything, given the slopes of the states and of the parameters."""
        load, tape = self.program.load, self.tape
        self.value += [load("X", j) for j in range(tape.n)]
        self.value += [load("p", i) for i in range(tape.m)]
        self.slope += [*states, *parameters]
        for o in tape.operations:
            a, b, c = (self.value[i] for i in (o.a, o.b, o.c))
            self.value.append(rules.value(self.program, o, a, b, c, self.sampled))
            skipped = self.fixed_only and self.program.varies[self.value[-1]]
            self.slope.append({} if skipped else self._differentiated(o))
        return self

    def sampled(self, function: int, order: int) -> int:
        """A Taylor coefficient of a sampled function."""
        orders = self.program.arguments[self.program.argument("sampled")].shape[1]
        return self.program.load("sampled", function * orders + order)

    def first(self, o: Operation) -> int:
        """First derivative of an operation of one argument, at its argument."""
        return rules.first(self.program, o, self.value[o.a], self.sampled)

    def second(self, o: Operation) -> int:
        """Second derivative of an operation of one argument, at its argument."""
        return rules.second(self.program, o, self.value[o.a], self.sampled)

    def bound(self, order: int) -> None:
        """Refuse points outside the conditions of derivatives up to an order."""
        self.program.bounds += [
            (self.value[slot], c.least) for slot, c in self.tape.conditions if c.order <= order
        ]

    def _differentiated(self, o: Operation) -> Slope:
        one, a, b = self.program.constant(1), self.slope[o.a], self.slope[o.b]
        if o.kind == Kind.SELECT:
            return self._chosen(self.value[o.a], b, self.slope[o.c])
        if o.kind == Kind.ADD:
            return self._total((a, one), (b, one))
        if o.kind == Kind.MUL:
            return self._total((a, self.value[o.b]), (b, self.value[o.a]))
        return self._total((a, self.first(o))) if a and o.kind != Kind.CONSTANT else {}

    def _chosen(self, decider: int, b: Slope, c: Slope) -> Slope:
        """Slopes of the chosen side only: the other one may be infinite."""
        zero, select = self.program.constant(0), self.program.select
        return {v: select(decider, b.get(v, zero), c.get(v, zero)) for v in sorted({*b, *c})}

    def _total(self, *terms: tuple[Slope, int]) -> Slope:
        g, out = self.program, Slope()
        for slope, factor in terms:
            for v, node in slope.items():
                term = g.multiply(node, factor)
                out[v] = g.add(out[v], term) if v in out else term
        return out


def started(tape: Tape, order: int, *arguments: Argument) -> Program:
    """An empty program of X, p, further arguments and, at the end, what a field samples.

    order: how many derivatives of the sampled functions it may use.
    """
    ends = [Argument("sampled", (len(tape.sampled), order + 1))] if tape.sampled else []
    states, parameters = Argument("X", (tape.n,)), Argument("p", (tape.m,), each=False)
    return Program((states, parameters, *arguments, *ends))


def directions(g: Program, tape: Tape, k: int, first: int = 0) -> list[Slope]:
    """Slopes of the parameters along D (k, m), whose rows are the variables from ``first`` on."""
    return [{first + j: g.load("D", j * tape.m + i) for j in range(k)} for i in range(tape.m)]
