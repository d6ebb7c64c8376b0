"""The built book, and a browser to read it with.

Both are skipped with a clear word where they are missing, unless WHEELSET_REQUIRE_BOOK=1 or
WHEELSET_REQUIRE_BROWSER=1 says that this must not happen. WHEELSET_BOOK names another folder of
built pages, for instance the quick preview's.
"""

from __future__ import annotations

import functools
import os
import shutil
import threading
from collections.abc import Iterator
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SITE = Path(os.environ.get("WHEELSET_BOOK", ROOT / "_build" / "html")).resolve()
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def pages() -> list[Path]:
    """Return every page with an article of its own."""
    made_by_sphinx = {"index.html", "genindex.html", "search.html"}
    found = (path for path in sorted(SITE.rglob("*.html")) if path.name not in made_by_sphinx)
    return [path for path in found if "_static" not in path.parts]  # the theme keeps parts there


def missing(what: str, variable: str, remedy: str) -> None:
    message = f"{what}: {remedy}"
    if os.environ.get(variable) == "1":
        pytest.fail(f"{message} ({variable}=1)")
    pytest.skip(message)


@pytest.fixture(scope="session")
def site() -> Path:
    if not (SITE / "index.html").is_file():
        missing("the book is not built", "WHEELSET_REQUIRE_BOOK", "run `make book`")
    return SITE


@pytest.fixture(scope="session")
def browser(site):
    playwright = pytest.importorskip("playwright.sync_api")
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        missing("no browser is installed", "WHEELSET_REQUIRE_BROWSER", "install chromium")
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield browser
        browser.close()


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *args: object) -> None:
        """Say nothing; the tests look at what the browser saw."""


@pytest.fixture(scope="session")
def origin(site) -> Iterator[str]:
    handler = functools.partial(Quiet, directory=str(site))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
