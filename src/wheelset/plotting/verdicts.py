"""Published and computed numbers beside each other: as a table and as a figure."""

from __future__ import annotations

from html import escape

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wheelset.plotting.style import FAINT, OTHER, OURS, PAPER, panels, styled
from wheelset.plotting.tables import Format, Table, link

#: Words for the quantities of ``published.items``.
QUANTITIES = {
    "value": "value (SI)",
    "hopf_speed": "Hopf speed (m/s)",
    "flc": "FLC (1/s)",
    "slc": "SLC (1/s)",
    "lpc_speed": "LPC speed (m/s)",
    "bpc_speed": "BPC speed (m/s)",
    "pd_speed": "PD speed (m/s)",
    "nfc": "NFC (1/s)",
    "gh_value": "GH point (SI)",
    "amplitude": "amplitude (mm)",
    "lpc_drop": "fall (%)",
    "lpc_change": "fall (m/s)",
    "stiffness_spread": "spread (%)",
}

_CLASSES = {
    "agrees": "verdict-agree",
    "within tolerance": "verdict-near",
    "differs": "verdict-differs",
    "not yet": "verdict-not-yet",
}

_HEADINGS = {
    "item": "item",
    "quantity": "quantity",
    "published": "paper",
    "computed": "here",
    "difference": "difference",
    "verdict": "verdict",
}


_STATUS = {
    name: {**_HEADINGS, "page": "page"}[name]
    for name in (
        "item", "quantity", "verdict", "page", "published", "computed", "difference",
    )
}  # fmt: skip


def comparison_table(comparison: pd.DataFrame, label: str, pages: bool = False) -> Table:
    """A comparison (columns of ``published.comparison``) with coloured verdicts, reasons below.

    pages: put the verdict first and link the page named in the column ``page``.
    """
    headings = _STATUS if pages else _without_empty(_HEADINGS, comparison)
    formats: dict[str, Format] = {
        "quantity": lambda name: str(QUANTITIES.get(name, name)),
        "published": number,
        "computed": number,
        "difference": signed,
        "verdict": _verdict,
        "page": _chapter,
    }
    return Table(comparison, headings, label, formats, frozenset({"verdict", "page"}), "reason")


def _without_empty(headings: dict[str, str], comparison: pd.DataFrame) -> dict[str, str]:
    """Figures have no numbers: their columns are left out where no row has one."""
    return {name: words for name, words in headings.items() if comparison[name].notna().any()}


def _chapter(page: str) -> str:
    """A link to a page, named by the number it begins with."""
    return link(f"ch.\u00a0{page.split('_')[0]}", f"{page}.html") if page else ""


def number(value: float) -> str:
    """Two decimals for everyday numbers, significant digits for small or large ones."""
    if 1 <= abs(value) < 1e5 or value == 0:
        return f"{value:.2f}" if value != round(value) or abs(value) < 100 else f"{value:.0f}"
    return f"{value:.4g}" if abs(value) < 1 else f"{value:.6g}"


def signed(value: float) -> str:
    """A difference with its sign; what vanishes at the digits shown is 0."""
    if abs(value) < 0.005:
        return "0.00" if value == 0 or abs(value) >= 1e-9 else "0"
    return f"{value:+.2f}" if abs(value) < 1e5 else f"{value:+.3g}"


def _verdict(word: str) -> str:
    return f'<span class="{_CLASSES[word]}">{escape(word)}</span>'


@styled
def hopf_comparison(comparisons: dict[str, pd.DataFrame]) -> Figure:
    """Hopf speeds and first Lyapunov coefficients, the paper's as rings, ours as marks.

    comparisons: by name of the vehicle, over the same items; at most two.
    """
    items = next(iter(comparisons.values()))["item"].drop_duplicates().tolist()
    figure, (left, right) = panels(1, 2, 1.6 + 0.33 * len(items), sharey=True)
    for ax, quantity in ((left, "hopf_speed"), (right, "flc")):
        _dots(ax, items, {n: t[t["quantity"] == quantity] for n, t in comparisons.items()})
    left.set_yticks(range(len(items)), [item.split(": ")[-1] for item in items])
    left.invert_yaxis()
    left.set_xlabel("Hopf speed (m/s)")
    right.set_xlabel("first Lyapunov coefficient (1/s)")
    right.set_xscale("symlog", linthresh=10, linscale=0.7)
    right.set_xticks([-10, 0, 10, 100], ["−10", "0", "10", "100"])
    right.margins(x=0.12)
    right.axvline(0, color=FAINT, linewidth=1.0)
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _dots(ax: Axes, items: list[str], tables: dict[str, pd.DataFrame]) -> None:
    heights = {item: height for height, item in enumerate(items)}
    first = next(iter(tables.values()))
    at = first["item"].map(heights)
    ax.plot(first["published"], at, "o", mfc="none", color=PAPER, ms=9, label="paper")
    for (name, table), color, mark in zip(tables.items(), (OURS, OTHER), "x+", strict=False):
        at = table["item"].map(heights)
        ax.plot(table["computed"], at, mark, color=color, ms=8, mew=2, label=name)
