"""Figs 7 and 8: critical speeds over one coefficient of the contact geometry, panel by panel."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.branches import MARKS
from wheelset.plotting.style import BLUE, FAINT, GREEN, INK, ORANGE, PAPER, PURPLE, panels, styled
from wheelset.published.figures import PANELS, Panel
from wheelset.published.numbers import SECTION_4_HOPF, TABLE_1, TABLE_3

#: Unit of each coefficient, for the axes.
UNITS = {
    "a1": "1", "a3": "1/m²", "c1": "1/m", "c3": "1/m³", "e1": "1/m²", "e3": "1/m⁴", "f1": "1/m²",
    "f3": "1/m⁴",
}  # fmt: skip

#: Colour of a curve, and width, by the place of its vehicle: the page's, the second, the physical.
COLORS = {"Hopf": (BLUE, GREEN, FAINT), "LPC": (ORANGE, PURPLE, INK)}
WIDTHS = (2.0, 1.2, 1.0)

_LINES = {"H-": "-", "H+": "--", "LPC": "-", "": ":"}


@styled
def panel_grid(
    number: int, curves: pd.DataFrame, printed: pd.DataFrame, vehicles: tuple[str, ...]
) -> Figure:
    """The paper's Fig. 7 or 8: eight panels with its axes, the printed numbers as rings.

    curves: panel, vehicle, curve (Hopf, LPC), value (SI), v m/s, part (H-, H+, GH, LPC), point
    (letters of special points), in the order of drawing. printed: panel, value (SI), v m/s.
    vehicles: the page's, the second reading, the physical one.
    """
    shown = [panel for panel in PANELS if panel.figure == number]
    figure, axes = panels(len(shown) // 2, 2, 2.35 * len(shown) / 2 + 0.7)
    for ax, panel in zip(axes, shown, strict=True):
        for place, vehicle in reversed(list(enumerate(vehicles))):
            mine = curves[(curves["panel"] == panel.name) & (curves["vehicle"] == vehicle)]
            _draw(ax, mine, place)
        _rings(ax, printed[printed["panel"] == panel.name])
        _frame(ax, panel)
        _below(ax, curves[(curves["panel"] == panel.name) & (curves["vehicle"] == vehicles[0])])
    for ax in axes[::2]:
        ax.set_ylabel("speed $v$ (m/s)")
    _legend(figure, axes[0], curves, vehicles)
    return figure


def _draw(ax: Axes, curves: pd.DataFrame, place: int) -> None:
    for name, curve in curves.groupby("curve", sort=False):
        color = COLORS[str(name)][place]
        for part, run in _runs(curve):
            ax.plot(run["value"], run["v"], _LINES[part], color=color, linewidth=WIDTHS[place])
        if place == 0:
            _marks(ax, curve[curve["point"] != ""])


def _runs(curve: pd.DataFrame) -> list[tuple[str, pd.DataFrame]]:
    """Stretches of one part; a GH point belongs to both beside it."""
    parts, cuts = curve["part"].tolist(), [0]
    last = next((part for part in parts if part != "GH"), "")
    named = []
    for k, part in enumerate(parts):
        if part not in ("GH", last):
            cuts.append(k - 1 if parts[k - 1] == "GH" else k)
            named.append(last)
            last = part
    cuts.append(len(parts) - 1)
    stretches = zip([*named, last], pairwise(cuts), strict=True)
    return [(part, curve.iloc[low : high + 1]) for part, (low, high) in stretches]


def _marks(ax: Axes, special: pd.DataFrame) -> None:
    """Special points with their letters."""
    once = special.drop_duplicates(["point", "value"])
    for letters, value, speed in zip(once["point"], once["value"], once["v"], strict=True):
        shape = MARKS.get(letters, "o")
        size = 11 if shape == "*" else 6
        ax.plot(value, speed, shape, mfc="white", mec=INK, ms=size, mew=1.2, zorder=4)
        ax.annotate(
            letters, (value, speed), xytext=(4, 7), textcoords="offset points",
            annotation_clip=True, fontsize=9.5,
        )  # fmt: skip


def _rings(ax: Axes, printed: pd.DataFrame) -> None:
    ax.plot(
        printed["value"], printed["v"], "o", mfc="none", mec=PAPER, ms=8, mew=1.1, zorder=3,
        linestyle="none",
    )  # fmt: skip


def _frame(ax: Axes, panel: Panel) -> None:
    """The paper's axes."""
    assert panel.x is not None and panel.y is not None
    name = panel.x.label
    ax.set(xlim=(panel.x.low, panel.x.high), ylim=(panel.y.low, panel.y.high))
    ax.set_title(f"({panel.name})", loc="left")
    ax.set_xlabel(f"${name[0]}_{name[1]}$ ({UNITS[name]})")
    ax.ticklabel_format(axis="x", style="sci", scilimits=(-3, 5), useMathText=True)
    ax.ticklabel_format(axis="y", style="plain", useOffset=False)
    ax.locator_params(axis="x", nbins=5)
    ax.locator_params(axis="y", nbins=5)


def _below(ax: Axes, curves: pd.DataFrame) -> None:
    """A word on a curve that lies below the axis everywhere."""
    (left, right), (low, _) = ax.get_xlim(), ax.get_ylim()
    for name, curve in curves[curves["value"].between(left, right)].groupby("curve"):
        if curve["v"].max() < low:
            words = f"{name} at {curve['v'].median():.2f} m/s, below the axis"
            color = COLORS[str(name)][0]
            ax.text(
                0.5, 0.06, words, transform=ax.transAxes, ha="center", color=color, fontsize=9.5
            )


def printed_speeds(number: int) -> pd.DataFrame:
    """What the paper prints of the curves of Fig. 7 or 8: panel, value (SI), v m/s.

    Table 3's rows, in Fig. 8 with their LPC speeds, and section 4's default in Fig. 7.
    """
    names = {panel.x.label: panel.name for panel in PANELS if panel.figure == number and panel.x}
    rows = [(names[row.parameter], row.value, row.hopf_speed) for row in TABLE_3]
    if number == 8:
        lpc = [(names[r.parameter], r.value, r.lpc_speed) for r in TABLE_3 if r.lpc_speed]
        return pd.DataFrame([*rows, *lpc], columns=["panel", "value", "v"])
    default = [(names[q.symbol], q.value, SECTION_4_HOPF.hopf_speed)
               for q in TABLE_1 if q.symbol in names]  # fmt: skip
    return pd.DataFrame([*rows, *default], columns=["panel", "value", "v"])


def _legend(figure: Figure, ax: Axes, curves: pd.DataFrame, vehicles: tuple[str, ...]) -> None:
    present = curves.groupby("vehicle", sort=False)["curve"].unique().to_dict()
    _lines(ax, present, vehicles)
    ax.plot([], [], color=INK, linestyle="-", label="H− (supercritical)")
    ax.plot([], [], color=INK, linestyle="--", label="H+ (subcritical)")
    ax.plot([], [], "o", mfc="none", mec=PAPER, ms=8, label="paper")
    figure.legend(
        *ax.get_legend_handles_labels(), loc="outside upper center", ncols=2, fontsize=9.5
    )


def _lines(ax: Axes, present: Mapping[object, object], vehicles: tuple[str, ...]) -> None:
    for place, vehicle in enumerate(vehicles):
        for name in ("Hopf", "LPC"):
            if name in list(present.get(vehicle, ())):  # type: ignore[call-overload]
                color, width = COLORS[name][place], WIDTHS[place]
                ax.plot([], [], color=color, linewidth=width, label=f"{name}, {vehicle}")
