"""Figures as pictures, all text removed: what was drawn before, beside what is now."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.testing.compare import compare_images
from matplotlib.text import Text

FOLDER = Path(__file__).parent / "pictures"

#: Root mean square of the difference in grey levels (of 255) that is let pass: a curve that moves
#: by three parts in a thousand makes ten times as much.
TOLERANCE = 1.0


def same_picture(name: str, figure: Figure, folder: Path) -> None:
    """The figure looks like the stored one; ``folder`` takes what is drawn now and the difference.

    With the environment variable WHEELSET_STORE_PICTURES set the picture is stored instead.
    """
    for text in figure.findobj(Text):
        text.set_visible(False)
    FigureCanvasAgg(figure)
    stored, drawn = FOLDER / f"{name}.png", folder / f"{name}.png"
    if os.environ.get("WHEELSET_STORE_PICTURES"):
        FOLDER.mkdir(exist_ok=True)
        figure.savefig(stored, dpi=60, metadata={"Software": None})
    figure.savefig(drawn, dpi=60, metadata={"Software": None})
    difference = compare_images(str(stored), str(drawn), TOLERANCE)
    assert difference is None, difference
