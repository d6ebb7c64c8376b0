"""Figures for a designer: what moves the critical speeds, and what lies between them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import BLUE, FAINT, GREEN, INK, ORANGE, PURPLE, panels, styled

#: Colours of the two critical speeds.
COLORS = {"lin": ORANGE, "non": BLUE}
NAMES = {"lin": r"$v_\mathrm{lin}$ (Hopf)", "non": r"$v_\mathrm{non}$ (LPC)"}

#: Colours and marks of the parameters that are varied.
SERIES = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (PURPLE, "D"))


@styled
def tornado_panels(tables: Mapping[str, pd.DataFrame]) -> Figure:
    """Changes of both speeds with each parameter ten per cent lower (open) and higher (filled).

    tables: of ``design_sensitivity.tornado``, by reading; ticks: the change by the derivative.
    """
    count = max(table["parameter"].nunique() for table in tables.values())
    figure, axes = panels(1, len(tables), 1.5 + 0.42 * count)
    for ax, (title, table) in zip(axes, tables.items(), strict=True):
        _tornado(ax, table)
        ax.set_title(title)
    handles = axes[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside upper center", ncols=4)
    return figure


def _tornado(ax: Axes, table: pd.DataFrame) -> None:
    names = list(dict.fromkeys(table["parameter"]))
    place = table["parameter"].map(names.index) + table["speed"].map({"lin": -0.2, "non": 0.2})
    for speed, color in COLORS.items():
        rows = table["speed"] == speed
        y, lower, higher = place[rows], table["lower"][rows], table["higher"][rows]
        ax.barh(y, lower, height=0.34, facecolor="none", edgecolor=color, linewidth=1.2)
        ax.barh(y, higher, height=0.34, color=color, label=f"{NAMES[speed]}, +10 %")
        ax.plot(table["tangent"][rows], y, "|", color=INK, ms=9, mew=1.6)
    ax.barh([0], [0], facecolor="none", edgecolor=INK, label="−10 %")
    ax.plot([], [], "|", color=INK, ms=9, mew=1.6, label="derivative")
    ax.axvline(0, color=FAINT, linewidth=1.0)
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.grid(axis="y", visible=False)
    ax.set_xlabel("change of the speed (m/s)")


@styled
def gap_panels(tables: Mapping[str, pd.DataFrame]) -> Figure:
    """The gap between the critical speeds over FLC, beside what FLC alone would make it.

    tables: of ``design_gap.gaps``, by reading. Lines: the estimate; marks: the gap.
    """
    figure, axes = panels(1, len(tables), 3.6, sharey=True)
    for ax, (title, table) in zip(axes, tables.items(), strict=True):
        for (name, rows), (color, mark) in zip(
            table.groupby("parameter", sort=False), SERIES, strict=False
        ):
            ordered = rows.sort_values("flc")
            ax.plot(ordered["flc"], ordered["estimate"], color=color, linewidth=1.0)
            ax.plot(rows["flc"], rows["gap"], mark, color=color, ms=4, label=f"{name} varied")
        ax.set(xscale="log", yscale="log", xlim=(0.1, 400), ylim=(1e-3, 100))
        ax.set(xlabel="FLC (1/s)", title=title)
    axes[0].set_ylabel(r"$v_\mathrm{lin} - v_\mathrm{non}$ (m/s)")
    axes[0].legend()
    return figure


@styled
def threshold_panels(
    families: Mapping[str, pd.DataFrame], tables: Mapping[str, pd.DataFrame]
) -> Figure:
    """Cycles between the critical speeds and the disturbances that trigger hunting.

    families: of ``design_threshold.family``, tables: of ``thresholds``, by reading.
    """
    figure, axes = panels(1, len(families), 3.8, sharey=True)
    for ax, (title, family) in zip(axes, families.items(), strict=True):
        _cycles(ax, family)
        table = tables[title]
        ax.plot(table["v"], 1e3 * table["y0"], "o", color=INK, mfc="white", label="let go at rest")
        low, high = family["v"].min(), float(family["v"].iloc[0])
        margin = 0.25 * (high - low)
        ax.set(xlim=(low - margin, high + margin), ylim=(0, 12), title=title)
        ax.set_xlabel("speed $v$ (m/s)")
    axes[0].set_ylabel("greatest $y$ (mm)")
    axes[0].legend(loc="lower left")
    return figure


def _cycles(ax: Axes, family: pd.DataFrame) -> None:
    stable = family["unstable"].to_numpy() == 0
    y = 1e3 * family["y"].to_numpy()
    for part, line, label in ((stable, "-", "stable cycle"), (~stable, "--", "unstable cycle")):
        shown = part | np.append(part[1:], False) if line == "--" else part
        ax.plot(family["v"], np.where(shown, y, np.nan), line, color=BLUE, label=label)
