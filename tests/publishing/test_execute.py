"""Running real notebooks: what is published, and what never is."""

from __future__ import annotations

import json

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from tests.publishing.conftest import PARAMETERS, write_notebook
from wheelset.publishing.book import make_book, run_notebook
from wheelset.publishing.clean import private_folders, refuse_machine_paths
from wheelset.publishing.errors import BookError, NotebookError
from wheelset.publishing.execute import execute, set_aside
from wheelset.publishing.notebooks import read_source


def test_a_run_publishes_copy_results_and_record(whole):
    told: list[tuple[int, int]] = []
    source = whole.sources[0]
    given = {"speed": 3.0}
    execute(source, given, whole.hashes(source), whole.layout, lambda *n: told.append(n))
    copy = whole.layout.copy_of("1_toy").read_text("utf-8")
    assert "twice the speed is 6.0" in copy
    assert str(whole.layout.root) not in copy
    assert (whole.layout.results_of("1_toy") / "comparison.csv").read_text() == "3.0,paper\n"
    record = json.loads(whole.layout.record_of("1_toy").read_text("utf-8"))
    assert record["parameters"] == {"speed": 3.0, "vehicle": "guo2021", "resolution": "paper"}
    assert set(record["products"]) == {"1_toy.ipynb", "results/1_toy/comparison.csv"}
    assert told[-1] == (4, 4)
    assert whole.why_stale("1_toy") is None
    assert not list(whole.layout.executed.glob(".*running*"))


def test_a_notebook_that_stops_replaces_nothing(whole):
    layout = whole.layout
    layout.results_of("1_toy").mkdir(parents=True)
    (layout.results_of("1_toy") / "comparison.csv").write_text("good", "utf-8")
    layout.copy_of("1_toy").write_text("good", "utf-8")
    half = 'from pathlib import Path\nPath("results/1_toy").mkdir()\n1 / 0'
    path = write_notebook(layout.sources / "1_toy.ipynb", [PARAMETERS, half], study="toy")
    with pytest.raises(NotebookError, match="ZeroDivisionError") as caught:
        execute(read_source(path), {}, {}, layout, lambda *n: None)
    assert layout.copy_of("1_toy").read_text("utf-8") == "good"
    assert (layout.results_of("1_toy") / "comparison.csv").read_text("utf-8") == "good"
    assert not layout.record_of("1_toy").exists()
    assert "ZeroDivisionError" in layout.failed_copy_of("1_toy").read_text("utf-8")
    assert "1_toy.failed.ipynb" in str(caught.value)


def test_a_promised_file_that_is_not_written(whole):
    path = whole.layout.sources / "1_toy.ipynb"
    write_notebook(path, ["1 + 1"], outputs=["results/1_toy/comparison.csv"])
    with pytest.raises(NotebookError, match="did not write results/1_toy"):
        execute(read_source(path), {}, {}, whole.layout, lambda *n: None)
    assert not whole.layout.copy_of("1_toy").exists()


class TestSetAside:
    @pytest.fixture
    def folder(self, tmp_path):
        folder = tmp_path / "results"
        folder.mkdir()
        (folder / "old.csv").write_text("old", "utf-8")
        return folder

    def test_the_body_starts_empty_and_its_work_stays(self, folder):
        with set_aside(folder):
            assert not folder.exists()
            folder.mkdir()
            (folder / "new.csv").write_text("new", "utf-8")
        assert [path.name for path in folder.iterdir()] == ["new.csv"]
        assert [path.name for path in folder.parent.iterdir()] == ["results"]

    @pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
    def test_the_old_comes_back_if_the_body_fails(self, folder, error):
        def fail() -> None:
            folder.mkdir()
            raise error

        with pytest.raises(error), set_aside(folder):
            fail()
        assert [path.name for path in folder.iterdir()] == ["old.csv"]


class TestMachinePaths:
    @pytest.mark.parametrize(
        ("text", "seen"),
        [
            ("wrote {root}/results/a.csv", True),
            ("wrote results/a.csv", False),
            ("wrote x{root}/a.csv", False),
            ("see {root}-other/a.csv", False),
        ],
    )
    def test_an_output_may_not_name_the_clone(self, tmp_path, text, seen):
        cell = new_code_cell(
            outputs=[new_output("stream", text=text.format(root=tmp_path.resolve()))]
        )
        notebook = new_notebook(cells=[cell])
        folders = private_folders(tmp_path)
        if seen:
            with pytest.raises(NotebookError, match="cell 1 shows a path"):
                refuse_machine_paths(notebook, "1_toy", folders)
        else:
            refuse_machine_paths(notebook, "1_toy", folders)


@pytest.mark.slow
def test_a_reader_runs_a_notebook_with_a_file_of_his_own(clone, listener):
    (clone / "my.toml").write_text("mass = 2", "utf-8")
    wishes = ["speed=5", "vehicle=my.toml"]
    page = run_notebook(clone, "1_toy", wishes, listener, here=clone, html=False)
    assert page.parent.parent == clone / "runs"
    assert page.parent.name.startswith("1_toy-")
    assert (page.parent / "inputs" / "my.toml").read_text("utf-8") == "mass = 2"
    notebook = nbformat.read(page, as_version=4)
    assert notebook.metadata.papermill.parameters == {"speed": 5.0, "vehicle": "inputs/my.toml"}
    assert not (clone / "book" / "executed").exists()


@pytest.mark.slow
def test_the_quick_edition_is_built_once_and_apart(clone, listener):
    front = make_book(clone, listener, quick=True)
    assert front == clone / "_build-quick" / "_build" / "html" / "index.html"
    page = front.parent / "book" / "executed" / "1_toy.html"
    assert "Quick preview" in page.read_text("utf-8")
    results = clone / "_build-quick" / "book" / "executed" / "results" / "1_toy"
    assert (results / "comparison.csv").read_text("utf-8") == "2.0,quick\n"
    assert not (clone / "book" / "executed").exists()
    listener.told.clear()
    make_book(clone, listener, quick=True)
    assert listener.told == [("unchanged", "1_toy"), ("unchanged", "the pages")]


@pytest.mark.slow
def test_a_warning_keeps_the_pages_from_being_replaced(clone, listener, layout):
    write_notebook(clone / "notebooks" / "1_toy.ipynb", ["1 + 1"])
    (clone / "book" / "prose.md").write_text("# Prose\n\n{ref}`nowhere`\n", "utf-8")
    toc = "format: jb-book\nroot: book/prose\n"
    (clone / "_toc.yml").write_text(toc, "utf-8")
    (clone / "_config.yml").write_text("only_build_toc_files: true\n", "utf-8")
    layout.site.mkdir(parents=True)
    (layout.site / "index.html").write_text("good", "utf-8")
    from wheelset.publishing.site import build_site

    with pytest.raises(BookError, match="nowhere"):
        build_site(layout, lambda *n: None)
    assert (layout.site / "index.html").read_text("utf-8") == "good"
