"""Figs 9 and 10: profiles of worn wheels and the contact geometry they make."""

from __future__ import annotations

from collections.abc import Iterable

import matplotlib as mpl
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import FAINT, panels, styled
from wheelset.published.figures import Panel, panel

#: Millimetres for lengths along the axes.
MM = 1e3

#: The part of the colour map that is dark enough for lines on white, from new to worn.
_DARK = (0.0, 0.78)


def mileage_colors(mileages: Iterable[float]) -> dict[float, str]:
    """A colour for each mileage, in order; the map is the same for all eyes."""
    known = sorted(mileages)
    low, high = _DARK
    steps = [low + (high - low) * k / max(1, len(known) - 1) for k in range(len(known))]
    dark = mpl.colormaps["viridis"]
    return {m: mpl.colors.to_hex(dark(step)) for m, step in zip(known, steps, strict=True)}


def framed(ax: Axes, shown: Panel) -> None:
    """The paper's axes."""
    assert shown.x is not None and shown.y is not None
    ax.set(xlim=(shown.x.low, shown.x.high), ylim=(shown.y.low, shown.y.high))


@styled
def worn_profiles(profiles: pd.DataFrame) -> Figure:
    """The paper's Fig. 9: profiles whole and enlarged.

    profiles: mileage 1e4 km (0: the new wheel, dotted), y m, z m.
    """
    figure, axes = panels(1, 2, 3.6)
    colors = mileage_colors(set(profiles["mileage"]) - {0.0})
    for ax, name in zip(axes, "ab", strict=True):
        for mileage, mine in profiles.groupby("mileage"):
            _profile(ax, float(str(mileage)), mine, colors)
        framed(ax, panel(9, name))
        ax.set_title(f"({name})", loc="left")
        ax.set_xlabel("$y$, outward (mm)")
    axes[0].set_ylabel("$z$, towards the flange's tip (mm)")
    _legend(figure, axes[0])
    return figure


def _profile(ax: Axes, mileage: float, mine: pd.DataFrame, colors: dict[float, str]) -> None:
    new = mileage == 0.0
    ax.plot(
        mine["y"] * MM, mine["z"] * MM, ":" if new else "-", linewidth=1.3,
        color=FAINT if new else colors[mileage], label="new" if new else f"{mileage:g}",
    )  # fmt: skip


@styled
def worn_contact(curves: pd.DataFrame, conicity: pd.DataFrame) -> Figure:
    """The paper's Fig. 10: rolling radius, equivalent conicity, contact angle, wheel's curvature.

    curves: mileage 1e4 km, y m, r m, delta rad, curvature 1/m. conicity: mileage, amplitude m,
    conicity.
    """
    figure, axes = panels(2, 2, 6.6)
    colors = mileage_colors(set(curves["mileage"]))
    for mileage, color in colors.items():
        mine = curves[curves["mileage"] == mileage]
        for ax, column in zip(
            (axes[0], axes[2], axes[3]), ("r", "delta", "curvature"), strict=True
        ):
            ax.plot(mine["y"] * MM, mine[column], color=color, label=f"{mileage:g}", linewidth=1.4)
        waves = conicity[conicity["mileage"] == mileage]
        axes[1].plot(waves["amplitude"] * MM, waves["conicity"], color=color, linewidth=1.4)
    _label(axes)
    _legend(figure, axes[0])
    return figure


def _label(axes: list[Axes]) -> None:
    heights = ("$r$ (m)", r"equivalent conicity $\tan\gamma_e$ (-)",
               r"$\delta$ (rad)", "curvature of the wheel (1/m)")  # fmt: skip
    for ax, name, height in zip(axes, "abcd", heights, strict=True):
        framed(ax, panel(10, name))
        ax.set_title(f"({name})", loc="left")
        ax.set(xlabel="amplitude (mm)" if name == "b" else "$y_w$ (mm)", ylabel=height)


def _legend(figure: Figure, ax: Axes) -> None:
    figure.legend(
        *ax.get_legend_handles_labels(), loc="outside upper center", ncols=6,
        title="mileage (10⁴ km)",
    )  # fmt: skip


@styled
def curvature_close(curves: pd.DataFrame, width: float) -> Figure:
    """The wheel's curvature at the contact on an axis on which ours can be read.

    curves: mileage 1e4 km, y m, curvature 1/m. width: standard deviation of the average, m.
    """
    figure, (ax,) = panels(1, 1, 3.4)
    for mileage, color in mileage_colors(set(curves["mileage"])).items():
        mine = curves[curves["mileage"] == mileage]
        ax.plot(mine["y"] * MM, mine["curvature"], color=color, label=f"{mileage:g}", linewidth=1.4)
    ax.axvspan(-width * MM, width * MM, color=FAINT, alpha=0.25, linewidth=0)
    ax.set(xlim=(-8, 8), ylim=(-20, 12), xlabel="$y_w$ (mm)", ylabel="curvature of the wheel (1/m)")
    _legend(figure, ax)
    return figure
