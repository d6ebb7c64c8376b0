"""What holds for every figure, whatever it shows."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from wheelset.plotting.style import save


def labelled_with_units(draw: Callable[[], Figure]) -> None:
    """Every axis label has a unit in brackets, and the global settings are left as they were."""
    before = dict(mpl.rcParams)
    figure = draw()
    assert dict(mpl.rcParams) == before
    labels = [t for ax in figure.axes for t in (ax.get_xlabel(), ax.get_ylabel()) if t]
    assert labels
    assert all("(" in label for label in labels)


def drawn_alike_twice(draw: Callable[[], Figure], folder: Path, most: int = 400_000) -> None:
    """The same figure gives the same file, byte by byte, and not a huge one."""
    one, two = (save(draw(), folder / f"{k}.svg").read_bytes() for k in (1, 2))
    assert one == two
    assert len(one) < most
