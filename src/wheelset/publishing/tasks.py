"""The order of work: doit decides what runs, after what, several at a time.

doit is used as a library. Whether a job is up to date is the job's own answer (the hashes of
`wheelset.publishing.record`), so doit's data base carries nothing that could disagree with it.
Jobs run in threads; what is heavy in them runs in processes of their own.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from doit.cmd_base import TaskLoader2
from doit.doit_cmd import DoitMain
from doit.exceptions import BaseFail, TaskFailed, UnmetDependency
from doit.task import Task, dict_to_task

from wheelset.publishing.errors import BookError
from wheelset.publishing.progress import Progress


@dataclass(frozen=True)
class Job:
    """One thing to make.

    Attributes:
        name: what it is called in messages.
        act: makes it; raises BookError if it cannot.
        why_stale: says in words why it must be made, or None if it is as it should be.
        after: names of the jobs that must have ended well before.
    """

    name: str
    act: Callable[[], None]
    why_stale: Callable[[], str | None]
    after: tuple[str, ...] = ()


def run_jobs(jobs: Sequence[Job], processes: int, progress: Progress, database: Path) -> None:
    """Make all of `jobs` that are stale, `processes` at a time; go on past a failure.

    Args:
        jobs: what to make, in any order.
        processes: how many at once.
        progress: is told what happens.
        database: a file for doit's bookkeeping.

    Raises:
        BookError: at least one job failed; the message names every one with its reason.
    """
    database.parent.mkdir(parents=True, exist_ok=True)
    teller = _Teller({job.name: job for job in jobs}, progress)
    settings = {
        "dep_file": str(database),
        "backend": "json",
        "continue": True,
        "num_process": processes,
        "par_type": "thread",
        "reporter": teller,
        "verbosity": 2,
    }
    code = DoitMain(_Loader(jobs, settings), config_filenames=()).run(["run"])
    if teller.failures:
        raise BookError("\n".join(teller.failures))
    if code != 0:
        raise BookError(f"the order of work cannot be found: doit ended with code {code}.")


class _Loader(TaskLoader2):
    """Hands jobs to doit as its tasks."""

    def __init__(self, jobs: Sequence[Job], settings: dict[str, Any]) -> None:
        super().__init__()
        self.jobs, self.settings = jobs, settings

    def load_doit_config(self) -> dict[str, Any]:
        """Return doit's settings."""
        return self.settings

    def load_tasks(self, cmd: Any, pos_args: Any) -> list[Task]:
        """Return one task a job."""
        return [dict_to_task(_task(job)) for job in self.jobs]


def _task(job: Job) -> dict[str, Any]:
    def act() -> TaskFailed | None:
        try:
            job.act()
        except BookError as error:
            return TaskFailed(str(error))
        return None

    return {
        "name": job.name,
        "actions": [act],
        "task_dep": list(job.after),
        "uptodate": [lambda: job.why_stale() is None],
        "io": {"capture": False},  # capturing swaps sys.stdout, which threads share
    }


class _Teller:
    """Passes on what doit reports, in the words of `Progress`."""

    def __init__(self, jobs: dict[str, Job], progress: Progress) -> None:
        self.jobs, self.progress = jobs, progress
        self.clocks: dict[str, float] = {}
        self.failures: list[str] = []

    def initialize(self, tasks: Any, selected: Any) -> None:
        """Nothing to say before the first job."""

    def get_status(self, task: Task) -> None:
        """Nothing to say before the answer."""

    def execute_task(self, task: Task) -> None:
        """A job begins."""
        self.clocks[task.name] = time.monotonic()
        self.progress.started(task.name, self.jobs[task.name].why_stale() or "asked for")

    def add_success(self, task: Task) -> None:
        """A job ended well."""
        self.progress.finished(task.name, time.monotonic() - self.clocks[task.name])

    def skip_uptodate(self, task: Task) -> None:
        """A job had nothing to do."""
        self.progress.unchanged(task.name)

    def add_failure(self, task: Task, fail: BaseFail) -> None:
        """A job failed, or what it needs did."""
        message = fail.get_msg().strip()
        if isinstance(fail, UnmetDependency):
            message = f"{task.name} was not made: it needs {fail.message}"
        self.failures.append(message)
        self.progress.failed(task.name, message)

    def runtime_error(self, message: str) -> None:
        """The graph itself is wrong, for instance a circle."""
        self.failures.append(message)

    def cleanup_error(self, exception: BaseFail) -> None:
        """No job cleans up through doit."""

    def skip_ignore(self, task: Task) -> None:
        """No job can be ignored."""

    def teardown_task(self, task: Task) -> None:
        """No job tears down through doit."""

    def complete_run(self) -> None:
        """Everything has been said."""
