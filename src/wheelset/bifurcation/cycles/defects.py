"""The collocation equations of an orbit, evaluated."""

from __future__ import annotations

from typing import Any

from wheelset.bifurcation.cycles.vectors import dot, entry, load, plus, store, times, zeros


@entry
def defects(
    u: Any, f: Any, row: Any, level: float, time: float, h: Any, slopes: Any, at_one: Any,
    signs: Any, out: Any,
) -> None:  # fmt: skip
    """[stages N m n | mesh N n | boundary n | phase], see ``condensed``, of unknowns u, to ``out``.

    f (N, m, n) at the stages; time = kappa T; the phase condition is row . X = level, row (N, m n).
    """
    N, n, m = len(h), len(signs), len(at_one) - 1
    narrow, inner = zeros(signs, (0,)), zeros(signs, at_one[1:])
    last, phase = N * (m + 1) * n, -level
    for j in range(N):
        at = j * (m + 1) * n
        following = load(narrow, u, (at + (m + 1) * n,))
        for i in range(m + 1):
            following = plus(following, -at_one[i], load(narrow, u, (at + i * n,)))
        store(out, ((N * m + j) * n,), following)
        for i in range(m):
            total = times(-h[j] * time, load(narrow, f, (j, i, 0)))
            for node in range(m + 1):
                total = plus(total, slopes[i, node], load(narrow, u, (at + node * n,)))
            store(out, ((j * m + i) * n,), total)
        phase += dot(load(inner, row, (j, 0)), load(inner, u, (at + n,)))
    for r in range(n):
        out[last + r] = u[last + r] - signs[r] * u[r]
    out[last + n] = phase
