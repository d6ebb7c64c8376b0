"""Our cycles and fold curves against AUTO-07p, run live on the same model at AUTO's own points."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from benchmarks.auto07p import available, lpc_curve, paper, toy
from tests.bifurcation.test_auto07p import required
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle_start import Discretisation, cycle_from_hopf
from wheelset.bifurcation.equilibria.hopf import hopf_point

CASES = {"toy": toy, "paper a3": paper, "paper a1": lambda: paper("a1")}


@pytest.mark.parametrize("name", CASES)
def test_the_fold_curve_passes_through_autos_points(name, tmp_path):
    required(available(), "AUTO-07p")
    case = CASES[name]()
    fine = {"jacobian": True, "tolerance": 1e-10, "locate": 1e-7, "ntst": 20}
    peer = lpc_curve(case, tmp_path, half=True, **fine)
    first, other = case.free
    rows = peer[peer[other].between(*case.curve)].iloc[:: max(1, len(peer) // 8)]
    curve = ours(case)
    assert len(rows) >= 5
    for _, row in rows.iterrows():
        v, period = at(case, curve, row[other])
        assert v == pytest.approx(row[first], rel=1e-6)
        assert period == pytest.approx(row["T"], rel=1e-6)


def ours(case):
    """Our fold curve over the case's window of the second parameter."""
    first, other = case.free
    system = case.system
    start = cycle_from_hopf(
        system, hopf_point(system, first, 50.0), case.scales[first] * 50,
        discretisation=Discretisation(20, True),
    )  # fmt: skip
    branch = follow(start.problem, start.u, direction=start.tangent, windows={first: case.window})
    fold = branch.of_kind("LPC")[0]
    widths = (50.0, 10 * case.scales[other])
    begin = lpc_from_cycle(system, fold.solution, case.free, widths)
    return both_ways(
        begin.problem, begin.u, direction=begin.tangent, windows={other: case.curve}, steps=300
    )


def at(case, curve, value):
    """Speed and period of the fold with the second parameter at a value."""
    nearest = curve.points[int(np.abs(curve.values[:, 1] - value).argmin())].solution
    moved = {**nearest.parameters, case.free[1]: float(value)}
    cycle = dataclasses.replace(nearest, parameters=moved)
    start = lpc_from_cycle(case.system, cycle, case.free)
    return start.problem.values(start.u)[0], start.problem.space.split(start.u).period
