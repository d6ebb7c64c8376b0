"""Simulated wear: depths over the wheel, and what variants of the simulation lead to."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib as mpl
import pandas as pd
from matplotlib.figure import Figure

from wheelset.plotting.style import BLUE, FAINT, INK, ORANGE, panels, styled

#: The band of the published wear, mm from the nominal circle.
_BAND = (15.0, 25.0)


@styled
def depth_panels(depths: Mapping[str, pd.DataFrame]) -> Figure:
    """Depth of wear over the wheel by law, a line a mileage, darker with it.

    depths: by law: m over y m (index), columns the mileages, 1e4 km. Shaded: the published band.
    """
    figure, axes = panels(1, len(depths), 3.8, sharey=True)
    for ax, (law, table) in zip(axes, depths.items(), strict=True):
        colors = mpl.colormaps["viridis_r"]
        for k, mileage in enumerate(table.columns):
            shade = colors(0.15 + 0.85 * k / max(len(table.columns) - 1, 1))
            ax.plot(table.index * 1e3, table[mileage] * 1e3, color=shade, label=f"{mileage:g}")
        for side in (-1, 1):
            ends = sorted(side * end for end in _BAND)
            ax.axvspan(*ends, color=FAINT, alpha=0.15, lw=0)
        ax.set(title=law, xlabel="$y$ on the wheel (mm)")
    axes[0].set_ylabel("depth (mm)")
    axes[0].invert_yaxis()
    handles = axes[0].get_legend_handles_labels()
    figure.legend(*handles, loc="outside upper center", ncols=7, title="mileage (10⁴ km)")
    return figure


@styled
def variant_panels(conicities: pd.DataFrame, chosen: str) -> Figure:
    """Equivalent conicity over the amplitude, a line a variant.

    conicities: over amplitude m (index), a column a variant; chosen: the one drawn strongly.
    """
    figure, (ax,) = panels(1, 1, 4.4)
    others = [name for name in conicities.columns if name != chosen]
    marks = ("o", "s", "^", "v", "D", "P", "X", "<", ">", "*")
    for name, mark in zip(others, marks, strict=False):
        line = conicities[name]
        ax.plot(
            line.index * 1e3, line, "-", color=FAINT, marker=mark, ms=5, lw=0.9,
            markerfacecolor="white", markeredgecolor=INK, label=name,
        )  # fmt: skip
    ax.plot(conicities.index * 1e3, conicities[chosen], color=BLUE, lw=2.6, label=chosen)
    ax.set(xlabel="amplitude (mm)", ylabel=r"equivalent conicity $\tan\gamma_e$ (-)")
    ax.set_ylim(bottom=0.0)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


@styled
def variant_speeds(table: pd.DataFrame) -> Figure:
    """Both critical speeds by variant: columns variant, v_lin, v_non m/s."""
    figure, (ax,) = panels(1, 1, 0.9 + 0.36 * len(table))
    place = range(len(table))
    ax.hlines(place, table["v_non"], table["v_lin"], color=FAINT, lw=1.0)
    ax.plot(table["v_lin"], place, "o", color=ORANGE, label="linear (Hopf)")
    ax.plot(table["v_non"], place, "s", color=BLUE, label="nonlinear (slowest cycle)")
    ax.set_yticks(place, table["variant"])
    ax.invert_yaxis()
    ax.set(xlabel="critical speed (m/s)", xlim=(0, None))
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure
