"""Where a tape's conditions are violated, said as an outcome."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.fields.field import Condition
from wheelset.bifurcation.fields.tape import Tape
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite, as_tuple

Names = tuple[str, ...]


def check_slots(tape: Tape, slots: Sequence[Any], state: Any, names: Names) -> None:
    """Raise DomainLeft for the first condition (of order 0) that any element violates.

    slots: values of every slot, state: the n state variables; floats or arrays that broadcast.
    """
    for slot, condition in tape.conditions:
        bad = ~(np.asarray(slots[slot]) > condition.least)
        if condition.order == 0 and bad.any():
            values, bad, *x = np.broadcast_arrays(slots[slot], bad, *state)
            at = np.unravel_index(np.argmax(bad), bad.shape)
            raise domain_left(condition, values[at], [xi[at] for xi in x], names)


def check_orders(tape: Tape, slots: Any, order: int, state: Any, names: Names) -> None:
    """Raise DomainLeft where derivatives of an order are asked for and do not exist."""
    for slot, condition in tape.conditions:
        if condition.order <= order and not slots[slot] > condition.least:
            raise domain_left(condition, slots[slot], state, names)


def domain_left(c: Condition, value: float, state: Any, names: Names) -> DomainLeft:
    """The outcome of a violated condition."""
    return DomainLeft(c.quantity, c.where, float(value), c.least, c.unit, as_tuple(state), names)


def not_finite(tape: Tape, bad: NDArray[np.bool_], state: Any, names: Names) -> NotFinite:
    """The outcome of an overflow; ``bad`` marks the slots that are not finite."""
    first = int(np.flatnonzero(bad)[0]) if bad.any() else len(bad)
    return NotFinite(tape.name_of(first), as_tuple(state), names)
