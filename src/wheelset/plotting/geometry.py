"""The contact geometry and the displacements at which Hertz's formulas hold."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import FAINT, SIDES, panels, styled

_PANELS = (
    ("dr", 1e3, r"$r - r_0$ (mm)", "rolling radius"),
    ("delta", 1.0, r"$\delta$ (rad)", "contact angle"),
    ("rho", 1.0, r"$\rho$ (1/m)", "sum of curvatures"),
)


@styled
def geometry_panels(geometry: pd.DataFrame, domain: pd.DataFrame) -> Figure:
    """Rolling radius, contact angle and curvature sum of both wheels over the displacement.

    geometry: side, y m, dr m, delta rad, rho 1/m. domain: side, low m, high m; grey outside.
    """
    figure, axes = panels(3, 1, 6.6, sharex=True)
    low, high = float(domain["low"].max()), float(domain["high"].min())
    for ax, (column, scale, label, title) in zip(axes, _PANELS, strict=True):
        for side, curve in geometry.groupby("side"):
            color, line = SIDES[str(side)]
            ax.plot(
                curve["y"] * 1e3, curve[column] * scale, line, color=color, label=f"{side} wheel"
            )
        ax.set(ylabel=label, title=title)
        _shade_outside(ax, low, high)
    axes[0].legend(loc="upper center", ncols=2)
    axes[-1].axhline(0, color=FAINT, linewidth=1.0)
    axes[-1].set_xlabel("lateral displacement $y$ (mm)")
    return figure


def _shade_outside(ax: Axes, low: float, high: float) -> None:
    """Grey where the sum of curvatures of one wheel is not positive; infinite ends are cut."""
    ax.margins(x=0)
    left, right = ax.get_xlim()
    for begin, end in ((left, max(left, low * 1e3)), (min(right, high * 1e3), right)):
        if end > begin:
            ax.axvspan(begin, end, facecolor="#EDEDED", hatch="//", edgecolor="#CFCFCF")
    ax.set_xlim(left, right)
