"""Speed of the front door: right-hand side with Jacobian, one Hopf point with FLC, import.

Every figure is a median of repeated runs beside a peer measured in the same run: numpy arrays with
a finite-difference Jacobian for the kernel, a bare ``import numpy`` for the package's import.
Run with ``make bench``; the result is printed and stored in ``benchmarks/results``.
"""

from __future__ import annotations

import json
import platform
import statistics
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np

from wheelset.bifurcation.equilibria.hopf import hopf_point, instabilities
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle

RESULTS = Path(__file__).parent / "results" / "front_door.json"
POINTS = 160
STEP = 1e-7


def median_seconds(call: Callable[[], object], repeats: int = 41, inner: int = 5) -> float:
    call()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        for _ in range(inner):
            call()
        times.append((perf_counter() - start) / inner)
    return statistics.median(times)


def mesh_states() -> np.ndarray:
    phase = np.linspace(0, 2 * np.pi, POINTS, endpoint=False)
    amplitude = np.array([6e-3, 4e-3, 0.25, 0.16])
    return amplitude * np.cos(phase[:, None] + np.array([0, 1.2, np.pi / 2, 2.7]))


def array_peer(system: System, X: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """f and a forward-difference Jacobian from the numpy version of the same model."""
    names = [f"d{s}/dt" for s in system.state_names]

    def f(states: np.ndarray) -> np.ndarray:
        given = dict(zip(system.state_names, np.moveaxis(states, -1, 0), strict=True))
        return np.stack(list(system.quantities(names, **given).values()), axis=-1)

    base = f(X)
    shifted = f(X[None] + STEP * np.eye(4)[:, None, :])
    return base, np.moveaxis((shifted - base) / STEP, 0, -1)


def import_seconds(statement: str) -> float:
    def once() -> float:
        start = perf_counter()
        subprocess.run([sys.executable, "-c", statement], check=True)
        return perf_counter() - start

    return min(once() for _ in range(5))


def measure() -> dict[str, float]:
    system = hunting_system(load_vehicle("guo2021", overrides=["flange_law=exponential"]))
    X = mesh_states()
    kernel = median_seconds(lambda: system.evaluate(X))
    peer = median_seconds(lambda: array_peer(system, X))
    bare = import_seconds("pass")
    return {
        "kernel_us_per_point": kernel / POINTS * 1e6,
        "numpy_peer_us_per_point": peer / POINTS * 1e6,
        "kernel_times_faster_than_numpy": peer / kernel,
        "one_state_us": median_seconds(lambda: system.evaluate(X[0]), inner=200) * 1e6,
        "hopf_point_with_flc_ms": median_seconds(lambda: hopf_point(system, "v", 50.0)) * 1e3,
        "all_hopf_points_5_to_200_ms": median_seconds(
            lambda: instabilities(system, "v", (5.0, 200.0)), inner=1
        )
        * 1e3,
        "python_start_s": bare,
        "import_wheelset_s": import_seconds("import wheelset") - bare,
        "import_hunting_s": import_seconds("import wheelset.hunting") - bare,
        "import_numpy_peer_s": import_seconds("import numpy") - bare,
        "import_sympy_and_numba_peer_s": import_seconds("import sympy, numba") - bare,
    }


def main() -> None:
    figures = measure()
    for name, value in figures.items():
        print(f"{name:38s} {value:10.4g}")
    RESULTS.parent.mkdir(exist_ok=True)
    record = {"python": platform.python_version(), "machine": platform.machine(), **figures}
    RESULTS.write_text(json.dumps(record, indent=2) + "\n")
    print(f"stored in {RESULTS.relative_to(Path(__file__).parents[1])}")


if __name__ == "__main__":
    main()
