"""Cold start: nothing compiled before; and memory. Each run is a process of its own."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from benchmarks.auto07p import Case, Problem
from benchmarks.engine.machine import environment

ROOT = Path(__file__).parents[2]


def cold_start(case: Case) -> dict[str, dict[str, float]]:
    """The study with empty caches, the same again with what the first run left in them, and what
    AUTO needs before it can start: both forms of the problem written and compiled.
    """
    with tempfile.TemporaryDirectory() as folder:
        cold, warm = (_process(Path(folder)) for _ in range(2))
        return {"cold": cold, "cached": warm, "auto": {"process_s": _compiled(case, Path(folder))}}


def _process(folder: Path) -> dict[str, float]:
    caches = {"WHEELSET_CACHE_DIR": str(folder / "own"), "NUMBA_CACHE_DIR": str(folder / "numba")}
    command = [sys.executable, "-m", "benchmarks.engine.child"]
    start = perf_counter()
    done = subprocess.run(
        command, cwd=ROOT, env=environment(**caches), capture_output=True, text=True, check=True
    )
    return {"process_s": perf_counter() - start, **json.loads(done.stdout)}


def _compiled(case: Case, folder: Path) -> float:
    start = perf_counter()
    problem = Problem(case.system, folder, case.free)
    assert problem.full.exists() and problem.half.exists()
    return perf_counter() - start
