"""What notebook sources say about themselves."""

from __future__ import annotations

import pytest

from tests.publishing.conftest import write_notebook
from wheelset.publishing.errors import InputError
from wheelset.publishing.notebooks import find_source, find_sources, upstream


def test_the_facts_are_read(clone):
    (toy,) = find_sources(clone / "notebooks")
    assert (toy.stem, toy.study, toy.cells) == ("1_toy", "toy", 3)
    assert toy.outputs == ("results/1_toy/comparison.csv",)


@pytest.mark.parametrize("name", ["1_toy", "1_toy.ipynb", "1", "notebooks/1_toy.ipynb"])
def test_a_notebook_is_found_by_its_name_or_start(clone, name):
    assert find_source(clone / "notebooks", name).stem == "1_toy"


def test_a_notebook_that_is_not_there(clone):
    with pytest.raises(InputError, match="did you mean `1_toy`"):
        find_source(clone / "notebooks", "2_toy")


def test_a_misspelt_fact_is_refused(clone):
    path = write_notebook(clone / "notebooks" / "2_b.ipynb", ["1"], output=["x"])
    with pytest.raises(InputError, match="did you mean `outputs`"):
        find_sources(path.parent)


def test_the_star_stands_for_all_that_have_none(clone):
    folder = clone / "notebooks"
    write_notebook(folder / "0_status.ipynb", ["1"], after=["*"])
    write_notebook(folder / "9_end.ipynb", ["1"], after=["*", "0_status"])
    status, toy, end = find_sources(folder)
    assert upstream(toy, (status, toy, end)) == ()
    assert upstream(status, (status, toy, end)) == ("1_toy",)
    assert upstream(end, (status, toy, end)) == ("1_toy", "0_status")


def test_waiting_for_nobody_is_refused(clone):
    folder = clone / "notebooks"
    write_notebook(folder / "2_b.ipynb", ["1"], after=["1_tox"])
    sources = find_sources(folder)
    with pytest.raises(InputError, match="did you mean `1_toy`"):
        upstream(sources[1], sources)
