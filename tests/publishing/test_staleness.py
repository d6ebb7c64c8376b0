"""An executed copy may be published exactly as long as its record holds."""

from __future__ import annotations

from dataclasses import replace

import pytest

from wheelset.publishing.book import Edition, longest_first
from wheelset.publishing.errors import StaleError
from wheelset.publishing.fingerprint import hash_package
from wheelset.publishing.record import Record, environment, products, read_record, write_record
from wheelset.publishing.site import check_pages


@pytest.fixture
def published(whole):
    """Put a copy, a result and a record in place, as a run would."""
    layout = whole.layout
    layout.results_of("1_toy").mkdir(parents=True)
    (layout.results_of("1_toy") / "comparison.csv").write_text("2.0\n", "utf-8")
    layout.copy_of("1_toy").write_text("{}", "utf-8")
    record = Record(
        notebook="1_toy",
        parameters={},
        fingerprint=whole.hashes(whole.sources[0]),
        products=products(layout, "1_toy"),
        started="2026-01-01T00:00:00+00:00",
        seconds=1.0,
        **environment(),
    )
    write_record(layout, record)
    return whole


def test_a_fresh_copy_is_published(published):
    assert published.why_stale("1_toy") is None
    check_pages(published.layout, published.why_stale)


def test_the_longest_of_the_last_runs_goes_first(published):
    one = published.sources[0]
    never = replace(one, path=one.path.with_name("0_new.ipynb"))
    assert never.stem == "0_new"
    assert longest_first(published.layout, (never, one)) == (one, never)


def test_never_executed(whole):
    assert whole.why_stale("1_toy") == "never executed"


@pytest.mark.parametrize(
    ("file", "reason"),
    [
        ("notebooks/1_toy.ipynb", "changed: notebook"),
        ("package/physics/model.py", "changed: package"),
        ("package/physics/vehicle.toml", "changed: package"),
        ("requirements.lock", "changed: lock"),
        ("book/executed/1_toy.ipynb", "missing or altered: 1_toy.ipynb"),
        ("book/executed/results/1_toy/comparison.csv", "missing or altered: results/1_toy/"),
        ("book/executed/provenance/1_toy.json", "never executed"),
    ],
)
def test_whatever_it_was_computed_from_makes_it_stale(published, file, reason):
    path = published.layout.root / file
    path.write_text(path.read_text("utf-8") + "\n# touched", "utf-8")
    assert published.why_stale("1_toy").startswith(reason)
    with pytest.raises(StaleError, match="1_toy"):
        check_pages(published.layout, published.why_stale)


def test_a_new_file_of_the_package_makes_it_stale(published):
    (published.layout.package / "physics" / "new.toml").write_text("a = 1", "utf-8")
    assert published.why_stale("1_toy") == "changed: package"


def test_parameters_make_it_stale(published):
    other = Edition(published.layout, published.sources, {"1_toy": {"speed": 3.0}})
    assert other.why_stale("1_toy") == "changed: parameters"


def test_a_further_file_it_reads_makes_it_stale(published):
    reads = replace(published.sources[0], reads=("measured.json",))
    with_file = Edition(published.layout, (reads,), {"1_toy": {}})
    assert with_file.why_stale("1_toy") == "changed: measured.json"


def test_results_it_reads_make_it_stale(published):
    reads = replace(published.sources[0], after=("2_other",))
    other = replace(published.sources[0], path=published.layout.sources / "2_other.ipynb")
    waiting = Edition(published.layout, (reads, other), {"1_toy": {}, "2_other": {}})
    assert waiting.why_stale("1_toy") == "changed: results of 2_other"


def test_rooms_that_make_no_number_do_not_count(layout):
    before = hash_package(layout.package)
    for name in ("publishing/site.py", "cli/hunting.py", "physics/__pycache__/model.pyc"):
        path = layout.package / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("x = 1", "utf-8")
    assert hash_package(layout.package) == before


def test_a_page_without_a_source_is_refused(published):
    (published.layout.stage / "_toc.yml").write_text(
        "format: jb-book\nroot: book/executed/1_toy\nchapters:\n- file: book/nowhere\n", "utf-8"
    )
    with pytest.raises(StaleError, match="book/nowhere"):
        check_pages(published.layout, published.why_stale)


def test_a_record_names_no_machine(published):
    import socket

    text = published.layout.record_of("1_toy").read_text("utf-8")
    assert socket.gethostname() not in text
    assert str(published.layout.root) not in text
    assert read_record(published.layout.record_of("1_toy")).python
