"""A tape evaluated on numpy arrays of any shape, with every named quantity along the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.fields.tape import Kind, Operation, Tape

Array = NDArray[np.float64]


def evaluate(tape: Tape, inputs: Sequence[Any], sampled: Mapping[int, Array]) -> list[Any]:
    """Every slot of a tape.

    inputs: n + m floats or arrays that broadcast together. sampled: values of the sampled
    functions by number, already evaluated at their state variable. Undefined values are nan here;
    the caller compares the conditions' slots with their bounds.
    """
    slots: list[Any] = list(inputs)
    with np.errstate(all="ignore"):
        for operation in tape.operations:
            slots.append(_apply(operation, slots, sampled))
    return slots


def _apply(o: Operation, slots: list[Any], sampled: Mapping[int, Array]) -> Any:
    a = np.asarray(slots[o.a], dtype=np.float64)
    rules = {
        Kind.CONSTANT: lambda: o.k,
        Kind.ADD: lambda: a + slots[o.b],
        Kind.MUL: lambda: a * slots[o.b],
        Kind.SHIFT: lambda: a + o.k,
        Kind.SCALE: lambda: o.k * a,
        Kind.POWER: lambda: a**o.k,
        Kind.EXP: lambda: np.exp(a),
        Kind.LOG: lambda: np.log(a),
        Kind.SIN: lambda: np.sin(a),
        Kind.COS: lambda: np.cos(a),
        Kind.SAMPLED: lambda: sampled[o.b],
        Kind.SELECT: lambda: np.where(a > 0, slots[o.b], slots[o.c]),
    }
    return rules[o.kind]()
