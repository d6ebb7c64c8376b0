"""The book as a reader sees it: in a real browser, served and from the disk, wide and narrow."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe

from tests.book.conftest import ROOT, SITE, pages

# Known, harmless, and not ours: the theme declares a constant twice, and asks for its mode.
ALLOWED = ("Identifier 'THEBE_JS_URL' has already been declared", "Got invalid theme mode")
PHONE = {"width": 390, "height": 844}
DESK = {"width": 1280, "height": 900}
SHOTS = ROOT / "_build" / "screenshots"


def name(path: Path) -> str:
    return path.relative_to(SITE).as_posix()


each_page = pytest.mark.parametrize("page", pages(), ids=name)


class Visit:
    """One page in one window, and everything it asked for or complained about."""

    def __init__(self, tab, address: str) -> None:
        self.tab = tab
        self.asked: list[str] = []
        self.said: list[str] = []
        tab.on("request", lambda request: self.asked.append(request.url))
        tab.on("response", lambda r: r.status < 400 or self.said.append(f"{r.status} {r.url}"))
        tab.on("requestfailed", lambda request: self.said.append(f"failed {request.url}"))
        tab.on("console", lambda m: m.type != "error" or self.said.append(m.text))
        tab.on("pageerror", lambda error: self.said.append(str(error)))
        tab.goto(address, wait_until="load")
        tab.wait_for_function(
            "!document.querySelector('.math') || "
            "(window.MathJax && MathJax.startup && MathJax.startup.promise)"
        )
        tab.evaluate(
            "window.MathJax && MathJax.startup ? MathJax.startup.promise.then(() => 0) : 0"
        )

    def complaints(self) -> list[str]:
        return [text for text in self.said if not any(known in text for known in ALLOWED)]

    def count(self, selector: str) -> int:
        return self.tab.locator(selector).count()


@contextmanager
def visit(browser, address: str, window=DESK, scheme="light") -> Iterator[Visit]:
    context = browser.new_context(viewport=window, color_scheme=scheme)
    try:
        yield Visit(context.new_page(), address)
    finally:
        context.close()


def is_sphinx_list(rule: str, html: str) -> bool:
    """Tell the one known fault of Sphinx: its bibliography is a list whose items are not."""
    return rule == "aria-required-children" and 'class="citation-list"' in html


def shoot(seen: Visit, page: Path, kind: str) -> None:
    """Keep a picture of the page, for a person to look at."""
    SHOTS.mkdir(parents=True, exist_ok=True)
    file = SHOTS / f"{name(page).removesuffix('.html').replace('/', '-')}-{kind}.png"
    seen.tab.screenshot(path=file, full_page=True)


def assert_well_shown(seen: Visit, origin: str) -> None:
    assert [url for url in seen.asked if not url.startswith((origin, "data:", "blob:"))] == []
    assert seen.complaints() == []
    formulas = seen.count("article .math")
    assert formulas == 0 or seen.count("article mjx-container") >= formulas
    assert seen.count("article mjx-merror") == 0
    raw = "Array.from(document.querySelectorAll('article .math')).map(e => e.innerText).join(' ')"
    assert "\\(" not in seen.tab.evaluate(raw)
    assert "\\frac" not in seen.tab.evaluate("document.querySelector('article').innerText")
    broken = "Array.from(document.images).filter(i => !i.naturalWidth).map(i => i.src)"
    seen.tab.evaluate("document.querySelectorAll('img').forEach(i => i.loading = 'eager')")
    seen.tab.wait_for_function("Array.from(document.images).every(i => i.complete)")
    assert seen.tab.evaluate(broken) == []


@each_page
def test_served(browser, origin, page):
    with visit(browser, f"{origin}/{name(page)}") as seen:
        assert_well_shown(seen, origin)
        shoot(seen, page, "wide")


@each_page
def test_from_the_disk(browser, site, page):
    with visit(browser, page.as_uri()) as seen:
        assert_well_shown(seen, site.as_uri())


@each_page
def test_on_a_phone_nothing_scrolls_sideways(browser, origin, page):
    with visit(browser, f"{origin}/{name(page)}", window=PHONE) as seen:
        shoot(seen, page, "phone")
        too_wide = seen.tab.evaluate("document.documentElement.scrollWidth - window.innerWidth")
        assert too_wide <= 0


@each_page
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_can_be_read_by_everyone(browser, origin, page, scheme):
    with visit(browser, f"{origin}/{name(page)}", scheme=scheme) as seen:
        seen.tab.evaluate(f"document.documentElement.dataset.theme = '{scheme}'")
        seen.tab.wait_for_timeout(300)  # colours fade from one theme to the other
        if scheme == "dark":
            shoot(seen, page, "dark")
        found = Axe().run(seen.tab).response["violations"]
        grave = [rule for rule in found if rule["impact"] in {"serious", "critical"}]
        where = [(rule["id"], node["html"][:150]) for rule in grave for node in rule["nodes"]]
        assert [place for place in where if not is_sphinx_list(*place)] == []


def test_the_front_page_leads_to_the_status(browser, origin):
    with visit(browser, f"{origin}/index.html") as seen:
        seen.tab.wait_for_url("**/*.html")
        seen.tab.wait_for_selector("article h1")


def test_the_search_page_answers(browser, origin):
    with visit(browser, f"{origin}/search.html?q=wheelset") as seen:
        seen.tab.wait_for_selector("#search-results li a", timeout=10_000)
        assert seen.complaints() == []
