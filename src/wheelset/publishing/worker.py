"""The process in which one notebook runs: `python -m wheelset.publishing.worker`.

papermill changes the working folder of its process, so every notebook gets a process of its own.
Progress goes to stdout as lines `done/total`; why it stopped goes to stderr.
"""

from __future__ import annotations

import json
import sys

import papermill
from papermill.exceptions import PapermillExecutionError

_STOPPED = 3


def main(arguments: list[str]) -> int:
    """Execute `[source, target, parameters as JSON]` in the current folder; return an exit code."""
    source, target, parameters = arguments
    try:
        papermill.execute_notebook(
            source,
            target,
            parameters=json.loads(parameters),
            kernel_name="python3",
            language="python",
            progress_bar={"file": sys.stdout, "bar_format": "{n}/{total}", "mininterval": 0},
            start_timeout=180,
        )
    except PapermillExecutionError as error:
        sys.stderr.write(f"cell {error.exec_count}: {error.ename}: {error.evalue}\n")
        return _STOPPED
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
