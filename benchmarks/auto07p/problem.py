"""A system written for AUTO in a folder, compiled once; AUTO's numbers against its names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TypeVar

import pandas as pd

from benchmarks.auto07p.fortran import PERIOD, problem
from benchmarks.auto07p.program import build
from wheelset.bifurcation.system import System

Value = TypeVar("Value")


@dataclass(frozen=True)
class Problem:
    """A system, the folder it is written to, and the parameters that may vary: the first is the
    one of branches and Hopf points. The other parameters' values are compiled in.
    """

    system: System
    folder: Path
    free: tuple[str, ...]

    @cached_property
    def full(self) -> Path:
        """The executable of the whole period, for equilibria and cycles."""
        return self._built("full", half=False)

    @cached_property
    def half(self) -> Path:
        """The executable of the half period, for odd cycles only."""
        return self._built("half", half=True)

    def _built(self, name: str, half: bool) -> Path:
        source = self.folder / f"{name}.f90"
        source.write_text(problem(self.system, self.free, half), "ascii")
        return build(source)

    def slots(self, values: Mapping[str, Value]) -> dict[int, Value]:
        """A mapping by the free parameters' names, as one by their numbers in PAR."""
        return {self.free.index(name) + 1: value for name, value in values.items()}

    def named(self, table: pd.DataFrame) -> pd.DataFrame:
        """AUTO's columns under the system's names; the period is T."""
        names = {f"PAR({k})": name for k, name in enumerate(self.free, 1)}
        names |= {"PERIOD": "T", f"PAR({PERIOD})": "T"}
        for i, name in enumerate(self.system.state_names, 1):
            names |= {f"U({i})": name, f"MAX U({i})": f"MAX {name}"}
        return table.rename(columns=names)
