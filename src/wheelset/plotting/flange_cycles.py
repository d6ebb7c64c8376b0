"""Fig. 6: amplitudes of limit cycles over speed."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from wheelset.plotting.branches import MARKS
from wheelset.plotting.style import (
    BLUE,
    FAINT,
    GREEN,
    INK,
    ORANGE,
    PAPER,
    PURPLE,
    panels,
    styled,
)
from wheelset.published.figures import panel

#: The flange laws in the order of the panels, and what the paper calls them.
NAMES = {
    "none": "none", "quintic": "polynomial", "exponential": "exponential",
    "reciprocal": "reciprocal",
}  # fmt: skip

#: Colours by family, of the first reading; the second one has its own.
FAMILIES = {"H": BLUE, "H BPC1": GREEN, "H BPC1 PD1": PURPLE}
WORDS = {"H": "symmetric", "H BPC1": "asymmetric", "H BPC1 PD1": "doubled"}
SECOND = ORANGE

#: Parts of a panel's width: rings nearer than the first touch, letters nearer to an edge than the
#: second are written inwards.
NEAR, NEAR_EDGE = 0.04, 0.2

#: Of the reciprocal law's breaking of symmetry: speeds beside it, m/s, and heights, mm.
BESIDE, HEIGHTS = (-0.4, 1.7), (11.0, 11.22)


@styled
def cycle_panels(curves: pd.DataFrame, printed: pd.DataFrame, case: int) -> Figure:
    """The four panels of a case on the paper's axes.

    curves: reading, case, law, family, v m/s, y m, unstable, point; the first reading in colours of
    the families, the second in one. printed: case, law, point, printed m/s, y m (where to draw it).
    """
    figure, axes = panels(2, 2, 6.2)
    for ax, (law, name) in zip(axes, NAMES.items(), strict=True):
        window = panel(6, f"case {case}, {name}")
        assert window.x is not None and window.y is not None
        here = curves[(curves["case"] == case) & (curves["law"] == law)]
        _curves(ax, here)
        marks = printed[(printed["case"] == case) & (printed["law"] == law)]
        _printed(ax, marks, (window.x.low, window.x.high))
        ax.set(xlim=(window.x.low, window.x.high), ylim=(window.y.low, window.y.high), title=name)
        ax.set_yticks(range(0, 16, 5))
        ax.xaxis.set_major_locator(MaxNLocator(6, integer=True))
    _labels(axes)
    _legend(figure, axes[0], curves[curves["case"] == case])
    return figure


@styled
def breaking_panels(curves: pd.DataFrame, printed: pd.DataFrame, pole: float) -> Figure:
    """Where symmetry breaks under the reciprocal law, enlarged: cases 1 and 2 side by side.

    curves, printed: as for ``cycle_panels``, of one reading. pole: of the law, m.
    """
    figure, axes = panels(1, 2, 4.0, sharey=True)
    for case, ax in enumerate(axes, 1):
        here = curves[(curves["case"] == case) & (curves["law"] == "reciprocal")]
        breaks = here.loc[(here["point"] == "BPC") & (here["family"] == "H"), "v"]
        middle = float(breaks.iloc[0]) if len(breaks) else float(here["v"].median())
        window = middle + BESIDE[0], middle + BESIDE[1]
        _curves(ax, here)
        marks = printed[(printed["case"] == case) & (printed["law"] == "reciprocal")]
        inside = marks["printed"].between(*window) & (marks["y"] * 1e3).between(*HEIGHTS)
        _printed(ax, marks[inside], window)
        ax.axhline(pole * 1e3, color=FAINT, linestyle=":", linewidth=1.4)
        ax.set(xlim=window, ylim=HEIGHTS, title=f"case {case}", xlabel="speed $v$ (m/s)")
    axes[0].set_ylabel("largest $|y|$ (mm)")
    _legend(figure, axes[1], curves[curves["law"] == "reciprocal"])
    return figure


def _curves(ax: Axes, curves: pd.DataFrame) -> None:
    first = curves["reading"].iloc[0] if len(curves) else ""
    for (reading, family), branch in curves.groupby(["reading", "family"], sort=False):
        own = reading == first
        color = FAMILIES.get(str(family), INK) if own else SECOND
        for part, stable in _parts(branch):
            ax.plot(
                part["v"], part["y"] * 1e3, "-" if stable else "--", color=color,
                linewidth=1.9 if own else 1.2, zorder=2.5 if own else 2.0,
            )  # fmt: skip
        _marks(ax, branch, color)


def _parts(branch: pd.DataFrame) -> Iterator[tuple[pd.DataFrame, bool]]:
    """Stretches of one stability; neighbours share the point where it changes."""
    ordinary = branch["point"] == ""
    stable = (branch["unstable"] == 0).where(ordinary).ffill().bfill().astype(bool).to_numpy()
    cuts = [0, *(np.flatnonzero(stable[1:] != stable[:-1]) + 1).tolist(), len(branch)]
    for begin, end in pairwise(cuts):
        yield branch.iloc[max(begin - 1, 0) : end], bool(stable[begin])


def _marks(ax: Axes, branch: pd.DataFrame, color: str) -> None:
    for letters, points in branch[branch["point"] != ""].groupby("point"):
        shape = MARKS.get(str(letters), "o")
        ax.plot(
            points["v"], points["y"] * 1e3, shape, mfc="white", mec=color, ms=6, mew=1.3, zorder=3
        )


def _printed(ax: Axes, printed: pd.DataFrame, window: tuple[float, float]) -> None:
    """Rings at the printed speeds; rings that touch are lettered together."""
    low, high = window
    shown = printed.dropna(subset=["y"]).sort_values("printed")
    apart = (shown["printed"].diff() > NEAR * (high - low)) | (shown["y"].diff().abs() > 1e-3)
    for _, group in shown.groupby(apart.cumsum()):
        speed, y = float(group["printed"].mean()), float(group["y"].mean()) * 1e3
        ax.plot(
            group["printed"], group["y"] * 1e3, "o", mfc="none", mec=PAPER, ms=12, mew=1.3,
            zorder=4, clip_on=False,
        )  # fmt: skip
        part = (speed - low) / (high - low)
        side = "left" if part < NEAR_EDGE else "right" if part > 1 - NEAR_EDGE else "center"
        below = (group["point"] == "PD").all()
        ax.annotate(
            ", ".join(group["point"].drop_duplicates()), (speed, y), fontsize=9.5, ha=side,
            xytext=(0, -20 if below else 9), textcoords="offset points", zorder=5,
        )  # fmt: skip


def _labels(axes: list[Axes]) -> None:
    for ax in axes[2:]:
        ax.set_xlabel("speed $v$ (m/s)")
    for ax in axes[::2]:
        ax.set_ylabel("largest $|y|$ (mm)")


def _legend(figure: Figure, ax: Axes, curves: pd.DataFrame) -> None:
    """Colours, lines and the ring in words, above the panels."""
    names = curves["reading"].drop_duplicates().tolist()
    own = curves.loc[curves["reading"] == names[0], "family"].unique() if names else []
    for family in (f for f in FAMILIES if f in own):
        ax.plot([], [], color=FAMILIES[family], label=WORDS[family])
    if len(names) > 1:
        ax.plot([], [], color=SECOND, linewidth=1.2, label=names[1])
    ax.plot([], [], "-", color=INK, label="stable")
    ax.plot([], [], "--", color=INK, label="unstable")
    for letters in ("LPC", "BPC", "PD"):
        ax.plot([], [], MARKS[letters], mfc="white", mec=INK, ms=6, label=letters)
    ax.plot([], [], "o", mfc="none", mec=PAPER, ms=11, linestyle="none", label="printed")
    figure.legend(*ax.get_legend_handles_labels(), loc="outside upper center", ncols=4)
