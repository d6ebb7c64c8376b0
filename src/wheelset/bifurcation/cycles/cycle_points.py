"""What a zero of a test function along a branch of cycles is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from wheelset.bifurcation.curves.zero_problem import Finding, Point
from wheelset.bifurcation.cycles.cycle_normal_forms import (
    CycleForms,
    flip_coefficients,
    fold_coefficients,
    torus_coefficient,
)

if TYPE_CHECKING:
    from wheelset.bifurcation.cycles.cycle_curve import CycleCurve


def finding(curve: CycleCurve, test: str, point: Point) -> Finding:
    """Name a located zero of the test "fold", "branch", "flip", "torus" or "birth"."""
    return _FINDINGS[test](curve, point)


def forms_at(curve: CycleCurve, point: Point) -> CycleForms:
    """Derivatives along functions on the cycle of a point."""
    orbit = curve.space.split(point.u)
    return CycleForms(curve.space, orbit, curve.anchor.row, float(curve.sizes[0]))


#: Size of a cycle, in the norm of the state's scales, below which it is an equilibrium: the branch
#: turns there because it comes back with its phase shifted.
TIP = 1e-3


def _fold(curve: CycleCurve, point: Point) -> Finding:
    if curve.size(point.u) < TIP:
        return Finding("", "the tip of the branch at its Hopf point", artefact=True)
    forms = forms_at(curve, point)
    found = fold_coefficients(forms, forms.mode(flip=False))
    words = f"fold of cycles: the branch turns in {curve.parameters[0]}"
    return Finding("LPC", words, {"b": found.b, "dT/ds": found.period_slope})


def _branch(curve: CycleCurve, point: Point) -> Finding:
    return Finding("BPC", "branch point: a second family of cycles crosses")


def _flip(curve: CycleCurve, point: Point) -> Finding:
    forms = forms_at(curve, point)
    found = flip_coefficients(forms, forms.mode(flip=True))
    side = "supercritical" if found.c < 0 else "subcritical"
    if curve.space.half:
        words = f"symmetry breaking, {side}: a pair of asymmetric cycles branches off"
        return Finding("BPC", words, {"c": found.c})
    words = f"period doubling, {side}"
    return Finding("PD", words, {"c": found.c, "c MATCONT": found.matcont})


def _torus(curve: CycleCurve, point: Point) -> Finding:
    values = np.array(point.linearisation.floquet.nontrivial)
    i = _reciprocal(values)
    if abs(values[i].imag) < 1e-6:
        words = "two real multipliers with product one: a neutral saddle, not a bifurcation"
        return Finding("", words, {"multiplier": float(values[i].real)}, artefact=True)
    angle = float(abs(np.angle(values[i])))
    d = torus_coefficient(forms_at(curve, point), angle).d
    side = "supercritical" if d.real < 0 else "subcritical"
    coefficients = {"Re d": d.real, "Im d": d.imag, "angle": angle}
    return Finding("NS", f"Neimark-Sacker, {side}: a torus is born", coefficients)


def _birth(curve: CycleCurve, point: Point) -> Finding:
    return Finding("H", "the cycle shrinks to an equilibrium")


def _reciprocal(values: np.ndarray) -> int:
    """One of the two multipliers whose product is nearest to one."""
    products = np.abs(np.outer(values, values) - 1) + 1e9 * np.tri(len(values))
    return int(np.argmin(products)) // len(values)


_FINDINGS = {"fold": _fold, "branch": _branch, "flip": _flip, "torus": _torus, "birth": _birth}
