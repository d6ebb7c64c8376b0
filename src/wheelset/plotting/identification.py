"""The search for the hidden values: ranking of structures, residuals, profiles, section 3."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from wheelset.plotting.style import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, PURPLE, panels, styled

#: Marks of the readings in the figure of residuals.
_MARKS = (("x", ORANGE), ("+", PURPLE), ("o", BLUE), ("s", GREEN))

_LABELS = {
    "p0": ("wheel load $p_0$ (kN)", 1e-3),
    "e0": ("$e_0 + f_0$ (1/m)", 1.0),
    "radius_offset": (r"radius offset $\epsilon_r$ ($10^{-3}$)", 1e3),
}


@styled
def ranking_bars(ranking: pd.DataFrame) -> Figure:
    """Costs of the structures, the lowest on top, reversed and physical signs by colour, fits with
    corrections hatched.

    ranking: words, signs, cost, corrected.
    """
    figure, (ax,) = panels(1, 1, 1.4 + 0.26 * len(ranking))
    heights = np.arange(len(ranking))
    for height, row in zip(heights, ranking.itertuples(), strict=True):
        hatch = "///" if row.corrected else None
        color = _SIGNS[str(row.signs)]
        ax.barh(height, float(str(row.cost)), color=color, hatch=hatch, edgecolor="white")
    ax.set_yticks(heights, ranking["words"].tolist())
    ax.invert_yaxis()
    _cost_axis(ax)
    handles = [Patch(color=color, label=f"{sign} signs") for sign, color in _SIGNS.items()]
    figure.legend(handles=handles, loc="outside upper right", ncols=2)
    return figure


_SIGNS = {"reversed": BLUE, "physical": ORANGE}


def _cost_axis(ax: Axes) -> None:
    ax.set_xscale("log")
    ax.set_xlim(left=10)
    ax.set_xticks([10, 20, 50, 100, 200, 500], ["10", "20", "50", "100", "200", "500"])
    ax.minorticks_off()
    ax.set_xlabel("cost of the fit (-)")
    ax.grid(visible=False, axis="y")


@styled
def residual_marks(residuals: pd.DataFrame) -> Figure:
    """Departures from print in units of the last digit, one row an observation, a mark a reading.

    residuals: reading, item, quantity, off. Inside the shaded band a number rounds to the print.
    """
    figure, axes = panels(1, 2, 1.7 + 0.3 * residuals["item"].nunique(), sharey=True)
    items = list(dict.fromkeys(residuals["item"]))
    for ax, (quantity, label) in zip(axes, _QUANTITIES.items(), strict=True):
        _residual_panel(ax, residuals[residuals["quantity"] == quantity], items)
        ax.set_xlabel(f"{label}\n(units of 0.01)")
    axes[0].set_yticks(range(len(items)), [item.split(": ")[-1] for item in items])
    axes[0].invert_yaxis()
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=2)
    return figure


_QUANTITIES = {"hopf_speed": "Hopf speed, ours − paper", "flc": "FLC, ours − paper"}


def _residual_panel(ax: Axes, table: pd.DataFrame, items: list[str]) -> None:
    ax.axvspan(-0.5, 0.5, color=FAINT, alpha=0.35, linewidth=0)
    ax.axvline(0, color=PAPER, linewidth=1.0)
    for (name, rows), (mark, color) in zip(
        table.groupby("reading", sort=False), _MARKS, strict=False
    ):
        at = rows["item"].map(items.index)
        ax.plot(rows["off"], at, mark, color=color, ms=7, mew=1.8, mfc="none", label=str(name))
    ax.set_xscale("symlog", linthresh=1.0, linscale=0.6)
    reach = max(2.0, 1.6 * float(table["off"].abs().max()))
    ax.set_xlim(-reach, reach)
    powers = [10.0**k for k in range(int(np.log10(reach)) + 1)]
    thinned = powers if len(powers) < 4 else powers[:: len(powers) // 2]
    ticks = [*(-value for value in reversed(thinned)), 0.0, *thinned]
    ax.set_xticks(ticks, [f"{value:g}".replace("-", "−") for value in ticks])
    ax.minorticks_off()


#: Height of the profiles' panels.
_HIGH = 8.0


@styled
def profile_panels(profiles: pd.DataFrame) -> Figure:
    """How the cost rises when one value is held: name, value (SI), excess."""
    names = list(dict.fromkeys(profiles["name"]))
    figure, axes = panels(1, len(names), 2.9, sharey=True)
    for ax, name in zip(axes, names, strict=True):
        label, scale = _LABELS[name]
        curve = profiles[profiles["name"] == name]
        ax.plot(curve["value"] * scale, curve["excess"], "o-", color=BLUE, ms=4)
        near = curve.loc[curve["excess"] <= 1.5 * _HIGH, "value"] * scale
        ax.set_xlim(near.min(), near.max())
        ax.axhline(2.0, color=FAINT, linewidth=1.2, linestyle=":")
        ax.set_xlabel(label)
    axes[0].set_ylim(-0.3, _HIGH)
    axes[0].set_ylabel("cost above the lowest (-)")
    return figure


@styled
def load_curves(jumps: pd.DataFrame, readings: pd.DataFrame, printed: float) -> Figure:
    """The quintic law's jump of the FLC over the wheel load, by how often the flange is counted.

    jumps: wheels, p0 N, jump 1/s. readings: the loads that give the printed one.
    """
    figure, (ax,) = panels(1, 1, 3.4)
    for (wheels, curve), color in zip(jumps.groupby("wheels"), (BLUE, ORANGE), strict=True):
        words = {1: "once", 2: "on both wheels"}[int(str(wheels))]
        ax.plot(curve["p0"] / 1e3, curve["jump"], color=color, label=f"flange counted {words}")
    ax.axhline(printed, color=PAPER, linewidth=1.0, linestyle="--", label="paper")
    ax.plot(readings["p0"] / 1e3, readings["jump"], "o", mfc="none", color=INK, ms=9)
    ax.set(xlabel="wheel load $p_0$ (kN)", ylabel="jump of the FLC (1/s)")
    ax.set_ylim(0, None)
    ax.legend(loc="lower right")
    return figure
