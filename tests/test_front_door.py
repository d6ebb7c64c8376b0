"""What a stranger meets first: the lock, the README, the citation, the notebook sources."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path
from typing import Any

import nbformat
import pytest
import yaml

import wheelset
from wheelset.publishing.notebooks import Source, find_sources, upstream
from wheelset.publishing.parameters import parameters_model

ROOT = Path(__file__).parents[1]
SOURCES = find_sources(ROOT / "notebooks")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))


def by_stem(source: Source) -> str:
    return source.stem


class TestLock:
    text = (ROOT / "requirements.lock").read_text("utf-8")
    entries = re.split(r"\n(?=[A-Za-z0-9])", re.sub(r"^\s*#.*\n", "", text, flags=re.M).strip())

    def test_it_names_no_address(self):
        assert re.findall(r"\S*://\S*|^-.*|^\S+ @ .*", self.text, flags=re.M) == []

    def test_every_requirement_is_pinned_and_hashed(self):
        loose = [
            entry.splitlines()[0]
            for entry in self.entries
            if "==" not in entry or "--hash=sha256:" not in entry
        ]
        assert len(self.entries) > 50
        assert loose == []

    def test_it_covers_what_the_project_asks_for(self):
        asked = PROJECT["project"]["dependencies"] + PROJECT["dependency-groups"]["dev"]
        names = {re.split(r"[<>=!~ ;\[]", wish)[0].lower() for wish in asked}
        assert names - {entry.split("==")[0].lower() for entry in self.entries} == set()

    def test_no_other_lock_lies_about(self):
        assert not (ROOT / "uv.lock").exists()


class TestNotebookSources:
    def test_there_are_some(self):
        assert SOURCES

    @pytest.mark.parametrize("source", SOURCES, ids=by_stem)
    def test_they_carry_no_outputs(self, source):
        cells = code_cells(source)
        assert [cell.outputs for cell in cells if cell.outputs] == []
        assert [cell.execution_count for cell in cells if cell.execution_count] == []

    @pytest.mark.parametrize("source", SOURCES, ids=by_stem)
    def test_they_begin_with_a_title(self, source):
        first = nbformat.read(source.path, as_version=4).cells[0]
        assert (first.cell_type, first.source[:2]) == ("markdown", "# ")

    @pytest.mark.parametrize("source", SOURCES, ids=by_stem)
    def test_they_wait_for_notebooks_that_exist(self, source):
        assert source.stem not in upstream(source, SOURCES)

    @pytest.mark.parametrize("source", SOURCES, ids=by_stem)
    def test_no_parameters_without_a_study(self, source):
        tagged = [cell for cell in code_cells(source) if "parameters" in tags(cell)]
        assert len(tagged) == (source.study is not None)

    @pytest.mark.parametrize("source", [s for s in SOURCES if s.study], ids=by_stem)
    def test_the_parameters_cell_is_the_studys_model(self, source):
        first = code_cells(source)[0]
        assert "parameters" in tags(first)
        model = parameters_model(source)
        assert model is not None
        expected = {name: field.get_default() for name, field in model.model_fields.items()}
        assert annotated_assignments(first.source) == expected
        assert model.model_config["extra"] == "forbid"
        assert [name for name, field in model.model_fields.items() if not field.description] == []

    def test_the_contents_list_every_notebook(self):
        toc = (ROOT / "_toc.yml").read_text("utf-8")
        listed = set(re.findall(r"book/executed/(\S+)", toc))
        assert {source.stem for source in SOURCES} - listed == set()


def code_cells(source: Source) -> list[Any]:
    cells = nbformat.read(source.path, as_version=4).cells
    return [cell for cell in cells if cell.cell_type == "code"]


def tags(cell: Any) -> list[str]:
    return cell.metadata.get("tags", [])


def annotated_assignments(code: str) -> dict[str, Any]:
    """Return the values of a cell made of `name: type = literal  # help` only."""
    values = {}
    for node in ast.parse(code).body:
        assert isinstance(node, ast.AnnAssign), f"not annotated: {ast.unparse(node)}"
        assert "#" in code.splitlines()[(node.end_lineno or node.lineno) - 1], "no help comment"
        values[ast.unparse(node.target)] = ast.literal_eval(node.value)
    return values


class TestPapers:
    def test_the_readme_shows_the_two_commands(self):
        readme = (ROOT / "README.md").read_text("utf-8")
        assert "make book" in readme
        assert "make test" in readme

    def test_every_target_of_the_readme_is_in_the_makefile(self):
        readme = (ROOT / "README.md").read_text("utf-8")
        targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), re.M))
        assert set(re.findall(r"make ([a-z-]+)(?=[ `,\n]*[#`])", readme)) <= targets

    def test_the_citation_is_complete(self):
        cff = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
        asked = {"cff-version", "message", "title", "authors", "version", "license", "references"}
        assert asked <= cff.keys()
        assert cff["references"][0]["doi"] == "10.1007/s11071-021-06373-8"
        assert cff["license"] == PROJECT["project"]["license"] == "BSD-3-Clause"

    def test_one_version(self):
        cff = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
        assert wheelset.__version__ == PROJECT["project"]["version"] == cff["version"]

    def test_two_licences(self):
        assert (ROOT / "LICENSE").read_text("utf-8").startswith("BSD 3-Clause")
        assert "CC-BY-4.0" in (ROOT / "LICENSE-TEXT").read_text("utf-8")

    def test_jupyter_book_executes_nothing(self):
        config = yaml.safe_load((ROOT / "_config.yml").read_text("utf-8"))
        assert config["execute"]["execute_notebooks"] == "off"
        assert config["only_build_toc_files"] is True
        assert "sphinx-mathjax-offline" in config["sphinx"]["extra_extensions"]
