"""Gradient of psi . (Df(x, p) v): one backward sweep over a tape and its slopes along v.

Forward, every slot has its value a and its slope a' along v. Backward, every slot gets the
derivatives of S = psi . f' by the two: by_value = dS/da, by_slope = dS/da'. For c = a b,
c' = a' b + a b', and for c = g(a), c' = g'(a) a',

    by_slope[a] += b by_slope[c]         by_value[a] += b by_value[c] + b' by_slope[c]
    by_slope[a] += g' by_slope[c]        by_value[a] += g' by_value[c] + g'' a' by_slope[c].

All states come out at once. What depends on parameters only is not swept: its derivatives along
the directions are carried forward, before the loop over points, and meet dS/da at its edge.
"""

from __future__ import annotations

from dataclasses import dataclass

from wheelset.bifurcation.compiled.program import Argument, Program
from wheelset.bifurcation.compiled.recording import Recording, directions, started
from wheelset.bifurcation.fields.tape import Kind, Operation, Tape

#: Sides of switches on which a slot is used: (node that decides, whether it is positive).
Guard = frozenset[tuple[int, bool]]

ALONG = 0  # the one variable of the forward sweep


def curvature(tape: Tape, k: int) -> Program:
    """Program (X, p, D, V, W, G[, sampled]): G (points, n + k) is the gradient of W . (Df V) by
    the states, followed by its derivatives along the k parameter directions D (k, m).
    """
    rows = (Argument(name, (tape.n,)) for name in ("V", "W"))
    gradient = Argument("G", (tape.n + k,), written=True)
    g = started(tape, 2, Argument("D", (k, tape.m), each=False), *rows, gradient)
    states = [{ALONG: g.load("V", j)} for j in range(tape.n)]
    forward = Recording(tape, g).run(states, [{}] * tape.m)
    edge = Recording(tape, g, fixed_only=True).run([{}] * tape.n, directions(g, tape, k))
    sweep, totals = _Sweep(forward), [g.constant(0)] * k
    sweep.run()
    for slot, slope in enumerate(edge.slope):
        for j, along in slope.items():
            totals[j] = g.add(totals[j], sweep.times(slot, along))
    g.store("G", [sweep.times(j, g.constant(1)) for j in range(tape.n)] + totals)
    forward.bound(2)
    return g


@dataclass
class _Sweep:
    """The backward sweep over the slots that vary from point to point."""

    forward: Recording

    def __post_init__(self) -> None:
        zero = self.forward.program.constant(0)
        self.by_value = [zero] * len(self.forward.value)
        self.by_slope = list(self.by_value)
        self.guard = _guards(self.forward)

    def run(self) -> None:
        """Hand S back to the states, and to what does not vary but is used by what does."""
        g, tape, value = self.forward.program, self.forward.tape, self.forward.value
        for row, slot in enumerate(tape.outputs):
            self._give(Guard(), slot, g.constant(0), g.load("W", row))
        for slot in range(len(value) - 1, tape.n + tape.m - 1, -1):
            if g.varies[value[slot]]:
                self._back(slot, tape.operations[slot - tape.n - tape.m])

    def times(self, slot: int, factor: int) -> int:
        """dS/da of a slot times a factor, which need not exist where the slot is not used."""
        product = self.forward.program.multiply(self.by_value[slot], factor)
        return self._masked(self.guard[slot], product)

    def _back(self, slot: int, o: Operation) -> None:
        g, x, y = self.forward.program, self.by_value[slot], self.by_slope[slot]
        guard, decider = self.guard[slot], self.forward.value[o.a]
        if o.kind == Kind.MUL:
            self._factor(slot, o.a, o.b)
            self._factor(slot, o.b, o.a)
        elif o.kind == Kind.ADD:
            self._give(guard, o.a, x, y)
            self._give(guard, o.b, x, y)
        elif o.kind == Kind.SELECT:
            self._give(guard | {(decider, True)}, o.b, x, y)
            self._give(guard | {(decider, False)}, o.c, x, y)
        else:
            first, second = self.forward.first(o), self.forward.second(o)
            bent = g.multiply(g.multiply(second, self._along(o.a)), y)
            self._give(guard, o.a, g.add(g.multiply(first, x), bent), g.multiply(first, y))

    def _factor(self, slot: int, a: int, other: int) -> None:
        g, x, y = self.forward.program, self.by_value[slot], self.by_slope[slot]
        b = self.forward.value[other]
        value = g.add(g.multiply(b, x), g.multiply(self._along(other), y))
        self._give(self.guard[slot], a, value, g.multiply(b, y))

    def _along(self, slot: int) -> int:
        return self.forward.slope[slot].get(ALONG, self.forward.program.constant(0))

    def _give(self, guard: Guard, slot: int, value: int, slope: int) -> None:
        """Add to a slot what a user of it, itself used under a guard, hands back."""
        g, lost = self.forward.program, guard - self.guard[slot]
        self.by_value[slot] = g.add(self.by_value[slot], self._masked(lost, value))
        self.by_slope[slot] = g.add(self.by_slope[slot], self._masked(lost, slope))

    def _masked(self, guard: Guard, node: int) -> int:
        """A node on the sides it belongs to, zero elsewhere, where it may be infinite."""
        g = self.forward.program
        for decider, positive in sorted(guard):
            sides = (node, g.constant(0)) if positive else (g.constant(0), node)
            node = g.select(decider, *sides)
        return node


def _guards(recording: Recording) -> list[Guard]:
    """For every slot the sides common to all its uses."""
    tape, value = recording.tape, recording.value
    guard: list[Guard | None] = [None] * len(value)

    def use(slot: int, at: Guard) -> None:
        known = guard[slot]
        guard[slot] = at if known is None else known & at

    for slot in tape.outputs:
        use(slot, Guard())
    for slot in range(len(value) - 1, tape.n + tape.m - 1, -1):
        o, here = tape.operations[slot - tape.n - tape.m], guard[slot]
        if here is None:
            continue
        for place, argument in enumerate(o.arguments):
            side = {(value[o.a], place == 1)} if o.kind == Kind.SELECT and place else set()
            use(argument, here | side)
    return [at or Guard() for at in guard]
