"""Test functions along folds and flips of cycles, and what their zeros are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import Finding, Point

if TYPE_CHECKING:
    from wheelset.bifurcation.cycles.critical_curve import CriticalCurve

Array = NDArray[np.float64]


def tests(curve: CriticalCurve, point: Point) -> Mapping[str, float]:
    """cusp (folds): dg along the mode itself, the numerator of b. pairing: psi . v, zero where the
    critical multiplier gains a partner (1:1 on folds, 1:2 on flips). other: the other flip (folds)
    or fold (flips). torus: a further pair with the product one.
    """
    linearisation = point.linearisation
    mode = linearisation.mode
    watched = linearisation.floquet.watched_beside(-1.0 if curve.flip else 1.0)
    size = np.sqrt((curve.space.weights * mode.v**2).sum()) * np.abs(mode.psi).max()
    pairing = float((mode.psi * mode.v).sum() / size)
    if curve.flip:
        return {"pairing": pairing, "fold": watched.fold, "torus": watched.torus}
    along = np.vdot(linearisation.rows[1], mode.v) + linearisation.scalars[1, 0] * mode.period
    return {
        "cusp": float(along / size),
        "pairing": pairing,
        "flip": watched.flip,
        "torus": watched.torus,
    }


_WORDS = {
    (False, "cusp"): ("CPC", "cusp of cycles: two folds meet"),
    (False, "pairing"): ("R1", "1:1 resonance: a second multiplier joins +1"),
    (False, "flip"): ("LPPD", "fold-flip: a multiplier passes -1 at a fold"),
    (False, "torus"): ("LPNS", "fold and Neimark-Sacker together"),
    (True, "pairing"): ("R2", "1:2 resonance: a second multiplier joins -1"),
    (True, "fold"): ("LPPD", "fold-flip: a multiplier passes +1 at a period doubling"),
    (True, "torus"): ("PDNS", "period doubling and Neimark-Sacker together"),
}


#: Size of a cycle, in the norm of the state's scales, below which its curve of folds is as good as
#: at a generalised Hopf point: b's numerator vanishes there with the cube of the size.
SMALL = 0.1


def finding(curve: CriticalCurve, test: str, point: Point) -> Finding:
    """Name a located zero."""
    kind, words = _WORDS[curve.flip, test]
    if test == "cusp" and curve.cycles.size(point.u) < SMALL:
        return Finding("", "beside a generalised Hopf point, where b is rounding", {}, True)
    if test == "torus" and not _complex_pair(point):
        return Finding("", "two real multipliers with product one: not a bifurcation", {}, True)
    if curve.space.half and "LPPD" in kind:
        kind, words = "LPBPC", "a fold and the loss of symmetry together"
    return Finding(kind, words)


def _complex_pair(point: Point) -> bool:
    values = np.array(point.linearisation.floquet.nontrivial)
    near = np.abs(np.abs(values) - 1) < 1e-4
    return bool((near & (np.abs(values.imag) > 1e-6)).any())
