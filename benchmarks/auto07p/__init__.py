"""AUTO-07p as a peer: the same symbolic model, printed as a Fortran problem, compiled and run.

``cases`` names the models, ``Peer`` runs them, ``lpc_curve`` does a whole study. Times are AUTO's
own: one thread, compiled beforehand, without its Python layer and without process starts.
"""

from benchmarks.auto07p.cases import Case, paper, toy
from benchmarks.auto07p.peer import Peer, lpc_curve
from benchmarks.auto07p.problem import Problem
from benchmarks.auto07p.program import AutoFailed, StartFailed, available
from benchmarks.auto07p.settings import Run, Settings

__all__ = [
    "AutoFailed",
    "Case",
    "Peer",
    "Problem",
    "Run",
    "Settings",
    "StartFailed",
    "available",
    "lpc_curve",
    "paper",
    "toy",
]
