"""The built pages as files: links, anchors, pictures, and nothing of this machine or of others."""

from __future__ import annotations

import functools
import re
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from bs4 import BeautifulSoup

from tests.book.conftest import ROOT, SITE, pages
from wheelset.publishing.clean import private_folders

LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}


@functools.cache
def soup(path: Path) -> BeautifulSoup:
    return BeautifulSoup(path.read_text("utf-8"), "html.parser")


@functools.cache
def anchors(path: Path) -> frozenset[str]:
    return frozenset(tag["id"] for tag in soup(path).find_all(id=True))


def leads_to(target: Path, fragment: str) -> bool:
    """Tell whether the file is there and, if it is a page, the place in it."""
    if target.suffix == ".html" and target.exists() and fragment:
        return fragment in anchors(target)
    return target.exists()


def name(path: Path) -> str:
    return path.relative_to(SITE).as_posix()


each_page = pytest.mark.parametrize("page", pages(), ids=name)
pytestmark = pytest.mark.usefixtures("site")


def test_there_is_a_front_page_that_leads_to_the_status(site):
    text = (site / "index.html").read_text("utf-8")
    target = re.search(r"url=([^\"']+)", text)
    assert target, "index.html leads nowhere"
    assert (site / target[1]).is_file()


def test_every_page_of_the_contents_is_there(site):
    from wheelset.publishing.layout import paper_edition
    from wheelset.publishing.site import pages as listed

    contents = listed(paper_edition(ROOT))
    assert [page for page in contents if not (site / f"{page}.html").is_file()] == []


@each_page
def test_local_links_lead_somewhere(page):
    dead = []
    for tag in soup(page).find_all("a", href=True):
        address = urlsplit(tag["href"])
        if address.scheme or address.netloc:
            continue
        target = (page.parent / unquote(address.path)).resolve() if address.path else page
        if not leads_to(target, unquote(address.fragment)):
            dead.append(tag["href"])
    assert dead == []


@each_page
def test_nothing_is_loaded_from_elsewhere(page):
    addresses = [
        tag.get(attribute, "") for kind, attribute in LOADED.items() for tag in soup(page)(kind)
    ]
    assert [address for address in addresses if re.match(r"(https?:)?//", address)] == []


@each_page
def test_pictures_say_what_they_show(page):
    poor = []
    for picture in soup(page).select("article img"):
        alt = picture.get("alt", "")
        if len(alt) < 8 or re.search(r"\.(png|svg)$|^<Figure|^/|_images", alt):
            poor.append((picture.get("src"), alt))
    assert poor == []


@each_page
def test_no_warning_or_error_is_shown(page):
    article = soup(page).select_one("article")
    assert article is not None
    boxes = article.select(".output.stderr, .output.traceback, .system-message, .problematic")
    assert [box.get_text()[:200] for box in boxes] == []


@each_page
def test_tables_have_headings(page):
    empty = [
        str(table)[:200]
        for table in soup(page).select("article table")
        if not table.select("th")
        or any(not th.get_text(strip=True) for th in table.select("thead th"))
    ]
    assert empty == []


@pytest.mark.parametrize("suffix", ["html", "ipynb", "json", "csv", "js", "svg"])
def test_no_file_names_a_folder_of_this_machine(site, suffix):
    private = [f"{folder}/" for folder in private_folders(ROOT)]
    private = [folder for folder in private if folder != "/"]
    seen = [
        name(path)
        for path in site.rglob(f"*.{suffix}")
        if any(
            re.search(rf"(?<![\w.]){re.escape(p)}", path.read_text("utf-8", "replace"))
            for p in private
        )
    ]
    assert seen == []
