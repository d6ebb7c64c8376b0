"""Fig. 4: the flange force laws."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import FAINT, ORANGE, OURS, panels, styled

#: Half width of the abscissa in mm and half height of each panel's ordinate in kN, as in Fig. 4.
_REACH = 15.0
_HEIGHT = {"reciprocal": 10.0}
_OTHER_HEIGHT = 100.0


@styled
def force_law_panels(forces: pd.DataFrame, domains: pd.DataFrame, clearance: float) -> Figure:
    """Four force laws on the axes of the paper's Fig. 4.

    forces: law, title, y m, force N. domains: law, low m, high m; hatched outside. clearance:
    eta in m, marked in every panel.
    """
    figure, axes = panels(2, 2, 5.4, sharex=True)
    limits = domains.set_index("law")
    for ax, (law, curve) in zip(axes, forces.groupby("law", sort=False), strict=True):
        _panel(ax, str(law), curve, clearance)
        _mark_domain(ax, *limits.loc[law, ["low", "high"]])
    for ax in axes[2:]:
        ax.set_xlabel("lateral displacement $y$ (mm)")
    for ax in axes[::2]:
        ax.set_ylabel("flange force (kN)")
    return figure


def _panel(ax: Axes, law: str, curve: pd.DataFrame, clearance: float) -> None:
    height = _HEIGHT.get(law, _OTHER_HEIGHT)
    for side in (-1, 1):
        ax.axvline(side * clearance * 1e3, color=FAINT, linewidth=1.0, linestyle=":")
    outward = curve[curve["force"] * curve["y"] > 0]
    if not outward.empty:
        _mark_outward(ax, outward)
    ax.plot(curve["y"] * 1e3, curve["force"] / 1e3, color=OURS)
    ax.set(xlim=(-_REACH, _REACH), ylim=(-height, height), title=curve["title"].iloc[0])
    ax.set_xticks(range(-15, 16, 5))


def _mark_outward(ax: Axes, outward: pd.DataFrame) -> None:
    """Shade the displacements where the force points away from the centre."""
    reach = float(outward["y"].abs().max()) * 1e3
    ax.axvspan(-reach, reach, color=ORANGE, alpha=0.13, linewidth=0)
    ax.text(0, 0.8 * ax.get_ylim()[1] * 100, "pushes outward", ha="center", color=ORANGE)


def _mark_domain(ax: Axes, low: float, high: float) -> None:
    """Hatch where the law is undefined and draw its poles."""
    for pole, end in ((low, -_REACH), (high, _REACH)):
        if np.isfinite(pole):
            ax.axvspan(pole * 1e3, end, facecolor="#F3F3F3", hatch="//", edgecolor="#CFCFCF")
            ax.axvline(pole * 1e3, color=FAINT, linewidth=1.2, linestyle="--")
