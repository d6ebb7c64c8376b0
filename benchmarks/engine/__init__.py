"""Speed and accuracy of the bifurcation engine beside AUTO-07p, on the same problems in one run.

``python -m benchmarks engine`` runs it, in a process of its own with one thread; the record goes
to ``benchmarks/results/engine.json``, and the book draws it.
"""

from __future__ import annotations

import subprocess
import sys

from benchmarks.engine.machine import environment

#: Rounds that are counted; one more before them is not.
ROUNDS = 5


def main() -> None:
    command = [sys.executable, "-m", "benchmarks.engine", str(ROUNDS)]
    subprocess.run(command, env=environment(), check=True)
