"""The engine itself: how its errors fall, how long it takes, and beside whom."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from wheelset.plotting.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    ORANGE,
    OTHER,
    OURS,
    PURPLE,
    SKY,
    panels,
    styled,
)

#: Colour and mark of a quantity's error.
QUANTITIES = {
    "between them": (ORANGE, "s"),
    "mesh points": (BLUE, "o"),
    "period": (GREEN, "^"),
    "multiplier": (PURPLE, "D"),
    "fold speed": (SKY, "v"),
}

#: Lines of an order.
GUIDES = {5: "--", 8: ":"}

#: Errors below this are rounding and are drawn on it.
FLOOR = 1e-15

#: Parts of a step, in the order of a bar, and their colours.
PARTS = {
    "linearise": BLUE,
    "solve": SKY,
    "tests": GREEN,
    "renewal": PURPLE,
    "special points": ORANGE,
    "solution": FAINT,
    "walk": INK,
}

#: What the walks are called in print.
WALKS = {"cycles": "cycles", "lpc_curve": "folds"}


@styled
def convergence_panels(errors: pd.DataFrame) -> Figure:
    """Errors over mesh intervals, one panel a system.

    errors: system, form (full: lines; half: marks), intervals a period, quantity, error. Grey:
    the orders 5 and 8, above the errors between and at the mesh points.
    """
    systems = errors["system"].drop_duplicates().tolist()
    figure, axes = panels(1, len(systems), 4.4, sharey=True)
    for ax, system in zip(axes, systems, strict=True):
        _errors(ax, errors[errors["system"] == system])
        ax.set(title=system, xlabel="intervals (per period)")
    axes[0].set_ylabel("error (relative)")
    fullest = max(axes, key=lambda ax: len(ax.get_legend_handles_labels()[1]))
    figure.legend(*fullest.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


def _errors(ax: Axes, errors: pd.DataFrame) -> None:
    for (quantity, form), group in errors.groupby(["quantity", "form"], sort=False):
        color, mark = QUANTITIES[str(quantity)]
        error = group["error"].clip(lower=FLOOR)
        if form == "full":
            ax.plot(group["intervals"], error, color=color, linewidth=1.2)
        else:
            ax.plot(group["intervals"], error, mark, color=color, ms=5, mfc="white", label=quantity)
    for quantity, order in (("between them", 5), ("mesh points", 8)):
        _slope(ax, errors[errors["quantity"] == quantity], order)
    ax.set(xscale="log", yscale="log", ylim=(FLOOR / 2, 1.0))
    ax.set_xticks([10, 20, 40, 80], ["10", "20", "40", "80"])
    ax.xaxis.set_minor_formatter(NullFormatter())


def _slope(ax: Axes, errors: pd.DataFrame, order: int) -> None:
    """A line of an order, three times above the coarsest error."""
    intervals = np.array([errors["intervals"].min(), errors["intervals"].max()])
    line = 3 * float(errors["error"].max()) * (intervals / intervals[0]) ** -float(order)
    ax.plot(intervals, line, GUIDES[order], color=FAINT, linewidth=1.4, label=f"order {order}")


@styled
def goal_dots(goals: pd.DataFrame) -> Figure:
    """How many times longer AUTO takes, beside what was aimed at.

    goals: goal, case, wanted, reached; one row a goal and case.
    """
    names = goals["goal"].drop_duplicates().tolist()
    figure, (ax,) = panels(1, 1, 1.5 + 0.5 * len(names))
    heights = goals["goal"].map(names.index)
    ax.plot(goals["wanted"], heights, "|", color=INK, ms=16, mew=2, label="goal")
    for (case, rows), color, mark in zip(
        goals.groupby("case", sort=False), (OURS, SKY, OTHER, PURPLE), "odsD", strict=False
    ):
        ax.plot(rows["reached"], rows["goal"].map(names.index), mark, color=color, label=case)
    ax.set(xscale="log", xlabel="AUTO's time over ours (times)")
    ax.axvline(1, color=FAINT, linewidth=1.0)
    ax.set_yticks(range(len(names)), [name.replace(" beside ", "\nbeside ") for name in names])
    ax.set_xticks([1, 2, 5, 10, 20, 50], ["1", "2", "5", "10", "20", "50"])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.invert_yaxis()
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


@styled
def cost_panels(intervals: pd.DataFrame, lines: pd.DataFrame, sizes: pd.DataFrame) -> Figure:
    """One linearisation with its solution: over mesh intervals, and over the number of states.

    intervals: of, intervals, least ms. lines: of, ms_for_nothing, ms_an_interval: drawn. sizes: n,
    least ms.
    """
    figure, (left, right) = panels(1, 2, 3.6)
    for (of, rows), color, mark in zip(
        intervals.groupby("of", sort=False), (OURS, OTHER), "od", strict=False
    ):
        line = lines.set_index("of").loc[of]
        N = np.geomspace(rows["intervals"].min(), rows["intervals"].max(), 50)
        left.plot(N, line["ms_for_nothing"] + line["ms_an_interval"] * N, color=color)
        left.plot(rows["intervals"], rows["least"], mark, color=color, label=str(of))
    right.plot(sizes["n"], sizes["least"], "o-", color=OURS)
    left.set(xlabel="intervals (full period)", xscale="log", ylabel="time (ms)", yscale="log")
    right.set(xlabel="states (number)", xscale="log", ylabel="time (ms)", yscale="log")
    right.set_xticks(sizes["n"], [str(n) for n in sizes["n"]])
    right.xaxis.set_minor_formatter(NullFormatter())
    left.legend()
    return figure


@styled
def time_bars(breakdown: Mapping[str, Mapping[str, Mapping[str, float]]]) -> Figure:
    """Where a step's time goes: ms by part, one bar a form and sort of curve.

    breakdown: by form and walk, "<part>_ms" -> ms a step.
    """
    bars = {
        f"{WALKS[walk]}, {form}": parts
        for walk in WALKS
        for form, walks in breakdown.items()
        for parts in [walks[walk]]
    }
    figure, (ax,) = panels(1, 1, 1.6 + 0.33 * len(bars))
    begin = np.zeros(len(bars))
    for part, color in PARTS.items():
        width = np.array([parts.get(f"{part}_ms", 0.0) for parts in bars.values()])
        ax.barh(range(len(bars)), width, left=begin, color=color, label=part, height=0.7)
        begin += width
    ax.set_yticks(range(len(bars)), list(bars))
    ax.set_xlabel("time of a step (ms)")
    ax.invert_yaxis()
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure
