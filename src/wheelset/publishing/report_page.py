"""One self-contained HTML page of words, tables and figures: no outside asset, prints well.

Figures travel as data in the page. What is shown is given as text; the page knows no physics.
"""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

#: A text this long is no number, and is given room on a narrow screen.
_LONG = 40

_NUMBER = re.compile(r"[−+±<>≤≥]?\s?\d[\d.,]*(e[−+-]?\d+)?$")

_STYLE = """
:root { color-scheme: light; }
body { margin: 0 auto; padding: 1rem; max-width: 46rem; background: #fff; color: #222;
  font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.5rem 0 1rem; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; border-bottom: 2px solid #0072B2; }
.lead { border-left: 4px solid #0072B2; background: #f3f7fa; padding: 0.6rem 1rem; }
.lead p { margin: 0.4rem 0; }
.box { overflow-x: auto; margin: 0.5rem 0 1rem; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: 0.3rem 0; }
th, td { padding: 0.3rem 0.6rem; vertical-align: top; text-align: left;
  border-bottom: 1px solid #ddd; overflow-wrap: normal; }
th { border-bottom: 2px solid #888; }
td.number { text-align: right; white-space: nowrap; }
td.long { min-width: 16rem; }
figure { margin: 1rem 0; }
figure img { width: 100%; height: auto; }
figcaption, footer { font-size: 0.9rem; color: #555; }
code { font-size: 0.9rem; background: #f3f3f3; padding: 0 0.2rem; }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  .box { overflow: visible; }
  figure, tr, .lead { break-inside: avoid; }
  h2 { break-after: avoid; }
}
"""


@dataclass(frozen=True)
class Words:
    """A paragraph."""

    text: str

    def html(self) -> str:
        """The paragraph, escaped."""
        return f"<p>{escape(self.text)}</p>"


@dataclass(frozen=True)
class Listing:
    """Items below one another."""

    items: tuple[str, ...]

    def html(self) -> str:
        """A list; nothing for no items."""
        items = "".join(f"<li>{escape(item)}</li>" for item in self.items)
        return f"<ul>{items}</ul>" if items else ""


@dataclass(frozen=True)
class Code:
    """A command as it is typed."""

    text: str

    def html(self) -> str:
        """A paragraph of code."""
        return f"<p><code>{escape(self.text)}</code></p>"


@dataclass(frozen=True)
class Grid:
    """A table with its caption; cells that are numbers are aligned to the right."""

    caption: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def html(self) -> str:
        """The table in a box that scrolls on a narrow screen."""
        head = "".join(f'<th scope="col">{escape(h)}</th>' for h in self.headings)
        body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in self.rows)
        return (
            f'<div class="box" role="region" tabindex="0" aria-label="{escape(self.caption)}">'
            f"<table><caption>{escape(self.caption)}</caption>"
            f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
        )


def _cell(text: str) -> str:
    if len(text) < _LONG:
        name = ' class="number"' if _NUMBER.match(text) else ""
    else:
        name = ' class="long"'
    return f"<td{name}>{escape(text)}</td>"


@dataclass(frozen=True)
class Picture:
    """A figure as SVG text, in words for who cannot see it, and its caption."""

    svg: str
    alt: str
    caption: str

    def html(self) -> str:
        """The figure, its drawing as data in the page."""
        data = base64.b64encode(self.svg.encode("utf-8")).decode("ascii")
        return (
            f'<figure><img src="data:image/svg+xml;base64,{data}" alt="{escape(self.alt)}">'
            f"<figcaption>{escape(self.caption)}</figcaption></figure>"
        )


Part = Words | Listing | Code | Grid | Picture


@dataclass(frozen=True)
class Section:
    """A heading and what stands under it."""

    title: str
    parts: tuple[Part, ...]

    def html(self) -> str:
        """The section."""
        inner = "\n".join(part.html() for part in self.parts)
        return f"<section><h2>{escape(self.title)}</h2>\n{inner}\n</section>"


@dataclass(frozen=True)
class Page:
    """Title, the conclusion before all else, sections, and the last line."""

    title: str
    lead: tuple[str, ...]
    sections: Sequence[Section]
    foot: str = ""

    def html(self) -> str:
        """The whole document."""
        lead = "".join(f"<p>{escape(text)}</p>" for text in self.lead)
        sections = "\n".join(section.html() for section in self.sections)
        return (
            '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(self.title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
            f'<main>\n<h1>{escape(self.title)}</h1>\n<div class="lead">{lead}</div>\n'
            f"{sections}\n</main>\n<footer><p>{escape(self.foot)}</p></footer>\n</body>\n</html>\n"
        )


def write_page(page: Page, path: Path) -> None:
    """Write a page; beside its place and moved, so that no half file is left."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    part.write_text(page.html(), "utf-8")
    part.replace(path)
