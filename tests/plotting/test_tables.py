"""Tables of the book."""

from __future__ import annotations

import math

import pandas as pd

from wheelset.plotting.tables import Table, exact, link
from wheelset.plotting.verdicts import comparison_table, number, signed
from wheelset.published.comparison import compare
from wheelset.published.items import items_of

FRAME = pd.DataFrame({"a": ["x < y", None], "b": [-1.5, math.nan], "c": [1, 2]})


def test_a_table_has_no_index_escapes_text_and_scrolls_in_its_box():
    html = Table(FRAME, {"a": "text", "b": "number"}, "an example", {"b": ".2f"})._repr_html_()
    assert html.count("<th") == 2 + 1  # the third one is thead
    assert "x &lt; y" in html
    assert "−1.50" in html
    assert html.count(">–<") == 2
    assert 'tabindex="0"' in html
    assert "overflow-x:auto" in html


def test_verdicts_carry_their_word():
    table = compare(items_of("Table 2")[:1], {("Table 2: case 1, none", "hopf_speed"): 52.29})
    html = comparison_table(table, "one row")._repr_html_()
    assert '<span class="verdict-agree">agrees</span>' in html


def test_numbers_read_as_the_paper_prints_them():
    assert [number(x) for x in (52.29, -11.17, 1550.0, 1.6e11, 0.0003906, 0.0)] == [
        "52.29", "-11.17", "1550", "1.6e+11", "0.0003906", "0.00",
    ]  # fmt: skip
    assert [signed(x) for x in (0.0, 1e-5, -0.25, 36.7)] == ["0.00", "0.00", "-0.25", "+36.70"]
    assert [exact(x) for x in (1550.0, 0.226537, 6616287.34)] == ["1550", "0.226537", "6616287.34"]


def test_links_are_escaped():
    assert link("a & b", "page.html") == '<a href="page.html">a &amp; b</a>'
