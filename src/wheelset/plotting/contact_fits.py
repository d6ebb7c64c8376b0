"""Fits of the contact geometry, and what they do to the cycles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    SKY,
    panels,
    styled,
)

#: Colours of the fits, in order.
COLORS = (ORANGE, GREEN, PURPLE, BLUE, SKY)

#: Columns of the functions: title, unit, times.
_FUNCTIONS = {
    "dr": (r"$r - r_0$", "mm", 1e3),
    "delta": (r"$\delta$", "mrad", 1e3),
    "rho": (r"$\rho_w + \rho_r$", "1/m", 1.0),
}


@styled
def fit_panels(functions: Mapping[str, pd.DataFrame], shown: Sequence[str]) -> Figure:
    """dr, contact angle and curvature sum of the left wheel: searched, and by the fits shown.

    functions: by "contacts" and by fit: y m, dr m, delta rad, rho 1/m.
    """
    figure, axes = panels(3, 1, 8.4, sharex=True)
    for ax, (name, (title, unit, times)) in zip(axes, _FUNCTIONS.items(), strict=True):
        points = functions["contacts"]
        ax.plot(points["y"] * 1e3, points[name] * times, color=FAINT, lw=4.5, label="searched")
        for fit, color in zip(shown, COLORS, strict=False):
            line = functions[fit]
            ax.plot(line["y"] * 1e3, line[name] * times, color=color, lw=1.4, label=fit)
        ax.set_ylabel(f"{title} ({unit})")
    axes[-1].set_xlabel("lateral displacement $y$ (mm)")
    handles = axes[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside upper center", ncols=3)
    return figure


@styled
def branch_panel(
    branches: Mapping[str, pd.DataFrame], shown: Sequence[str], top: float = 6.0
) -> Figure:
    """Amplitude of the cycles over the speed by fit; solid: stable, dashed: unstable.

    branches: by fit: v m/s, amplitude m, unstable. top: largest amplitude shown, mm.
    """
    figure, (ax,) = panels(1, 1, 4.6)
    for fit, color in zip(shown, COLORS, strict=False):
        draw_branch(ax, branches[fit], color, fit)
    ax.set(xlabel="speed (m/s)", ylabel="amplitude of $y$ (mm)", ylim=(0, top))
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def draw_branch(ax: Axes, branch: pd.DataFrame, color: str, label: str) -> None:
    """A branch of cycles, its stable pieces solid and its unstable ones dashed, folds as dots."""
    v, amplitude = branch["v"].to_numpy(float), branch["amplitude"].to_numpy(float) * 1e3
    stable = branch["unstable"].to_numpy(int) == 0
    ax.plot(v, amplitude, "--", color=color, lw=1.0)
    solid = pd.Series(amplitude).where(pd.Series(stable))
    ax.plot(v, solid, "-", color=color, label=label)
    folds = branch[branch["point"] == "LPC"]
    ax.plot(folds["v"], folds["amplitude"] * 1e3, "o", color=color, ms=4.5)


@styled
def noise_panel(trips: pd.DataFrame) -> Figure:
    """Critical speeds on profiles measured again: columns spacing m, noise m, v_lin, v_non m/s.

    The first row is the profile as it is.
    """
    figure, axes = panels(1, 2, 3.6)
    titles = {"v_lin": "linear (Hopf)", "v_non": "slowest small cycle"}
    for ax, (speed, title) in zip(axes, titles.items(), strict=True):
        ax.axhline(float(trips[speed].iloc[0]), color=INK, lw=1.2, label="as it is")
        for color, mark, noisy in ((BLUE, "o", False), (ORANGE, "x", True)):
            rows = trips.iloc[1:]
            rows = rows[(rows["noise"] > 0) == noisy]
            label = "with noise" if noisy else "without noise"
            ax.plot(rows["spacing"] * 1e3, rows[speed], mark, color=color, label=label)
        ax.set(title=title, xlabel="spacing of the points (mm)", ylabel="speed (m/s)")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure
