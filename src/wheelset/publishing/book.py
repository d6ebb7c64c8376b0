"""The whole way: every stale notebook, then the pages; or one notebook for one reader."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from wheelset.publishing.errors import InputError
from wheelset.publishing.execute import execute
from wheelset.publishing.fingerprint import fingerprint, hash_file, hash_json
from wheelset.publishing.layout import Layout, paper_edition, quick_edition, reader_edition
from wheelset.publishing.notebooks import Source, find_source, find_sources, upstream
from wheelset.publishing.parameters import check_parameters, parameters_model, parse_assignments
from wheelset.publishing.progress import Progress
from wheelset.publishing.record import read_record, why_stale
from wheelset.publishing.site import build_site, check_pages, why_site_stale
from wheelset.publishing.stage import stage_quick, stage_reader
from wheelset.publishing.tasks import Job, run_jobs

SITE = "the pages"


@dataclass(frozen=True)
class Edition:
    """The notebooks of one edition of the book, and what is injected into them.

    Attributes:
        layout: its folders.
        sources: its notebooks.
        injected: parameters by name of the notebook.
    """

    layout: Layout
    sources: tuple[Source, ...]
    injected: Mapping[str, Mapping[str, Any]]

    def source(self, stem: str) -> Source | None:
        """Return the notebook called `stem`, or None."""
        return next((source for source in self.sources if source.stem == stem), None)

    def hashes(self, source: Source) -> dict[str, str]:
        """Return the fingerprint of `source` as of now."""
        before = upstream(source, self.sources)
        return fingerprint(source, self.injected[source.stem], self.layout, before)

    def why_stale(self, stem: str) -> str | None:
        """Return in words why the copy of `stem` may not be published, or None if it may."""
        source = self.source(stem)
        if source is None:
            return "there is no such notebook"
        return why_stale(self.layout, stem, self.hashes(source))


def edition(layout: Layout, *, quick: bool) -> Edition:
    """Return the edition of `layout`; a quick one asks every study for its coarse resolution."""
    sources = find_sources(layout.sources)
    injected = {source.stem: _coarse(source) if quick else {} for source in sources}
    return Edition(layout, sources, injected)


def _coarse(source: Source) -> dict[str, Any]:
    model = parameters_model(source)
    has = model is not None and "resolution" in model.model_fields
    return check_parameters(source, {"resolution": "quick"}) if has else {}


def make_book(root: Path, progress: Progress, *, quick: bool = False, processes: int = 2) -> Path:
    """Execute what is stale, build the pages, and return the path of `index.html`.

    Raises:
        BookError: a notebook or the pages failed; nothing of them is published.
    """
    layout = quick_edition(root) if quick else paper_edition(root)
    if quick:
        layout.executed.mkdir(parents=True, exist_ok=True)
        stage_quick(layout)
    whole = edition(layout, quick=quick)
    ordered = longest_first(layout, whole.sources)
    notebooks = [_notebook_job(whole, source, progress) for source in ordered]
    jobs = [*notebooks, _site_job(whole, progress)]
    run_jobs(jobs, processes, progress, layout.executed / ".doit.json")
    return layout.site / "index.html"


def longest_first(layout: Layout, sources: Sequence[Source]) -> tuple[Source, ...]:
    """Return the sources by the time of their last runs, so that no long one is left for the end.

    Those that never ran keep their order, behind the others.
    """

    def seconds(source: Source) -> float:
        record = read_record(layout.record_of(source.stem))
        return record.seconds if record else 0.0

    return tuple(sorted(sources, key=seconds, reverse=True))


def _notebook_job(whole: Edition, source: Source, progress: Progress) -> Job:
    def act() -> None:
        hashes = whole.hashes(source)
        advanced = partial(progress.advanced, source.stem)
        execute(source, whole.injected[source.stem], hashes, whole.layout, advanced)

    stale = partial(whole.why_stale, source.stem)
    return Job(source.stem, act, stale, upstream(source, whole.sources))


def _site_job(whole: Edition, progress: Progress) -> Job:
    def act() -> None:
        check_pages(whole.layout, whole.why_stale)
        build_site(whole.layout, partial(progress.advanced, SITE))

    stems = tuple(source.stem for source in whole.sources)
    return Job(SITE, act, partial(why_site_stale, whole.layout), stems)


def run_notebook(
    root: Path,
    name: str,
    assignments: Sequence[str],
    progress: Progress,
    *,
    here: Path,
    output: Path | None = None,
    html: bool = True,
) -> Path:
    """Run one notebook with a reader's parameters, in a folder of its own, and return its page.

    Args:
        root: the clone.
        name: the notebook, or the start of its name.
        assignments: `name=value` texts.
        progress: is told what happens.
        here: the folder from which files among the values are named.
        output: where to run; by default `runs/<notebook>-<hash of the parameters>`.
        html: build a page of it.

    Raises:
        InputError: the notebook or a parameter does not exist, or a value is out of range.
        BookError: the run failed.
    """
    source = find_source(root / "notebooks", name)
    if source.after:
        raise InputError(
            f"{source.stem} collects the results of other notebooks; use `wheelset book`."
        )
    values = check_parameters(source, parse_assignments(assignments))
    files = {key: here / text for key, text in values.items() if _names_file(here, text)}
    layout = reader_edition(root, output or root / "runs" / _run_name(source, values, files))
    stage_reader(layout, source)
    values |= {key: _bring(path, layout) for key, path in files.items()}
    job = _reader_job(source, values, layout, progress, html)
    run_jobs([job], 1, progress, layout.executed / ".doit.json")
    return layout.site / "index.html" if html else layout.copy_of(source.stem)


def _reader_job(
    source: Source, values: dict[str, Any], layout: Layout, progress: Progress, html: bool
) -> Job:
    advanced: Callable[[int, int], None] = partial(progress.advanced, source.stem)

    def act() -> None:
        execute(source, values, fingerprint(source, values, layout), layout, advanced)
        if html:
            # Links to other chapters lead nowhere in a book of one page: they may warn.
            build_site(layout, advanced, strict=False)

    return Job(source.stem, act, lambda: "asked for")


def _names_file(here: Path, value: Any) -> bool:
    return isinstance(value, str) and (here / value).is_file()


def _run_name(source: Source, values: Mapping[str, Any], files: Mapping[str, Path]) -> str:
    contents = {key: hash_file(path) for key, path in files.items()}
    return f"{source.stem}-{hash_json([dict(values), contents])[:8]}"


def _bring(path: Path, layout: Layout) -> str:
    """Copy a reader's file into the folder of the run, so that the run names no other folder."""
    inputs = layout.executed / "inputs"
    inputs.mkdir(exist_ok=True)
    shutil.copy2(path, inputs / path.name)
    return f"inputs/{path.name}"
