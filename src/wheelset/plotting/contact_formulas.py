"""The contact formulas beside what they stand for: errors over shapes of the contact ellipse."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from wheelset.plotting.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    panels,
    styled,
)

#: Colour of a quantity in every figure.
ELLIPSE = {
    ("inside", "ab"): (BLUE, "-", "$ab$, factor under the power"),
    ("outside", "ab"): (PURPLE, "-.", "$ab$, factor beside it"),
    ("inside", "b/a"): (ORANGE, "--", "$b/a$"),
}
CREEP = {"f11": BLUE, "f22": ORANGE, "f23": GREEN}
KALKER = {"C11": BLUE, "C22": ORANGE, "C23": GREEN, "C33": PURPLE}
MARKS = {"C11": "o", "C22": "s", "C23": "^", "C33": "D"}

#: Colours and marks of the columns of Kalker's table.
POISSON = ((0.0, BLUE, "o", "0"), (0.25, ORANGE, "s", "1/4"), (0.5, GREEN, "^", "1/2"))

#: What a range without end is drawn to.
_FAR = 1e3


def _plain(axis: Axis) -> None:
    """Ticks 1, 2, 5, 10 of a logarithmic axis, written out."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


@styled
def hertz_panels(errors: pd.DataFrame, visited: pd.DataFrame) -> Figure:
    """Errors of the ellipse and of the creep coefficients over A/B, and where contacts lie.

    errors: reading, against, quantity, ratio, error. visited: of, low, high (A/B).
    """
    sizes = {"height_ratios": [3, 3, 0.35 * len(visited)]}
    figure, (ellipse, creep, where) = panels(3, 1, 7.6, sharex=True, gridspec_kw=sizes)
    curves = dict(list(errors.groupby(["reading", "against", "quantity"])))
    for (reading, quantity), (color, line, label) in ELLIPSE.items():
        _curve(ellipse, curves[reading, "Hertz", quantity], line, color, label)
    for name, color in CREEP.items():
        _curve(creep, curves["inside", "Hertz", name], "-", color, f"$f_{{{name[1:]}}}$")
        _curve(creep, curves["inside", "both", name], ":", color, None)
    _ranges(where, visited)
    ellipse.set(title="ellipse of Eq. (6)", ylabel="error (%)", xscale="log")
    creep.set(title="creep coefficients", ylabel="error (%)")
    where.set(title="contacts that occur", xlabel="$A/B$ (1)")
    low, high = errors["ratio"].min(), errors["ratio"].max()
    where.set_xlim(low, high)
    _plain(where.xaxis)
    for ax in (ellipse, creep):
        _band(ax, visited["low"].iloc[0], visited["high"].iloc[0])
        ax.legend(ncols=3, loc="upper center", fontsize=9.5)
    ellipse.set_ylim(top=1.3 * ellipse.get_ylim()[1])
    creep.set_ylim(top=creep.get_ylim()[1] + 2.0)
    return figure


def _curve(ax: Axes, curve: pd.DataFrame, line: str, color: str, label: str | None) -> None:
    ax.plot(curve["ratio"], 1e2 * curve["error"], line, color=color, label=label)


def _ranges(ax: Axes, visited: pd.DataFrame) -> None:
    """A bar a row, the first on top."""
    for place, (_, row) in enumerate(visited.iterrows()):
        width = min(float(row["high"]), _FAR) - float(row["low"])
        ax.barh(
            place, width, left=float(row["low"]), color=INK if place == 0 else FAINT, height=0.5
        )
    ax.set_yticks(range(len(visited)), list(visited["of"]))
    ax.invert_yaxis()


def _band(ax: Axes, low: float, high: float) -> None:
    ax.axhline(0, color=FAINT, linewidth=1.0)
    ax.axvspan(float(low), float(high), color="#EFEFEF", zorder=0)


@styled
def kalker_panels(points: pd.DataFrame, curves: pd.DataFrame, visited: pd.DataFrame) -> Figure:
    """Kalker's table as marks, the fits as lines, one panel a coefficient over b/a.

    points: coefficient, nu, k, value. curves: coefficient, k, value. visited: k_low, k_high.
    """
    figure, axes = panels(2, 2, 5.8, sharex=True)
    for ax, (name, curve) in zip(axes, curves.groupby("coefficient"), strict=True):
        for nu, color, mark, words in POISSON:
            rows = points[(points["coefficient"] == name) & (points["nu"] == nu)]
            label = rf"table, $\nu = {words}$"
            ax.plot(rows["k"], rows["value"], mark, color=color, ms=4, mfc="white", label=label)
        ax.plot(curve["k"], curve["value"], color=INK, label="fit")
        ax.axvspan(visited["k_low"].iloc[0], visited["k_high"].iloc[0], color="#EFEFEF", zorder=0)
        letter = f"$C_{{{str(name)[1:]}}}$"
        ax.set(title=letter, ylabel=f"{letter} (1)", xscale="log", yscale="log")
        _plain(ax.xaxis)
        _plain(ax.yaxis)
    for ax in axes[2:]:
        ax.set_xlabel("$b/a$ (1)")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure


@styled
def fit_panels(points: pd.DataFrame, means: pd.DataFrame, best: pd.DataFrame) -> Figure:
    """Errors of the fits over b/a at one Poisson's ratio, and their mean over that ratio.

    points: coefficient, k, error, of one nu. means: coefficient, nu, rms. best: the same, the
    least.
    """
    figure, (left, right) = panels(1, 2, 3.6)
    for name, color in KALKER.items():
        rows, mean = (frame[frame["coefficient"] == name] for frame in (points, means))
        label = f"$C_{{{name[1:]}}}$"
        left.plot(rows["k"], 1e2 * rows["error"], MARKS[name] + "-", color=color, ms=4, lw=1.0)
        right.plot(mean["nu"], 1e2 * mean["rms"], color=color)
        least = best[best["coefficient"] == name]
        right.plot(least["nu"], 1e2 * least["rms"], MARKS[name], color=color, ms=5, label=label)
    left.axhline(0, color=FAINT, linewidth=1.0)
    left.set(xscale="log", xlabel="$b/a$ (1)", ylabel="error (%)")
    _plain(left.xaxis)
    left.set_title(rf"at $\nu = {points['nu'].iloc[0]:g}$")
    right.set(yscale="log", xlabel=r"Poisson's ratio $\nu$ (1)", ylabel="root mean square (%)")
    right.set_title("over the table")
    _plain(right.yaxis)
    figure.legend(*right.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return figure
