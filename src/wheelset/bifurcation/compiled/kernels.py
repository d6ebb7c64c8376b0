"""Machine code of a field, made once a tape: f, f with its first derivatives, curvatures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.compiled import codegen
from wheelset.bifurcation.compiled.curvature import curvature
from wheelset.bifurcation.compiled.program import Argument, Program
from wheelset.bifurcation.compiled.recording import Recording, directions, started
from wheelset.bifurcation.fields.tape import Tape

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Kernel:
    """A compiled program: its arguments, and ``run`` of their arrays.

    order: of the highest derivative in it. run: 0 when all went well; 1 + the number of a point
    that left the domain or is not finite, further points may then not be written; -1 where the
    shapes of the arrays do not fit.
    """

    order: int
    arguments: tuple[Argument, ...]
    run: Callable[..., int]

    @property
    def smoothness(self) -> int:
        """Order up to which the field's conditions are kept; the Jacobian's kernel also serves who
        asks for f alone, and refuses no point where f is defined and J is finite.
        """
        return self.order if self.order > 1 else 0

    def complaint(self, arrays: Sequence[Array]) -> str:
        """What to say of arrays whose shapes do not fit."""
        points = arrays[0].shape[0]
        takes = ((a.name, (points, *a.shape) if a.each else a.shape) for a in self.arguments)
        wanted = ", ".join(f"{name} {shape}" for name, shape in takes)
        return f"arrays of shapes {[a.shape for a in arrays]} where {points} points need {wanted}"


@lru_cache(maxsize=64)
def field_kernel(tape: Tape) -> Kernel:
    """Kernel of (X, p, F[, sampled])."""
    return _kernel(0, values(tape))


@lru_cache(maxsize=64)
def jacobian_kernel(tape: Tape, k: int) -> Kernel:
    """Kernel of (X, p, D, F, J[, sampled]) for k parameter directions."""
    return _kernel(1, jacobian(tape, k))


@lru_cache(maxsize=64)
def curvature_kernel(tape: Tape, k: int) -> Kernel:
    """Kernel of (X, p, D, V, W, G[, sampled]) for k parameter directions."""
    return _kernel(2, curvature(tape, k))


def _kernel(order: int, program: Program) -> Kernel:
    return Kernel(order, program.arguments, codegen.compiled(program))


def values(tape: Tape) -> Program:
    """Program (X, p, F[, sampled]): F (points, n) is f."""
    g = started(tape, 0, Argument("F", (tape.n,), written=True))
    r = Recording(tape, g).run([{}] * tape.n, [{}] * tape.m)
    g.store("F", [r.value[slot] for slot in tape.outputs])
    r.bound(0)
    return g


def jacobian(tape: Tape, k: int) -> Program:
    """Program (X, p, D, F, J[, sampled]): F (points, n) is f, J (points, n, n + k) its derivatives
    by the states, followed by those along the k parameter directions D (k, m).
    """
    n = tape.n
    f, j = Argument("F", (n,), written=True), Argument("J", (n, n + k), written=True)
    g = started(tape, 1, Argument("D", (k, tape.m), each=False), f, j)
    zero, one = g.constant(0), g.constant(1)
    r = Recording(tape, g).run([{i: one} for i in range(n)], directions(g, tape, k, n))
    g.store("F", [r.value[slot] for slot in tape.outputs])
    g.store("J", [r.slope[slot].get(v, zero) for slot in tape.outputs for v in range(n + k)])
    r.bound(0)
    return g
