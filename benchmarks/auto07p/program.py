"""Finding, compiling and running AUTO-07p, without its Python layer.

AUTO is a set of object files that a problem is linked with; the program then reads constants from
``fort.2`` and solutions from ``fort.3``, and writes a table to ``fort.7``, solutions to ``fort.8``
and a log to ``fort.9``. It gets one thread.
"""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

#: The optimisation Debian's package sets for problems.
FLAGS = ("-O2", "-std=legacy", "-fopenmp", "-w")


class AutoFailed(RuntimeError):
    """AUTO-07p is absent or gave no usable table; the message carries its last words."""


class StartFailed(AutoFailed):
    """The run that builds the null vector of a fold curve did not converge (it ended with MX).

    Whatever AUTO computes from there is not a fold curve.
    """


@dataclass(frozen=True)
class Timed:
    """One execution in seconds: AUTO's own clock from reading the constants to the last line
    written, the wall clock of the process, and its processor time.
    """

    own: float
    wall: float
    cpu: float


def objects() -> tuple[Path, ...]:
    """AUTO's object files, from $AUTO_DIR or where Debian puts them; none if it is absent."""
    root = Path(os.environ.get("AUTO_DIR", "/usr/lib/auto-07p"))
    return tuple(sorted((root / "lib").glob("*.o")))


def available() -> bool:
    """Whether AUTO-07p and a Fortran compiler are installed."""
    return bool(objects()) and shutil.which("gfortran") is not None


def build(source: Path) -> Path:
    """Compile and link a problem; returns the executable beside it."""
    if not available():
        raise AutoFailed("AUTO-07p and gfortran are needed: apt-get install auto-07p gfortran")
    executable = source.with_suffix(".exe")
    command = ["gfortran", *FLAGS, str(source), "-o", str(executable), *map(str, objects())]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise AutoFailed(f"{source.name} does not compile:\n{done.stderr[-2000:]}")
    return executable


def execute(executable: Path, folder: Path) -> Timed:
    """Run in a folder that holds fort.2, and fort.3 if it restarts."""
    start, cpu = perf_counter(), _children()
    done = subprocess.run(
        [str(executable)],
        cwd=folder,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    wall, cpu = perf_counter() - start, _children() - cpu
    own = re.search(r"Total Time\s+(\S+)", done.stdout)
    if done.returncode or own is None:
        words = [*done.stdout.splitlines()[-4:], *done.stderr.splitlines()[:4]]
        raise AutoFailed(f"no result in {folder}: " + " / ".join(filter(None, words)))
    return Timed(float(own[1]), wall, cpu)


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
