"""Fig. 5: simulated hunting motions."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import FAINT, ORANGE, OURS, panels, styled

#: Half the height of a panel in mm, as in Fig. 5.
_HEIGHT = 12.0


@styled
def time_history_panels(motions: pd.DataFrame, outcomes: pd.DataFrame) -> Figure:
    """Motions y(t), one panel each, two beside each other, on the axes of the paper's Fig. 5.

    motions: panel, t s, y m. outcomes: panel, title, paper_amplitude m (NaN: none), ended_at s
    (NaN: ran to the end), one row a panel in the order of drawing.
    """
    rows = (len(outcomes) + 1) // 2
    figure, axes = panels(rows, 2, 2.6 * rows, sharex=True, sharey=True)
    for ax, outcome in zip(axes, outcomes.itertuples(), strict=False):
        _panel(ax, motions[motions["panel"] == outcome.panel], outcome)
    figure.get_layout_engine().set(wspace=0.06)  # type: ignore[union-attr, call-arg]
    for ax in axes[len(outcomes) :]:
        ax.set_visible(False)
    for ax in axes[-2:]:
        ax.set_xlabel("time $t$ (s)")
    for ax in axes[::2]:
        ax.set_ylabel("$y$ (mm)")
    return figure


def _panel(ax: Axes, motion: pd.DataFrame, outcome: object) -> None:
    ax.plot(motion["t"], motion["y"] * 1e3, color=OURS, linewidth=1.1)
    ax.set(ylim=(-_HEIGHT, _HEIGHT), title=getattr(outcome, "title", ""))
    ax.set_yticks(range(-12, 13, 6))
    ax.margins(x=0)
    for height in _amplitudes(outcome):
        ax.axhline(height * 1e3, color=FAINT, linewidth=1.2, linestyle="--")
    ended = getattr(outcome, "ended_at", float("nan"))
    if pd.notna(ended):
        ax.axvline(ended, color=ORANGE, linewidth=1.5)


def _amplitudes(outcome: object) -> tuple[float, ...]:
    """Where the paper's amplitude lies, m: both sides, or nowhere."""
    amplitude = getattr(outcome, "paper_amplitude", float("nan"))
    return (-amplitude, amplitude) if pd.notna(amplitude) else ()
