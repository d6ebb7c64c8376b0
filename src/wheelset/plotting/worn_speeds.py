"""Table 4, Fig. 11 and the inverse question: speeds, stiffness and geometry by mileage."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    ORANGE,
    OTHER,
    OURS,
    PAPER,
    PURPLE,
    panels,
    styled,
)
from wheelset.plotting.worn import framed, mileage_colors
from wheelset.published.figures import panel
from wheelset.published.numbers import TABLE_4

MEGA = 1e-6

_MILEAGE = "mileage (10⁴ km)"

#: Marks and lines of a first, second and third set of curves.
_LINES = (("o", "-"), ("s", "--"), ("^", ":"))


@styled
def speeds_by_mileage(tables: Mapping[str, pd.DataFrame]) -> Figure:
    """Both critical speeds and the FLC over the mileage, the paper's Table 4 as rings.

    tables: by the name of the wear law: mileage 1e4 km, v_lin, v_fold m/s, flc 1/s.
    """
    figure, (left, right) = panels(1, 2, 3.9)
    for (law, table), (mark, line) in zip(tables.items(), _LINES, strict=False):
        for column, color, words in (("v_lin", OURS, "Hopf"), ("v_fold", OTHER, "fold")):
            left.plot(
                table["mileage"], table[column], mark + line, color=color, ms=5, linewidth=1.4,
                label=f"{words}, {law}",
            )  # fmt: skip
        right.plot(table["mileage"], table["flc"], mark + line, color=OURS, ms=5, linewidth=1.4)
    _printed(left, "hopf_speed")
    _printed(right, "flc")
    left.set(xlabel=_MILEAGE, ylabel="critical speed (m/s)", ylim=(30, 95))
    right.set(xlabel=_MILEAGE, ylabel="FLC (1/s)")
    right.set_yscale("symlog", linthresh=1.0, linscale=0.6)
    right.axhline(0, color=FAINT, linewidth=1.0)
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _printed(ax: Axes, quantity: str) -> None:
    ax.plot(
        [row.mileage for row in TABLE_4], [getattr(row, quantity) for row in TABLE_4], "o",
        mfc="none", mec=PAPER, ms=9, mew=1.2, label="paper",
    )  # fmt: skip


@styled
def speeds_by_width(table: pd.DataFrame) -> Figure:
    """Hopf speed, FLC and fold for several averaging widths.

    table: width m, mileage 1e4 km, v_lin, v_fold m/s, flc 1/s.
    """
    figure, axes = panels(1, 3, 3.4)
    kinds = zip(table.groupby("width"), _LINES, (BLUE, ORANGE, GREEN), strict=False)
    for (width, mine), (mark, line), color in kinds:
        label = f"{float(str(width)) * 1e3:g} mm"
        for ax, column in zip(axes, ("v_lin", "flc", "v_fold"), strict=True):
            ax.plot(
                mine["mileage"], mine[column], mark + line, color=color, ms=4, linewidth=1.3,
                label=label,
            )  # fmt: skip
    for ax, title in zip(axes, ("Hopf speed (m/s)", "FLC (1/s)", "fold (m/s)"), strict=True):
        ax.set_title(title, loc="left")
        ax.set_xlabel(_MILEAGE)
    axes[0].set_ylim(35, 90)
    axes[2].set_ylim(35, 90)
    axes[1].set_yscale("symlog", linthresh=10.0)
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3,
        title="averaging width",
    )  # fmt: skip
    return figure


@styled
def stiffness_panels(curves: pd.DataFrame) -> Figure:
    """The paper's Fig. 11 with its axes, and the fold curves on axes that hold them.

    curves: mileage 1e4 km, curve (Hopf, LPC), Kpx N/m, Kpy N/m, in the order of drawing.
    """
    figure, (left, right) = panels(1, 2, 4.3)
    colors = mileage_colors(set(curves["mileage"]))
    for ax in (left, right):
        for mileage, color in colors.items():
            _stiffness(ax, curves[curves["mileage"] == mileage], color, f"{mileage:g}")
        ax.plot(1, 1, "o", mfc="none", mec=PAPER, ms=8)
        ax.set_xlabel("$K_{px}$ (MN/m)")
    framed(left, panel(11))
    right.set(xlim=(0, 6), ylim=(0, 6))
    left.set_ylabel("$K_{py}$ (MN/m)")
    left.plot([], [], "-", color=INK, label="Hopf")
    left.plot([], [], "--", color=INK, label="fold")
    figure.legend(
        *left.get_legend_handles_labels(), loc="outside upper center", ncols=7,
        title="mileage (10⁴ km)",
    )  # fmt: skip
    return figure


def _stiffness(ax: Axes, curves: pd.DataFrame, color: str, label: str) -> None:
    for curve, line in (("Hopf", "-"), ("LPC", "--")):
        mine = curves[curves["curve"] == curve]
        words = label if curve == "Hopf" else None
        ax.plot(
            mine["Kpx"] * MEGA, mine["Kpy"] * MEGA, line, color=color, linewidth=1.5, label=words
        )


@styled
def inverse_panels(
    tables: Mapping[str, pd.DataFrame], reading: str, compared: tuple[float, float]
) -> Figure:
    """The a1 and a3 that give Table 4's rows, over the mileage.

    tables: by vehicle: mileage 1e4 km, a1, neutral, and the a3 of the printed coefficient as it
    stands and under the reading. compared: the a3 that section 5 goes through, at most, 1/m2.
    """
    figure, (left, right) = panels(1, 2, 3.9)
    for (name, table), (mark, line), color in zip(
        tables.items(), _LINES, (BLUE, ORANGE), strict=False
    ):
        left.plot(table["mileage"], table["a1"], mark + line, color=color, label=name)
        right.plot(table["mileage"], table[reading], mark + line, color=color)
        printed = table["as MATCONT prints it"]
        right.plot(table["mileage"], printed, mark + line, color=color, alpha=0.4, linewidth=1.0)
    for value in compared:
        right.axhline(value, color=PURPLE, linewidth=1.0, linestyle=":")
    left.set(xlabel=_MILEAGE, ylabel="$a_1$ (-)", ylim=(0.1, 0.2))
    right.set(xlabel=_MILEAGE, ylabel="$a_3$ (1/m²)", ylim=(-1000, 1000))
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return figure
