"""Tangential contact, strip by strip: Kalker's simplified theory (FASTSIM).

Kalker, Vehicle System Dynamics 11 (1982) 1-13. A particle enters a strip at x = a without traction
and travels to x = -a. Traction on the wheel per distance travelled and slip:

    d tau/ds = (s - w)/L,     |tau| <= mu q(x) ,     s = 0 where |tau| is below the bound

w: rigid slip, s: true slip, L: flexibility, q: a parabola that carries the load of the strip (an
elliptic bound has no slope at its ends, where the slip would be infinite). One L a patch, of the
three of the equivalent ellipse (half length of the longest strip, the same area) weighted by the
creepages, ``L = sum L_k |c_k| / |c|`` with ``c = (xi_x, xi_y, phi sqrt(a b))``: so the energy lost
in the strips is that of forces and creepages. Axes: x forward, y outward; tractions act on the
wheel and oppose the slip of the wheel over the rail.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from wheelset.wear.patch import NU, Array, E, Patches

#: Shear modulus of steel, Pa.
G = E / (2 * (1 + NU))

#: Cells of a strip along the rolling direction.
CELLS = 32

#: Axis ratios a/b between which Kalker's coefficients are tabulated.
RATIOS = (0.1, 10.0)


@dataclass(frozen=True, eq=False)
class Slip:
    """Rigid slip of the strips of some patches, as shares of the speed.

    xi_x: of every strip, what the spin does across the patch included; xi_y: lateral. phi:
    spin of every strip, 1/m, which adds ``phi x`` to the lateral slip. mu: friction.
    """

    xi_x: Array
    xi_y: Array
    phi: Array
    mu: float


@dataclass(frozen=True, eq=False)
class Sliding:
    """Cells of all strips, (cells, strips), from the leading to the trailing end.

    dx: length of a cell, (strips,) m. pressure: of the elliptic distribution, Pa. tau_x, tau_y:
    means of a cell's ends, Pa; with them the energy lost is that of forces and creepages in every
    cell. slip: |s|, share of the speed. Fx, Fy: of every patch, N.
    """

    dx: Array
    pressure: Array
    tau_x: Array
    tau_y: Array
    slip: Array
    Fx: Array
    Fy: Array

    @property
    def traction(self) -> Array:
        """|tau|, Pa."""
        return np.hypot(self.tau_x, self.tau_y)


def kalker(ratio: ArrayLike) -> tuple[Array, Array, Array]:
    """C11, C22 and C23 for axis ratios a/b: fits of Kalker's table at nu = 0.28 (Guo, Eq. 11).

    Ratios beyond the table are set to its ends.
    """
    g = np.clip(np.asarray(ratio, float), *RATIOS)
    return (
        3.2893 + 0.9750 * g - 0.0120 * g**2,
        2.4014 + 1.3179 * g - 0.0200 * g**2,
        0.4147 + 1.0184 * g + 0.0565 * g**2 - 0.0013 * g**3,
    )


def flexibilities(a: Array, b: Array) -> tuple[Array, Array, Array]:
    """L1, L2, L3 [m/Pa] of ellipses: 8a/(3 C11 G), 8a/(3 C22 G), pi a sqrt(a/b)/(4 C23 G)."""
    C11, C22, C23 = kalker(a / b)
    return 8 * a / (3 * C11 * G), 8 * a / (3 * C22 * G), np.pi * a * np.sqrt(a / b) / (4 * C23 * G)


def slide(patches: Patches, slip: Slip, cells: int = CELLS) -> Sliding:
    """Tractions and slip of all strips."""
    L = _flexibility(patches, slip)[patches.row]
    a, dx = patches.a, 2 * patches.a / cells
    # the parabola with the load of the strip: 4/3 q a = pi/2 c a^2
    peak = slip.mu * 3 * np.pi / 8 * patches.scale * a
    tau_x, tau_y, slips = (np.empty((cells, len(a))) for _ in range(3))
    x_before = y_before = np.zeros_like(a)
    for k in range(cells):
        middle, end = (a - (k + share) * dx for share in (0.5, 1.0))
        w_y = slip.xi_y + slip.phi * middle
        x, y = x_before - slip.xi_x * dx / L, y_before - w_y * dx / L
        cut = _cut(x, y, peak * np.maximum(1 - (end / a) ** 2, 0.0))
        slips[k] = np.hypot(x, y) * (1 - cut) * L / dx
        tau_x[k], tau_y[k] = 0.5 * (x_before + x * cut), 0.5 * (y_before + y * cut)
        x_before, y_before = x * cut, y * cut
    area = patches.width * dx
    Fx, Fy = (patches.sums(tau.sum(axis=0) * area) for tau in (tau_x, tau_y))
    return Sliding(dx, _pressure(patches, cells), tau_x, tau_y, slips, Fx, Fy)


def _cut(x: Array, y: Array, bound: Array) -> Array:
    """By what a traction is multiplied to stay within its bound."""
    size = np.hypot(x, y)
    return np.where(size > bound, bound / np.where(size > 0, size, 1.0), 1.0)


def _pressure(patches: Patches, cells: int) -> Array:
    middle = 1 - (2 * np.arange(cells) + 1) / cells
    return np.sqrt(1 - middle[:, None] ** 2) * patches.scale * patches.a


def _flexibility(patches: Patches, slip: Slip) -> Array:
    """One flexibility a patch, weighted by the mean creepages of its strips."""
    a = np.maximum(patches.length, 1e-12)
    b = np.maximum(patches.area, 1e-18) / (np.pi * a)
    share = patches.a**2 * patches.width
    share = share / np.maximum(patches.sums(share), 1e-300)[patches.row]
    means = [abs(patches.sums(c * share)) for c in (slip.xi_x, slip.xi_y, slip.phi)]
    means[2] = means[2] * np.sqrt(a * b)
    size = np.sqrt(sum(c**2 for c in means))
    L = flexibilities(a, b)
    weighted = sum(Lk * c for Lk, c in zip(L, means, strict=True))
    return np.where(size > 0, weighted / np.where(size > 0, size, 1.0), L[0])
