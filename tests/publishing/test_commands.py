"""The commands `book` and `run` as a reader types them."""

from __future__ import annotations

import subprocess
import sys

import pytest
from typer.testing import CliRunner

from wheelset import __version__
from wheelset.cli import app


@pytest.fixture
def typed(clone, monkeypatch):
    monkeypatch.chdir(clone)
    monkeypatch.setenv("COLUMNS", "200")
    return lambda *words: CliRunner().invoke(app, list(words))


def test_a_misspelt_parameter_is_refused_before_anything_runs(typed, clone):
    result = typed("run", "1_toy", "-p", "sped=3")
    assert result.exit_code == 2
    assert "did you mean `speed`?" in result.stderr
    assert "Traceback" not in result.output
    assert not (clone / "runs").exists()


def test_a_notebook_that_does_not_exist(typed):
    result = typed("run", "7_toy")
    assert result.exit_code == 2
    assert "1_toy" in result.stderr


def test_a_failure_of_the_book_is_not_the_readers(typed, clone):
    (clone / "_toc.yml").write_text("format: jb-book\nroot: book/nowhere\n", "utf-8")
    (clone / "notebooks" / "1_toy.ipynb").unlink()
    result = typed("book")
    assert result.exit_code == 1
    assert "book/nowhere" in result.stderr


def test_help_and_version(typed):
    assert typed("--version").stdout.strip() == __version__
    assert "name=value" in typed("run", "--help").stdout
    assert "--quick" in typed("book", "--help").stdout


def test_python_m_wheelset_is_the_console_script():
    command = [sys.executable, "-m", "wheelset", "--version"]
    assert subprocess.check_output(command, text=True).strip() == __version__
