"""One notebook: run in its own process, checked, and only then put in its place."""

from __future__ import annotations

import datetime
import json
import os
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from wheelset.publishing.child import listen
from wheelset.publishing.clean import clean_copy
from wheelset.publishing.errors import NotebookError
from wheelset.publishing.layout import Layout
from wheelset.publishing.notebooks import Source
from wheelset.publishing.parameters import all_parameters
from wheelset.publishing.record import Record, environment, products, write_record

_LINES_OF_REASON = 12


def execute(
    source: Source,
    parameters: Mapping[str, Any],
    hashes: Mapping[str, str],
    layout: Layout,
    advanced: Callable[[int, int], None],
) -> Record:
    """Run `source` and publish its copy, its results and their record; or leave all as it was.

    Args:
        source: the notebook.
        parameters: what is injected into it, already checked.
        hashes: its fingerprint.
        layout: the folders of the edition.
        advanced: called with the numbers of cells done and in total.

    Raises:
        NotebookError: it stopped, wrote less than it declares, or shows a path of this machine.
    """
    started, clock = datetime.datetime.now(datetime.UTC), time.monotonic()
    layout.executed.mkdir(parents=True, exist_ok=True)
    with set_aside(layout.results_of(source.stem)):
        running = layout.executed / f".{source.stem}.running.ipynb"
        _run(source, running, parameters, layout, advanced)
        _check_outputs(source, layout)
        clean_copy(running, layout.root)
        running.replace(layout.copy_of(source.stem))
    layout.failed_copy_of(source.stem).unlink(missing_ok=True)
    record = Record(
        notebook=source.stem,
        parameters=all_parameters(source, parameters),
        fingerprint=dict(hashes),
        products=products(layout, source.stem),
        started=started.isoformat(timespec="seconds"),
        seconds=round(time.monotonic() - clock, 1),
        **environment(),
    )
    write_record(layout, record)
    return record


@contextmanager
def set_aside(folder: Path) -> Iterator[None]:
    """Give the body an empty place for `folder`; bring the old one back if the body fails."""
    old = folder.with_name(f".{folder.name}.before")
    shutil.rmtree(old, ignore_errors=True)
    if folder.exists():
        folder.replace(old)
    try:
        yield
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        if old.exists():
            old.replace(folder)
        raise
    shutil.rmtree(old, ignore_errors=True)


def _run(
    source: Source,
    target: Path,
    parameters: Mapping[str, Any],
    layout: Layout,
    advanced: Callable[[int, int], None],
) -> None:
    """Execute into `target`; on failure keep the partial copy aside and raise."""
    worker = [sys.executable, "-m", "wheelset.publishing.worker"]
    command = [*worker, str(source.path), str(target), json.dumps(dict(parameters))]
    with tempfile.TemporaryDirectory() as private, tempfile.TemporaryFile("w+") as errors:
        code = listen(
            command,
            partial(_follow, advanced),
            cwd=str(layout.executed),
            env=_environment(Path(private)),
            stderr=errors,
        )
        if code != 0:
            errors.seek(0)
            raise NotebookError(_keep_failed(source, target, layout, errors.read()))


def _follow(advanced: Callable[[int, int], None], line: str) -> None:
    if match := re.fullmatch(r"(\d+)/(\d+)", line):
        advanced(int(match[1]), int(match[2]))


def _environment(private: Path) -> dict[str, str]:
    """Return the environment of a notebook: this one, without a reader's personal settings."""
    plotting = find_spec("matplotlib")
    own = {
        "IPYTHONDIR": str(private),  # no personal start-up files, no history outside the clone
        "JUPYTER_RUNTIME_DIR": str(private),
        "JUPYTER_PREFER_ENV_PATH": "1",  # this environment's kernel, not a user's of the same name
        "OMP_NUM_THREADS": "1",  # sums must not depend on the number of cores
        "OPENBLAS_NUM_THREADS": "1",
        "PYTHONHASHSEED": "0",
    }
    if plotting and plotting.origin:  # figures must not depend on a reader's matplotlibrc
        own["MATPLOTLIBRC"] = str(Path(plotting.origin).parent / "mpl-data" / "matplotlibrc")
    return {**os.environ, **own}


def _keep_failed(source: Source, target: Path, layout: Layout, errors: str) -> str:
    # The kernel's own start-up notices are no reason.
    lines = [line for line in errors.strip().splitlines() if "[IPKernelApp]" not in line]
    reason = "\n".join(lines[-_LINES_OF_REASON:])
    if not target.exists():
        return f"{source.stem} could not be run: {reason}"
    aside = layout.failed_copy_of(source.stem)
    target.replace(aside)
    return f"{source.stem} stopped in {reason}\nThe partial copy is {aside}"


def _check_outputs(source: Source, layout: Layout) -> None:
    missing = [name for name in source.outputs if not (layout.executed / name).is_file()]
    if missing:
        raise NotebookError(
            f"{source.stem} ran to its end but did not write {', '.join(missing)}, "
            "which its metadata `wheelset.outputs` declares."
        )
