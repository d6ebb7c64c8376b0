"""AUTO's constants by words, and what a run gave."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from benchmarks.auto07p.fortran import PERIOD


@dataclass(frozen=True)
class Settings:
    """How AUTO steps and solves.

    ntst, ncol: mesh intervals and collocation points. adapt: the mesh moves every so many steps.
    tolerance: EPSL and EPSU of Newton's method. locate: EPSS of special points, along the curve;
        AUTO takes its tangent from the last two points, so that it may turn round at a point
        that is located more finely than Newton's error in the scaled norm, tolerance / scale.
    jacobian: hand AUTO the exact Jacobians (JAC = 1) instead of letting it take differences.
    step, least, largest: of the arclength. most: points at most.
    scales: typical size of a state or parameter, 1 if not named. AUTO's arclength is
        sqrt(sum thl dp^2 + int sum thu du^2); its weights are the inverse squares of these.
    """

    ntst: int = 40
    ncol: int = 4
    adapt: int = 3
    tolerance: float = 1e-7
    locate: float = 1e-5
    jacobian: bool = False
    step: float = 0.1
    least: float = 1e-5
    largest: float = 0.5
    most: int = 1000
    scales: Mapping[str, float] = field(default_factory=dict)

    def constants(self, states: Sequence[str], free: Sequence[str]) -> dict[str, object]:
        """Entries of a constants file; the period takes no part in the arclength."""
        weights = {name: float(size) ** -2 for name, size in self.scales.items()}
        return {
            "NDIM": len(states),
            "NTST": self.ntst,
            "NCOL": self.ncol,
            "IAD": self.adapt,
            "EPSL": self.tolerance,
            "EPSU": self.tolerance,
            "EPSS": self.locate,
            "JAC": int(self.jacobian),
            "DS": self.step,
            "DSMIN": self.least,
            "DSMAX": self.largest,
            "NMX": self.most,
            "NPR": 0,
            "MXBF": 0,
            "THU": {i: weights[name] for i, name in enumerate(states, 1) if name in weights},
            "THL": {PERIOD: 0.0}
            | {k: weights[name] for k, name in enumerate(free, 1) if name in weights},
        }


@dataclass(frozen=True)
class Run:
    """What a run gave.

    table: one row a point, columns type ("" or EP, HB, LP, BP, PD, TR, UZ, MX, ...), label, then
        parameters, the period T and AUTO's measures of the solution.
    seconds: AUTO's own time of the continuation. wall, cpu: of its processes, start included;
        cpu is the one to read on a busy machine.
    preparation: AUTO's own time of the short runs that made its starting data.
    steps, iterations: of the continuation; Newton's at located points are counted too.
    folder: where it lies, for a restart. half: in the half-period form.
    """

    table: pd.DataFrame
    seconds: float
    wall: float
    cpu: float
    steps: int
    iterations: int
    folder: Path
    preparation: float = 0.0
    half: bool = False

    @property
    def special(self) -> pd.DataFrame:
        """The labelled points."""
        return self.table[self.table["type"] != ""]

    @property
    def ms_a_step(self) -> float:
        """AUTO's own time a step, in ms."""
        return 1e3 * self.seconds / self.steps
