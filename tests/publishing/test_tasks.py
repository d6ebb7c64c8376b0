"""Order, staleness and failure of jobs, without notebooks."""

from __future__ import annotations

import pytest

from wheelset.publishing.errors import BookError, NotebookError
from wheelset.publishing.tasks import Job, run_jobs


def made(done: list[str], name: str, *after: str, stale: bool = True, fails: str = "") -> Job:
    def act() -> None:
        if fails:
            raise NotebookError(fails)
        done.append(name)

    return Job(name, act, lambda: "never executed" if stale else None, after)


def test_a_job_waits_for_those_it_needs(tmp_path, listener):
    done: list[str] = []
    run_jobs(
        [made(done, "c", "a", "b"), made(done, "b", "a"), made(done, "a")],
        2,
        listener,
        tmp_path / "db",
    )
    assert done == ["a", "b", "c"]
    assert ("finished", "c") in listener.told
    assert "never executed" in listener.texts


def test_what_is_not_stale_is_left_alone(tmp_path, listener):
    done: list[str] = []
    run_jobs([made(done, "a", stale=False), made(done, "b", "a")], 2, listener, tmp_path / "db")
    assert done == ["b"]
    assert ("unchanged", "a") in listener.told


def test_a_failure_stops_what_needs_it_and_nothing_else(tmp_path, listener):
    done: list[str] = []
    jobs = [made(done, "bad", fails="cell 3: ZeroDivisionError"), made(done, "good")]
    with pytest.raises(BookError, match="cell 3: ZeroDivisionError") as caught:
        run_jobs([*jobs, made(done, "pages", "bad", "good")], 2, listener, tmp_path / "db")
    assert done == ["good"]
    assert "pages was not made: it needs bad" in str(caught.value)


def test_a_defect_in_a_job_is_not_hidden(tmp_path, listener):
    def act() -> None:
        raise KeyError("a defect")

    with pytest.raises(BookError, match="a defect"):
        run_jobs([Job("a", act, lambda: "stale")], 1, listener, tmp_path / "db")


def test_a_circle_is_named(tmp_path, listener):
    done: list[str] = []
    with pytest.raises(BookError):
        run_jobs([made(done, "a", "b"), made(done, "b", "a")], 2, listener, tmp_path / "db")
    assert done == []
