"""The peer: AUTO's runs on one system, each with a table, AUTO's own time and its steps.

The model is not rescaled. AUTO's arclength is told the typical sizes (``Settings.scales``), but
its Newton tolerance is du/(1 + max |u|) < 1e-7, which for a wheelset in SI units is 0.1 um in a
few mm, and its differences step 1e-7 in every state. What that costs shows in its results.
"""

from __future__ import annotations

import dataclasses
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from benchmarks.auto07p.cases import Case
from benchmarks.auto07p.files import constants_text, iterations, read_table
from benchmarks.auto07p.fortran import PERIOD
from benchmarks.auto07p.problem import Problem
from benchmarks.auto07p.program import AutoFailed, StartFailed, execute
from benchmarks.auto07p.settings import Run, Settings

Window = Mapping[str, tuple[float, float]]
Constants = dict[str, object]

#: Rows of the table that starts the half-period form, and its amplitude in scaled units.
START_ROWS, START_AMPLITUDE = 401, 1e-2


@dataclass(frozen=True)
class Peer:
    """AUTO-07p on a problem, with settings. Every method starts from the run before it.

    ``stop`` gives windows by parameter; a run ends at their borders, located.
    """

    problem: Problem
    settings: Settings = field(default_factory=Settings)

    def using(self, **changes: Any) -> Peer:
        """The same problem with other settings."""
        return Peer(self.problem, dataclasses.replace(self.settings, **changes))

    def hopf(self, window: tuple[float, float]) -> Run:
        """The equilibrium 0 from one end of a window of the first parameter to its first Hopf
        point, which is the last row: HB. T is a period there only.
        """
        start, end = map(float, window)
        step = float(np.copysign(self.settings.step, end - start))
        constants = {"IPS": 1, "ICP": [1, PERIOD], "PAR": {1: start}, "DS": step, "STOP": ["HB1"]}
        return self._run("equilibrium", constants | self._ends({self.problem.free[0]: window}))

    def hopf_curve(self, hopf: Run, stop: Window) -> Run:
        """Hopf points in the first two parameters, both ways; GH and others are labelled."""
        constants = {"IPS": 1, "IRS": "HB1", "ISW": 2, "ICP": [1, 2, PERIOD]}
        return self._both_ways("hopf_curve", constants | self._ends(stop), hopf)

    def cycles(self, hopf: Run, stop: Window, half: bool = False) -> Run:
        """The branch of cycles born at a Hopf point; half: u(T/2) = -u(0) on half a period."""
        constants = self._form(half) | {"ICP": [1, PERIOD]}
        start = self._half_start(hopf, constants) if half else hopf
        chosen = {"IRS": "EP2" if half else "HB1"} | self._ends(stop)
        run = self._run("cycles", constants | chosen, start, half)
        return dataclasses.replace(run, preparation=start.seconds if half else 0.0)

    def lpc_curve(self, cycles: Run, stop: Window) -> Run:
        """The fold curve in the first two parameters, both ways from the first LP of a branch.

        Rows run along the curve. StartFailed if AUTO does not find the null vector.
        """
        order = [1, PERIOD, 2] if cycles.half else [1, 2, PERIOD]
        constants = self._form(cycles.half) | {"ISW": 2, "ICP": order}
        start = self._run("lpc_start", constants | {"IRS": "LP1"}, cycles, cycles.half)
        if (start.table["type"] == "MX").any():
            raise StartFailed(f"no null vector at the LPC; see {start.folder / 'fort.9'}")
        run = self._both_ways("lpc_curve", constants | {"IRS": "EP1"} | self._ends(stop), start)
        return dataclasses.replace(run, preparation=start.seconds)

    def _form(self, half: bool) -> Constants:
        return {"IPS": 4, "NBC": self.problem.system.n, "NINT": 1} if half else {"IPS": 2}

    def _ends(self, stop: Window) -> Constants:
        return {"UZSTOP": self.problem.slots({k: list(map(float, v)) for k, v in stop.items()})}

    def _half_start(self, hopf: Run, constants: Constants) -> Run:
        """Two steps from a small ellipse in the critical plane: AUTO starts IPS = 4 from a table
        of points, which is no solution yet, and looks for no LP or BP on the way.
        """
        [(_, row)] = hopf.table[hopf.table["type"] == "HB"].iterrows()
        values = {1: float(row[self.problem.free[0]]), PERIOD: float(row["T"])}
        chosen = {"IRS": 0, "dat": "hopf", "PAR": values, "NMX": 3, "ILP": 0, "ISP": 0}
        folder = self._new_folder("half_start")
        np.savetxt(folder / "hopf.dat", self._ellipse(row))
        return self._execute(folder, constants | chosen, half=True)

    def _ellipse(self, hopf: pd.Series) -> np.ndarray:
        """Rows t, u of half a turn of Re(q exp(i w t)), |q| small in the scaled norm."""
        system, first = self.problem.system, self.problem.free[0]
        jacobian = system.jacobian(np.zeros(system.n), system.p(**{first: hopf[first]}))
        eigenvalues, modes = np.linalg.eig(jacobian)
        q = modes[:, np.argmin(abs(eigenvalues - 2j * np.pi / hopf["T"]))]
        scales = [self.settings.scales.get(name, 1.0) for name in system.state_names]
        t = np.linspace(0, 1, START_ROWS)
        orbit = (np.exp(1j * np.pi * t)[:, None] * q).real
        return np.column_stack([t, START_AMPLITUDE * orbit / np.linalg.norm(q / scales)])

    def _both_ways(self, name: str, constants: Constants, start: Run) -> Run:
        """Two runs from one point, joined to one curve whose rows run from end to end."""
        back, forth = (
            self._run(name, constants | {"DS": sign * self.settings.step}, start, start.half)
            for sign in (-1, 1)
        )
        sums = ("seconds", "wall", "cpu", "steps", "iterations")
        return dataclasses.replace(
            forth,
            table=pd.concat([back.table[:0:-1], forth.table], ignore_index=True),
            **{what: getattr(back, what) + getattr(forth, what) for what in sums},
        )

    def _run(
        self, name: str, constants: Constants, start: Run | None = None, half: bool = False
    ) -> Run:
        folder = self._new_folder(name)
        if start:
            shutil.copy(start.folder / "fort.8", folder / "fort.3")
        return self._execute(folder, constants, half)

    def _new_folder(self, name: str) -> Path:
        return Path(tempfile.mkdtemp(prefix=f"{name}_", dir=self.problem.folder))

    def _execute(self, folder: Path, constants: Constants, half: bool) -> Run:
        problem = self.problem
        common = self.settings.constants(problem.system.state_names, problem.free)
        (folder / "fort.2").write_text(constants_text(common | constants), "ascii")
        timed = execute(problem.half if half else problem.full, folder)
        table = problem.named(read_table(folder / "fort.7"))
        if table.isna().any(axis=None):
            raise AutoFailed(
                f"no number from point {table.isna().any(axis=1).argmax()} on: {folder}"
            )
        return Run(
            table=table,
            seconds=timed.own,
            wall=timed.wall,
            cpu=timed.cpu,
            steps=len(table) - 1,
            iterations=iterations(folder / "fort.9"),
            folder=folder,
            half=half,
        )


def lpc_curve(case: Case, folder: Path, half: bool = False, **settings: Any) -> pd.DataFrame:
    """The fold curve of a case's cycles, from end to end: columns type, the two parameters, T.

    settings: fields of Settings.
    """
    first, second = case.free
    peer = Peer(Problem(case.system, folder, case.free), Settings(scales=case.scales, **settings))
    cycles = peer.cycles(peer.hopf(case.start), {first: case.window}, half=half)
    curve = peer.lpc_curve(cycles, {second: case.curve})
    return curve.table[["type", first, second, "T"]]
