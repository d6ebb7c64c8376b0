"""Profiles and contacts of wheels and rails: drawn from tables of points, in mm."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from wheelset.plotting.style import FAINT, GREEN, INK, OURS, SIDES, panels, styled

#: Displacements whose contact lines are labelled, and how far apart the labels are at least, mm.
_LABELLED, _APART = 2.0, 5.0

#: Curvatures beyond this are cut off, 1/m: a flange's would hide a tread's.
_CURVATURE = 30.0


@styled
def profile_panels(profiles: dict[str, pd.DataFrame]) -> Figure:
    """Height and curvature of profiles; a column for each by title.

    Tables: y m, z m (down), curvature 1/m (positive where convex).
    """
    figure, axes = panels(2, len(profiles), 5.2, sharex="col")
    for k, (title, points) in enumerate(profiles.items()):
        shape, bent = axes[k], axes[k + len(profiles)]
        shape.plot(points["y"] * 1e3, points["z"] * 1e3, color=INK)
        shape.set(title=title, ylabel="$z$, down (mm)")
        shape.set_aspect("equal", adjustable="datalim")
        shape.invert_yaxis()
        cut = points["curvature"].clip(-_CURVATURE, _CURVATURE)
        bent.plot(points["y"] * 1e3, cut, color=OURS)
        bent.axhline(0, color=FAINT, linewidth=1.0)
        bent.set(
            xlabel="$y$, outward (mm)", ylabel="curvature (1/m)", ylim=(-_CURVATURE, _CURVATURE)
        )
    return figure


@styled
def contact_lines(
    wheel: pd.DataFrame, rail: pd.DataFrame, contact: pd.DataFrame, *, side: str = "left"
) -> Figure:
    """Where wheel and rail touch: a line joins the places for each displacement.

    wheel, rail: y m, z m of the profiles, drawn one above the other. contact: indexed by y m, with
    wheel_y and rail_y of the side, m.
    """
    figure, (ax,) = panels(1, 1, 4.2)
    apart = 15.0
    ax.plot(wheel["y"] * 1e3, wheel["z"] * 1e3 - apart, color=INK)
    ax.plot(rail["y"] * 1e3, rail["z"] * 1e3 + apart, color=INK)
    labels: list[float] = []
    places = contact[[f"wheel_y_{side}", f"rail_y_{side}"]].to_numpy(float) * 1e3
    for y, ends in zip(contact.index.to_numpy(float) * 1e3, places, strict=True):
        heights = [_height(wheel, ends[0]) - apart, _height(rail, ends[1]) + apart]
        ax.plot(ends, heights, color=OURS, linewidth=0.7)
        even = abs(y - _LABELLED * round(y / _LABELLED)) < 1e-6
        if even and all(abs(ends[0] - x) >= _APART for x in labels):
            labels.append(ends[0])
            ax.annotate(f"{y:+.0f}", (ends[0], heights[0] - 1.5), color=FAINT, fontsize=9)
    ax.set(xlabel="$y$ of the profile, outward (mm)", ylabel="$z$, down, moved apart (mm)")
    ax.invert_yaxis()
    return figure


def _height(points: pd.DataFrame, y: float) -> float:
    """z in mm where the drawn profile passes y in mm."""
    return float(np.interp(y, points["y"] * 1e3, points["z"] * 1e3))


@styled
def conicity_panels(contact: pd.DataFrame, conicity: pd.DataFrame) -> Figure:
    """Rolling radius difference, contact angles, contact places and equivalent conicity.

    contact: indexed by y m: dr m, and by side delta rad, wheel_y m. conicity: indexed by amplitude
    m: integration, regression.
    """
    figure, axes = panels(2, 2, 6.0)
    y = contact.index.to_numpy(float) * 1e3
    axes[0].plot(y, contact["dr"] * 1e3, color=OURS)
    axes[0].set(title="rolling radius difference", ylabel=r"$\Delta r$ (mm)")
    _by_side(axes[1], y, contact, "delta", 1e3)
    axes[1].set(title="contact angle", ylabel=r"$\delta$ (mrad)")
    axes[1].legend(loc="upper center", ncols=2)
    _by_side(axes[2], y, contact, "wheel_y", 1e3)
    axes[2].set(title="contact on the wheel", ylabel="place (mm)")
    for ax in axes[:3]:
        ax.set_xlabel("lateral displacement $y$ (mm)")
    draw_conicities(axes[3], conicity)
    axes[3].set(title="equivalent conicity", xlabel="amplitude (mm)", ylabel=r"$\tan\gamma_e$ (-)")
    return figure


def _by_side(
    ax: Axes, y: NDArray[np.float64], contact: pd.DataFrame, column: str, scale: float
) -> None:
    for side, (color, line) in SIDES.items():
        ax.plot(y, contact[f"{column}_{side}"] * scale, line, color=color, label=side)


def draw_conicities(ax: Axes, conicity: pd.DataFrame) -> None:
    """Conicity over the amplitude, mm: indexed by amplitude m; integration, regression."""
    amplitude = conicity.index.to_numpy(float) * 1e3
    ax.plot(amplitude, conicity["integration"], "o-", color=OURS, label="integration")
    ax.plot(amplitude, conicity["regression"], "s--", color=GREEN, label="regression")
    ax.set_ylim(bottom=0.0)
    ax.legend()
