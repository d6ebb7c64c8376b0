"""A process of its own, listened to line by line."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Sequence
from typing import IO


def listen(
    command: Sequence[str],
    heard: Callable[[str], None],
    *,
    cwd: str,
    env: dict[str, str],
    stderr: IO[str] | int,
) -> int:
    """Run `command`, pass each line of its stdout to `heard`, and return its exit code.

    Carriage returns end a line too, so a progress bar is heard as often as it is drawn. If the
    listener is interrupted the process ends with it.
    """
    with subprocess.Popen(
        command, cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=stderr, text=True
    ) as process:
        try:
            for line in process.stdout or ():
                heard(line.rstrip())
        except BaseException:
            process.terminate()
            raise
    return process.returncode
