"""One look for every figure: colour-blind safe, legible on a phone, a white card in dark mode."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from io import StringIO
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib as mpl
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.figure import Figure

P = ParamSpec("P")

#: Okabe and Ito's colours, safe for colour-blind readers, dark enough for lines on white.
BLUE, ORANGE, GREEN, PURPLE, SKY = "#0072B2", "#D55E00", "#009E73", "#AA4499", "#56B4E9"
INK, FAINT = "#222222", "#8A8A8A"

#: Colours of what the paper prints and of what is computed here.
PAPER, OURS, OTHER = INK, BLUE, ORANGE

#: Colours and lines of the left and the right wheel.
SIDES = {"left": (OURS, "-"), "right": (ORANGE, "--")}

# The panel is white on purpose: the book's dark mode leaves it as a card instead of inverting it.
_STYLE: Any = {
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "figure.constrained_layout.use": True,
    "font.size": 11.5,
    "axes.titlesize": 12,
    "axes.labelsize": 11.5,
    "xtick.labelsize": 10.5,
    "ytick.labelsize": 10.5,
    "legend.fontsize": 10.5,
    "legend.frameon": False,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.8,
    "axes.axisbelow": True,
    "lines.linewidth": 1.8,
    "axes.prop_cycle": cycler(color=[BLUE, ORANGE, GREEN, PURPLE, SKY]),
}

#: Width of a figure in inches: the text column of the book.
WIDTH = 6.8


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Draw with the book's style, leaving matplotlib's global settings as they were."""

    @wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with mpl.rc_context(_STYLE):
            return draw(*args, **kwargs)

    return drawn


def panels(rows: int, columns: int, height: float, **shared: Any) -> tuple[Figure, list[Axes]]:
    """A figure of the book's width and its axes, row by row; height in inches."""
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.subplots(rows, columns, squeeze=False, **shared)
    return figure, list(axes.ravel())


def save(figure: Figure, path: str | Path) -> Path:
    """Write a figure as SVG, byte for byte the same for the same figure; returns the path."""
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(svg(figure).encode())
    return target


def svg(figure: Figure) -> str:
    """A figure as SVG text, the same for the same figure."""
    text = StringIO()
    with mpl.rc_context({"svg.hashsalt": "wheelset"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()
