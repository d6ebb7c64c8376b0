"""Figures of a report on profiles: contact functions over y, and cycles over the speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.bifurcation.curves.branch import Branch
from wheelset.plotting.branches import Quantity, add_legend, draw_branch
from wheelset.plotting.profiles import draw_conicities
from wheelset.plotting.style import BLUE, FAINT, GREEN, INK, ORANGE, SIDES, panels, styled

#: Titles, columns and scales of the functions of y.
_FUNCTIONS = (
    ("r", "rolling radius $r$ (mm)", 1e3),
    ("delta", r"contact angle $\delta$ (mrad)", 1e3),
    ("rho", r"sum of curvatures $\rho$ (1/m)", 1.0),
)

#: Colours of the widths of an average; the one asked for is drawn in the last place.
_WIDTHS = (GREEN, ORANGE)

SPEED = Quantity("v", "speed (km/h)", 3.6)
AMPLITUDE = Quantity("amplitude y", "amplitude of $y$ (mm)", 1e3)


@styled
def function_panels(contact: pd.DataFrame, jumps: Sequence[float]) -> Figure:
    """Rolling radius, contact angle and sum of curvatures of both wheels over y.

    contact: indexed by y m; by side r m, delta rad, rho 1/m. jumps: y m, marked by thin lines.
    """
    figure, axes = panels(3, 1, 7.4, sharex=True)
    y = contact.index.to_numpy(float) * 1e3
    for ax, (name, label, scale) in zip(axes, _FUNCTIONS, strict=True):
        for side, (color, line) in SIDES.items():
            ax.plot(y, contact[f"{name}_{side}"] * scale, line, color=color, label=side)
        for jump in jumps:
            ax.axvline(jump * 1e3, color=FAINT, linewidth=0.9, linestyle=":")
        ax.set_ylabel(label)
    axes[0].legend(ncols=2)
    axes[-1].set_xlabel("lateral displacement $y$, to the left (mm)")
    return figure


@styled
def conicity_panel(conicity: pd.DataFrame) -> Figure:
    """Equivalent conicity over the amplitude: indexed by amplitude m; integration, regression."""
    figure, (ax,) = panels(1, 1, 3.2)
    draw_conicities(ax, conicity)
    ax.set(xlabel="amplitude (mm)", ylabel=r"$\tan\gamma_e$ (-)")
    return figure


@styled
def speed_diagram(
    branches: Mapping[float, Branch], chosen: float, hopf: float | None, window: tuple[float, float]
) -> Figure:
    """Cycles over the speed, in km/h below and m/s above, with straight running.

    branches: by width [m] of the average, ``chosen`` drawn thick and with its special points.
    hopf: speed [m/s] at which straight running loses its stability; window: m/s, for its line.
    """
    figure, (ax,) = panels(1, 1, 4.6)
    others = [width for width in branches if width != chosen]
    for width, color in zip(others, _WIDTHS, strict=False):
        table = branches[width].table(["amplitude y"])
        label = f"averaged over {width * 1e3:g} mm"
        ax.plot(table["v"] * 3.6, table["amplitude y"] * 1e3, color=color, lw=0.9, label=label)
    parts = set()
    if chosen in branches:
        label = f"averaged over {chosen * 1e3:g} mm"
        parts = draw_branch(ax, branches[chosen], SPEED, AMPLITUDE, BLUE, label)
    _straight(ax, hopf, window)
    ax.set(xlabel=SPEED.label, ylabel=AMPLITUDE.label)
    ax.set_ylim(bottom=-0.2)
    add_legend(ax, parts)
    other = ax.secondary_xaxis("top", functions=(_slower, _faster))
    other.set_xlabel("speed (m/s)")
    return figure


def _straight(ax: Axes, hopf: float | None, window: tuple[float, float]) -> None:
    """Straight running: solid while it is stable; within what the cycles show, where there are."""
    low, high = ax.get_xlim() if ax.lines else (window[0] * 3.6, window[1] * 3.6)
    if hopf is None:
        ax.plot([low, high], [0, 0], ":", color=INK, label="straight running")
        return
    ax.plot([low, hopf * 3.6], [0, 0], "-", color=INK, label="straight running")
    ax.plot([hopf * 3.6, high], [0, 0], "--", color=INK)
    ax.plot(hopf * 3.6, 0, "o", mfc="white", mec=INK, ms=7, mew=1.4, zorder=3, clip_on=False)
    ax.annotate("H", (hopf * 3.6, 0), xytext=(6, 6), textcoords="offset points")
    ax.set_xlim(low, high)


def _slower(v: Any) -> Any:
    """km/h to m/s."""
    return v / SPEED.factor


def _faster(v: Any) -> Any:
    """m/s to km/h."""
    return v * SPEED.factor
