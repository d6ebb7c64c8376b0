"""What a benchmark ran on, in words that name no machine, and one thread for everything."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import subprocess
from pathlib import Path

#: Numerical libraries read these when they are loaded, so they are set for a process of its own.
ONE_THREAD = {
    "NUMBA_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
}


def environment(**more: str) -> dict[str, str]:
    """This process's environment with one thread."""
    return {**os.environ, **ONE_THREAD, **more}


def described() -> dict[str, object]:
    """Processor, versions; no host name, no path."""
    return {
        "system": f"{platform.system()} {platform.machine()}",
        "processor": _processor(),
        "cores": os.cpu_count(),
        "threads": 1,
        "python": platform.python_version(),
        **{name: importlib.metadata.version(name) for name in ("numpy", "scipy", "numba")},
        "gfortran": _compiler(),
    }


def _processor() -> str:
    known = Path("/proc/cpuinfo")
    lines = known.read_text("ascii", "replace").splitlines() if known.is_file() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown"


def _compiler() -> str:
    command = ["gfortran", "-dumpfullversion"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
