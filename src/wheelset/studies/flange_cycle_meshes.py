"""What a solver reports that keeps a coarse mesh and knows no symmetry: section 3 once more.

The paper used MATCONT, which computes the full period on a number of intervals that the user fixes
(20 by default) and does not stop where the multipliers have lost their meaning. The same branches
are followed here in that manner; what does not survive refinement belongs to the mesh.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.curves.zero_problem import Finding, Point, Renewal
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import CycleCurve, CycleLinearisation, Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_from_flip,
    cycle_from_hopf,
)
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.hunting import hunting_system
from wheelset.studies.flange_cycles import Family, Parameters, case_vehicle, hopf_of

Array = NDArray[np.float64]

#: Intervals over the full period, and every how many steps they are equidistributed (0: never).
MESHES: tuple[tuple[int, int], ...] = ((20, 0), (40, 0), (20, 3), (40, 3), (80, 3))
QUICK_MESHES: tuple[tuple[int, int], ...] = ((20, 0), (40, 3))

#: Case and law of the branches that are followed again.
REPEATED = ((1, "reciprocal"), (2, "exponential"), (2, "reciprocal"))

#: Speeds followed, m/s, as far as refined branches go to be compared with; steps of a symmetric and
#: of an asymmetric branch.
WINDOW, STEPS = (45.0, 59.0), (200, 25)

#: Steps below this are not tried: nothing is to be learnt so close to a singularity.
CONTROL = StepControl(least=1e-3)

#: A point this near to one of the refined branch is that one, m/s; two of a kind are told apart.
SAME = 0.05


COLUMNS = ["case", "law", "family", "intervals", "adapted", "reach", "point", "v", "y"]


@dataclass(frozen=True, eq=False)
class Unguarded:
    """A curve of cycles that goes on where its Floquet multipliers are lost."""

    curve: CycleCurve

    @property
    def parameters(self) -> tuple[str, ...]:
        """As the curve's."""
        return self.curve.parameters

    @property
    def metric(self) -> Array:
        """As the curve's."""
        return self.curve.metric

    def values(self, u: Array) -> Array:
        """As the curve's."""
        return self.curve.values(u)

    def residual(self, u: Array) -> Array:
        """As the curve's."""
        return self.curve.residual(u)

    def linearised(self, u: Array) -> CycleLinearisation:
        """As the curve's."""
        return self.curve.linearised(u)

    def renewed(self, point: Point) -> Renewal:
        """As the curve's, unguarded again."""
        renewal = self.curve.renewed(point)
        return Renewal(Unguarded(renewal.problem), renewal.transfer)

    def tests(self, point: Point) -> Mapping[str, float]:
        """As the curve's, but for tori, of which print has none."""
        return {k: v for k, v in self.curve.tests(point).items() if k != "torus"}

    def classify(self, test: str, point: Point) -> Finding:
        """As the curve's."""
        return self.curve.classify(test, point)

    def solution(self, point: Point) -> Cycle:
        """As the curve's."""
        return self.curve.solution(point)

    def ended(self, point: Point) -> str:
        """Only where the cycle has shrunk to an equilibrium."""
        return "the cycle shrank to nothing" if self.curve.alignment(point.u) < 0 else ""


def mesh_frame(p: Parameters, families: tuple[Family, ...]) -> pd.DataFrame:
    """Special points of the branches of ``REPEATED`` on every mesh, beside the refined ones.

    families: the refined ones. Columns: case, law, family ("H", or "H BPC1": followed from the
    first symmetry breaking), intervals, adapted (whether the mesh follows the cycle), reach m
    (largest |y| of the branch), point, v m/s, y m (largest |y| there), refined m/s (the nearest
    point of the same letters of the same family, NaN: none), survives (whether it is that one).
    """
    rows = [row for case, law in REPEATED for row in _rows(p, case, law)]
    frame = pd.DataFrame(rows, columns=COLUMNS)
    frame["refined"] = np.array([_nearest(families, row) for row in frame.itertuples()], float)
    frame["survives"] = (frame["v"] - frame["refined"]).abs() <= SAME
    return frame


