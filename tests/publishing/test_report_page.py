"""The page of a report: what is put in comes out escaped, whole, or not at all."""

from __future__ import annotations

import pytest

from wheelset.publishing.report_page import Code, Grid, Listing, Page, Section, Words, write_page

PAGE = Page(
    "a < b",
    ("first & last",),
    (
        Section(
            "parts",
            (
                Words("x < y"),
                Listing(("one", "two")),
                Listing(()),
                Code("do --it 'now'"),
                Grid("things", ("name", "value"), (("a", "−1.5"), ("b", "≤ 3"), ("c", "<&>"))),
            ),
        ),
    ),
)


def test_text_is_escaped():
    html = PAGE.html()
    assert "x &lt; y" in html
    assert "&lt;&amp;&gt;" in html
    assert "<title>a &lt; b</title>" in html


def test_numbers_are_aligned_and_texts_are_not():
    html = PAGE.html()
    assert '<td class="number">−1.5</td>' in html
    assert '<td class="number">≤ 3</td>' in html
    assert "<td>a</td>" in html


def test_a_list_of_nothing_is_left_out():
    assert PAGE.html().count("<ul>") == 1


def test_a_page_that_cannot_be_made_leaves_the_old_one(tmp_path, monkeypatch):
    target = tmp_path / "page.html"
    write_page(PAGE, target)
    before = target.read_bytes()

    def broken(self):
        raise ValueError("no page")

    monkeypatch.setattr(Page, "html", broken)
    with pytest.raises(ValueError, match="no page"):
        write_page(PAGE, target)
    assert target.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
