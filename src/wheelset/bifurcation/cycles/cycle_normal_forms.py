"""Normal-form coefficients of limit cycles at their codimension-one bifurcations.

Forcing functionals psi . g and w . g are sums over the stages with the quadrature in them.
Kuznetsov, Govaerts, Doedel, Dhooge, SIAM J. Numer. Anal. 43 (2005) 1407-1435.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.critical_modes import Mode, critical_mode
from wheelset.bifurcation.cycles.factors import Factors
from wheelset.bifurcation.cycles.twisted import Twisted

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CycleForms:
    """f and its derivatives along functions given at the stages of one cycle.

    space, orbit; phase (N, m n): weights of the phase condition; period_size: for norms.
    """

    space: Collocation
    orbit: Orbit
    phase: Array
    period_size: float

    @cached_property
    def p(self) -> Array:
        """All parameter values (m,)."""
        return self.space.parameters(self.orbit.free)

    @cached_property
    def _first(self) -> tuple[Array, Array]:
        return self.space.system.evaluate(self.orbit.stages, self.p)

    @property
    def f(self) -> Array:
        """f at the stages (N, m, n)."""
        return self._first[0]

    @property
    def A(self) -> Array:
        """Df at the stages (N, m, n, n)."""
        return self._first[1]

    @property
    def time(self) -> float:
        """kappa T."""
        return self.space.kappa * self.orbit.period

    def along(self, *directions: Array) -> Array:
        """D^k f along functions (N, m, n) of the phase, shape (N, m, n)."""
        N, m, n = self.space.shape
        flat = [np.broadcast_to(v, (N, m, n)).reshape(-1, n) for v in directions]
        X = self.orbit.stages.reshape(-1, n)
        return self.space.system.forms(X, self.p, *flat).reshape(N, m, n)

    def mode(self, flip: bool) -> Mode:
        """The mode nearest to critical."""
        return critical_mode(self.space, self.orbit, self.phase, self.period_size, flip)[0]


@dataclass(frozen=True)
class FoldCoefficients:
    """b in 1/s and the slope of the period."""

    b: float
    period_slope: float


def fold_coefficients(forms: CycleForms, mode: Mode) -> FoldCoefficients:
    """b = w . (B(v, v) + 2 A v) / (2 w . v) with the mode scaled to S = T; 1/s.

    MATCONT's normal-form coefficient of an LPC: independent of state units and of the mesh. It
    grows like 1 / (dT/ds); period_slope is dT/ds = S for a mode with int |v|^2 + S^2 = 1, SI.
    """
    space = forms.space
    quadrature = space.quadrature
    period_slope = mode.period / np.sqrt((quadrature * mode.v**2).sum() + mode.period**2)
    v = mode.v * (forms.orbit.period / mode.period)
    Av = (forms.A @ v[..., np.newaxis])[..., 0]
    b = (mode.psi * (forms.along(v, v) + 2 * Av)).sum() / (2 * (mode.psi * v).sum())
    return FoldCoefficients(float(b), float(period_slope))


@dataclass(frozen=True)
class FlipCoefficients:
    """c: of the periodic normal form xi' = c xi^3 with int <v, v> dt = 1 over the period; negative:
    the new cycles are stable within the branch. matcont: the number MATCONT prints for a period
    doubling, 2 (w . v)^2 c with |w|_1 = 1; it depends on the mesh.
    """

    c: float
    matcont: float


def flip_coefficients(forms: CycleForms, mode: Mode) -> FlipCoefficients:
    """The coefficient of a period doubling (of symmetry breaking, on half a period).

    c = 1/6 w . [C(v, v, v)/T + 3 B(v, h2) - (6 a/T) A v] / (w . v), with psi the adjoint of the
    phase shift, 2 psi . f = 1, a = psi . B(v, v) and h2' - T A h2 = B(v, v) - 2 a f, psi . h2 = 0.
    """
    quadrature, time = forms.space.quadrature, forms.time
    v = mode.v / np.sqrt((quadrature * mode.v**2).sum())
    w = mode.psi
    second = forms.along(v, v)
    psi, solve = _shifted(forms)
    psi = psi / (2 * (psi * forms.f).sum())
    a = float((psi * second).sum())
    h2 = solve(second - 2 * a * forms.f, psi)
    Av = (forms.A @ v[..., np.newaxis])[..., 0]
    cubic = forms.along(v, v, v) / time + 3 * forms.along(v, h2) - (6 * a / time) * Av
    pairing = float((w * v).sum())
    c = forms.space.kappa * float((w * cubic).sum()) / (6 * pairing)
    return FlipCoefficients(c, float(2 * (pairing / np.abs(w).sum()) ** 2 * c))


def _shifted(forms: CycleForms) -> tuple[Array, Callable[[Array, Array], Array]]:
    """The adjoint psi of the phase shift, and a solver of L h = g with (row) . h = 0.

    L h = h' - kappa T A h has the kernel f; bordered by the column f it is regular.
    """
    space = forms.space
    N, m, n = space.shape
    factors = Factors.of(space, forms.A, forms.f, forms.orbit.period)  # column 0: kappa f
    one, border = np.zeros(1, np.int64), np.zeros((1, 1))
    psi, _ = factors.transposed(one, forms.phase[np.newaxis].copy(), border, np.ones(1))

    def solve(g: Array, row: Array) -> Array:
        weights = row.reshape(1, N, m * n).copy()
        right = space.forcing(g)
        return factors.solve(one, weights, border, right, np.zeros(1))[2].reshape(N, m, n)

    return psi, solve


@dataclass(frozen=True)
class TorusCoefficient:
    """d of the periodic normal form xi' = i (theta / T) xi + d xi |xi|^2 with int <v, v> dt = 1
    over the period: the torus is stable within the branch where Re d < 0.
    """

    d: complex


def torus_coefficient(forms: CycleForms, angle: float) -> TorusCoefficient:
    """The coefficient of a Neimark-Sacker bifurcation with multipliers exp(+-i angle).

    d = 1/2 w . [C(v, v, v-)/T + 2 B(v, h11) + B(v-, h20) - (2 a/T) A v] + i a angle / T^2, where
    v' - T A v + i angle v = 0, w . v = 1, psi . f = 1 (adjoint of the phase shift),
    a = psi . B(v, v-), h11' - T A h11 = B(v, v-) - a f, psi . h11 = 0, and
    h20' - T A h20 + 2 i angle h20 = B(v, v).
    """
    space, time = forms.space, forms.time
    v, w = Twisted(space, time * forms.A, angle).kernel()
    v = v / np.sqrt((space.quadrature * np.abs(v) ** 2).sum())
    w = w / (w * v).sum()
    squared = forms.along(v, v.conj()).real
    psi, solve = _shifted(forms)
    psi = psi / (psi * forms.f).sum()
    a = float((psi * squared).sum())
    h11 = solve(squared - a * forms.f, psi)
    h20 = Twisted(space, time * forms.A, 2 * angle).solve(forms.along(v, v))
    Av = (forms.A @ v[..., np.newaxis])[..., 0]
    cubic = (
        forms.along(v, v, v.conj()) / time
        + 2 * forms.along(v, h11)
        + forms.along(v.conj(), h20)
        - (2 * a / time) * Av
    )
    d = (w * cubic).sum() / 2 + 1j * a * angle / time**2
    return TorusCoefficient(complex(space.kappa * d))