def _rows(p: Parameters, case: int, law: str) -> Iterator[dict[str, Any]]:
    for intervals, every in MESHES if p.resolution == "paper" else QUICK_MESHES:
        place = {"case": case, "law": law}
        mesh = {"intervals": intervals, "adapted": every > 0}
        for name, branch in _coarse(p, case, law, intervals, every):
            reach = _reach(max((q.solution for q in branch.points), key=_at_nodes))
            for special in branch.special:
                yield {**place, "family": name, **mesh, "reach": reach, **_point(special)}


def _point(special: SpecialPoint) -> dict[str, Any]:
    return {
        "point": special.kind, "v": float(special.values[0]), "y": _reach(special.solution),
    }  # fmt: skip


def _reach(cycle: Cycle) -> float:
    """Largest |y|, m."""
    low, high = cycle.extremes("y")
    return max(high, -low)


def _coarse(
    p: Parameters, case: int, law: str, intervals: int, every: int
) -> Iterator[tuple[str, Branch]]:
    """The symmetric branch over its full period, and the asymmetric one it sends off."""
    vehicle = case_vehicle(p, case, law)
    system, hopf = hunting_system(vehicle), hopf_of(p, vehicle)
    width, mesh = WINDOW[1] - WINDOW[0], Meshing(every, None)
    full = Discretisation(intervals, False, mesh)
    yield "H", unguarded(cycle_from_hopf(system, hopf, width, discretisation=full), STEPS[0])
    half = replace(full, intervals=intervals // 2, half=True)
    branch = unguarded(cycle_from_hopf(system, hopf, width, discretisation=half), STEPS[0])
    for origin in branch.of_kind("BPC")[:1]:
        start = _flipped(system, origin, width, mesh)
        if start is not None:
            yield "H BPC1", unguarded(start, STEPS[1])


def unguarded(start: Start[CycleCurve], steps: int) -> Branch:
    """A branch from its start, whatever becomes of the multipliers."""
    return follow(
        Unguarded(start.problem), start.u, direction=start.tangent, windows={"v": WINDOW},
        steps=steps, control=CONTROL, kind="cycles",
    )  # fmt: skip


def _flipped(
    system: Any, origin: SpecialPoint, width: float, mesh: Meshing
) -> Start[CycleCurve] | None:
    """Asymmetric cycles beside a symmetry breaking; None where a mesh leads to none."""
    try:
        return cycle_from_flip(system, origin.solution, "v", width, mesh=mesh)
    except NumericalOutcome:
        return None


def _at_nodes(cycle: Cycle) -> float:
    """Largest |y| at the nodes, m."""
    return float(np.abs(cycle.nodes[..., 0]).max())


def _nearest(families: tuple[Family, ...], row: Any) -> float:
    """Speed of the refined point of the same family and letters, m/s; NaN where there is none."""
    speeds = [
        float(special.values[0])
        for f in families
        if (f.case, f.law, f.name) == (row.case, row.law, row.family) and f.branch is not None
        for special in f.branch.of_kind(row.point)
    ]
    return min(speeds, key=lambda v: abs(v - row.v), default=np.nan)


def mesh_summary(points: pd.DataFrame) -> pd.DataFrame:
    """What survives refinement and what belongs to the mesh, one row a branch and mesh.

    Columns: case, law, family, adapted, intervals, survive and spurious (letters and speeds),
    reach m (largest |y| of the branch).
    """
    keys = ["case", "law", "family", "adapted", "intervals"]
    rows = [
        {
            **dict(zip(keys, place, strict=True)),
            "survive": _listed(group[group["survives"]]),
            "spurious": _listed(group[~group["survives"]]),
            "reach": float(group["reach"].max()),
        }
        for place, group in points.groupby(keys, sort=False)
    ]
    return pd.DataFrame(rows, columns=[*keys, "survive", "spurious", "reach"])


def _listed(points: pd.DataFrame) -> str:
    return ", ".join(f"{row.point} {row.v:.2f}" for row in points.itertuples())
