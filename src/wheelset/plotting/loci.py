"""Eigenvalues of straight running along the speed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.bifurcation.equilibria.equilibrium import EigenvalueLoci
from wheelset.plotting.style import FAINT, OTHER, OURS, PAPER, panels, styled


@styled
def eigenvalue_panels(curves: EigenvalueLoci, hopf: pd.DataFrame, paper_speed: float) -> Figure:
    """Real parts over the speed, and the root locus of the oscillating pair.

    curves: loci in 1/s over m/s. hopf: computed points, v m/s and frequency rad/s. paper_speed:
    printed one, m/s. The left ordinate keeps to the least damped pair.
    """
    figure, (left, right) = panels(1, 2, 3.6)
    _real_parts(left, curves)
    _root_locus(right, figure, curves)
    left.plot(paper_speed, 0, "o", mfc="none", color=PAPER, ms=9, label="paper")
    left.plot(hopf["v"], 0 * hopf["v"], "x", color=OTHER, ms=8, mew=2, label="computed")
    for side in (-1, 1):
        right.plot(0 * hopf["v"], side * hopf["frequency"], "x", color=OTHER, ms=8, mew=2)
    left.legend(loc="upper left")
    return figure


def _real_parts(ax: Axes, curves: EigenvalueLoci) -> None:
    ax.axhline(0, color=FAINT, linewidth=1.0)
    for locus in curves.eigenvalues.T:
        ax.plot(curves.values, locus.real, color=OURS, linewidth=1.5)
    ax.set(xlabel="speed $v$ (m/s)", ylabel=r"Re $\lambda$ (1/s)")
    ax.set_xlim(curves.values[0], curves.values[-1])
    largest = curves.eigenvalues.real.max(axis=1)
    ax.set_ylim(4 * float(largest.min()), 2.5 * float(largest.max()) + 1)
    above = ax.secondary_xaxis("top", functions=(_to_kmh, _from_kmh))
    above.set_xlabel("speed (km/h)")


def _root_locus(ax: Axes, figure: Figure, curves: EigenvalueLoci) -> None:
    speeds = np.repeat(curves.values, curves.eigenvalues.shape[1])
    points = curves.eigenvalues.ravel()
    oscillating = np.abs(points.imag) > 1e-6
    drawn = ax.scatter(
        points.real[oscillating], points.imag[oscillating], c=speeds[oscillating], s=4,
        cmap="cividis",
    )  # fmt: skip
    ax.axvline(0, color=FAINT, linewidth=1.0)
    ax.set(xlabel=r"Re $\lambda$ (1/s)", ylabel=r"Im $\lambda$ (rad/s)")
    figure.colorbar(drawn, ax=ax, label="speed (m/s)")


def _to_kmh(speed: Any) -> Any:
    return np.asarray(speed) * 3.6


def _from_kmh(speed: Any) -> Any:
    return np.asarray(speed) / 3.6
