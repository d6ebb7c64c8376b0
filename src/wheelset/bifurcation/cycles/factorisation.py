"""All that Newton's method needs of an orbit's equations, in one call: values and factors."""

from __future__ import annotations

from typing import Any

from wheelset.bifurcation.cycles.defects import defects
from wheelset.bifurcation.cycles.elimination import eliminate
from wheelset.bifurcation.cycles.reduction import reduce
from wheelset.bifurcation.cycles.vectors import entry


@entry
def factorise(
    u: Any, f: Any, J: Any, extra: Any, row: Any, level: float, kappa: float, period: float, h: Any,
    slopes: Any, at_one: Any, signs: Any, residual: Any, factors: Any,
) -> tuple[float, int]:  # fmt: skip
    """Fill residual (see ``defects``; none where it has no length) and factors: responses, links,
    forced (see ``elimination``, ``reduction``).

    f (N, m, n), J (N, m, n, n + k), extra (N, m, n, e): as in ``eliminate``. Returns the sign of
    the determinant of what is eliminated, 0 where it is singular; and the interval where, or -1.
    """
    responses, links, forced = factors
    if residual.shape[0] > 0:
        time = kappa * period
        defects(u, f, row, level, time, h, slopes, at_one, signs, residual)
    stages, singular = eliminate(J, f, extra, kappa, period, h, slopes, at_one, signs, responses)
    if singular >= 0:
        return 0.0, singular
    return stages * reduce(responses, at_one, signs, links, forced), -1
