"""Multilinear forms D^k f(x, p)[v_1, ..., v_k] of a smooth field, at many points at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.fields import domain, multidual
from wheelset.bifurcation.fields.tape import Tape

Array = NDArray[np.float64]
Numbers = NDArray[Any]


def packed(tape: Tape, points: int, directions: Sequence[Numbers]) -> Numbers:
    """Directions as one array (points, k, n or n + m), complex if one of them is.

    Each has n or n + m components (along the states, or states and parameters), one row a point
    or one for all. ValueError for any other length.
    """
    widths = [row.shape[-1] if row.ndim else 0 for row in directions]
    if wrong := set(widths) - {tape.n, tape.n + tape.m}:
        raise ValueError(
            f"a direction has {min(wrong)} components; give {tape.n}, along the states, or "
            f"{tape.n + tape.m}, along states and parameters"
        )
    kind = np.complex128 if any(row.dtype.kind == "c" for row in directions) else np.float64
    out = np.zeros((points, len(directions), max(widths, default=tape.n)), dtype=kind)
    for j, row in enumerate(directions):
        out[:, j, : row.shape[-1]] = row
    return out


def forms(
    tape: Tape,
    points: Array,
    p: Array,
    directions: Numbers,
    sample: Callable[[Array, int], Array],
    names: tuple[str, ...],
) -> Numbers:
    """The form at every point, shape (points, n), of the type of the packed directions.

    points (points, n), states called ``names``; p (m,), or one row a point; sample: Taylor
    coefficients of the sampled functions. Raises DomainLeft or NotFinite for the first point
    without such a derivative.
    """
    order = directions.shape[1]
    bounds = [(slot, c.least) for slot, c in tape.conditions if c.order <= order]
    # complex for real directions, too: machine code is made for one type of numbers only
    slots = np.zeros((tape.n + tape.m + len(tape.operations), 2**order), np.complex128)
    out = np.empty(points.shape, np.complex128)
    done = multidual.over_points(
        tape.packed,
        tape.fixed,
        np.array(points),  # copies: machine code is made for arrays that may be written
        np.array(p, ndmin=2),
        directions.astype(np.complex128),
        sample(points, max(order, 1)),
        (np.array([b[0] for b in bounds], np.int64), np.array([b[1] for b in bounds], float)),
        tape.output_slots,
        (np.ones(len(slots), bool), np.zeros(len(tape.operations), bool), np.empty(order + 2)),
        slots,
        out,
    )
    if done < len(points):
        domain.check_orders(tape, slots[:, 0].real, order, points[done], names)
        bad = ~np.asarray(np.isfinite(slots).all(axis=1))
        raise domain.not_finite(tape, bad, points[done], names)
    return out if np.iscomplexobj(directions) else out.real.copy()
