"""Figures of re-profiling: speeds over the mileage with what noise leaves open, and mileages."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from wheelset.plotting.style import BLUE, FAINT, INK, ORANGE, SKY, panels, styled

Array = NDArray[np.float64]

#: Speeds by their column: title and colour.
_SPEEDS = {
    "v_lin": ("linear (Hopf)", ORANGE),
    "v_non": ("nonlinear (lowest fold of cycles)", BLUE),
}

#: Per cent of the campaigns in a band; bars of a histogram.
_BAND, _BARS = (5, 95), 24


@styled
def margin_panels(
    speeds: pd.DataFrame,
    table: pd.DataFrame,
    required: Mapping[str, float],
    mileages: Mapping[str, Array],
) -> Figure:
    """Critical speeds over the mileage, and histograms of the mileage at which they are too low.

    speeds: mileage 1e4 km; v_lin, v_non m/s of the wheels themselves. table: of the campaigns,
    mileage, v_lin, v_non. required: m/s, by speed. mileages: of the campaigns, by speed.
    """
    figure, axes = panels(2, len(required), 6.0, sharex=True, height_ratios=[2, 1])
    for k, (name, limit) in enumerate(required.items()):
        title, color = _SPEEDS[name]
        _speeds(axes[k], speeds, table, name, color)
        axes[k].axhline(limit, color=INK, linestyle="--", linewidth=1.2, label="required")
        axes[k].set(title=title, ylabel="speed (m/s)")
        axes[k].legend()
        _histogram(axes[k + len(required)], mileages[name], color, speeds["mileage"].max())
    return figure


def _speeds(ax: Axes, speeds: pd.DataFrame, table: pd.DataFrame, name: str, color: str) -> None:
    low, median, high = (
        table.groupby("mileage")[name].quantile(part / 100) for part in (_BAND[0], 50, _BAND[1])
    )
    label = f"measured, {_BAND[0]} to {_BAND[1]} %"
    ax.fill_between(low.index, low, high, color=color, alpha=0.25, linewidth=0, label=label)
    ax.plot(median.index, median, color=color, linewidth=1.0)
    ax.plot(speeds["mileage"], speeds[name], "o-", color=color, mfc="white", label="the wheels")


def _histogram(ax: Axes, mileages: Array, color: str, last: float) -> None:
    ax.set(xlabel="mileage (10⁴ km)", ylabel="campaigns", xlim=(-0.02 * last, 1.02 * last))
    if len(mileages):
        ax.hist(mileages, bins=np.linspace(0, last, _BARS + 1).tolist(), color=color)
    else:
        ax.text(0.5, 0.5, "in no campaign", color=FAINT, ha="center", transform=ax.transAxes)


@styled
def averaging_panel(counts: Array, scatter: Mapping[str, Array]) -> Figure:
    """Scatter of the speeds [m/s] over how many measurements are averaged, with its law.

    counts (k,); scatter (k,) by speed. Lines: the first value over the root of the count.
    """
    figure, (ax,) = panels(1, 1, 3.2)
    for (name, values), line in zip(scatter.items(), ("o", "s"), strict=False):
        title, color = _SPEEDS[name]
        ax.plot(counts, values, line, color=color, label=title)
        ax.plot(counts, values[0] / np.sqrt(counts / counts[0]), color=SKY, linewidth=1.0)
    ax.set(xscale="log", yscale="log", xlabel="measurements averaged")
    ax.set_ylabel("scatter of a speed (m/s)")
    ax.set_xticks(list(counts), [f"{n:g}" for n in counts])
    ax.minorticks_off()
    ax.legend()
    return figure
