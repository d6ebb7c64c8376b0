"""Section 4: the Hopf speed over one coefficient of the contact geometry at a time, Fig. 7.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 4, Fig. 7.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.hopf_rows import first_hopf, stability_changes
from wheelset.studies.section_curves import ReadingsParameters, Scan, hopf_at, hopf_branch
from wheelset.studies.section_rows import ends, gh_for, hopf_frame, labelled, special_frame

#: Fig. 7's panels. Generalised Hopf points are searched far beyond what the panels show.
FIGURE_7: tuple[Scan, ...] = (
    Scan("a", "a1", (0.0, 3.0), (0.0, 80.0)),
    Scan("b", "a3", (-4e5, 4e5), (-4e5, 4e5)),
    Scan("c", "c1", (-2000.0, 3000.0), (-6000.0, 6000.0)),
    Scan("d", "c3", (-4e6, 4e6), (-1e8, 1e8)),
    Scan("e", "e1", (-1000.0, 1000.0), (-40e3, 60e3)),
    Scan("f", "e3", (-6e5, 6e5), (-4e8, 4e8)),
    Scan("g", "f1", (-1200.0, 1200.0), (-40e3, 60e3)),
    Scan("h", "f3", (-4e6, 4e6), (-4e8, 4e8)),
)

_POINTS = {"quick": 11, "paper": 61}


class Parameters(ReadingsParameters):
    """Parameters of the study of section 4's Hopf curves."""


@dataclass(frozen=True, eq=False)
class HopfScan:
    """A vehicle's Hopf curve over a panel's window, and over the window that is searched."""

    vehicle: str
    scan: Scan
    system: System
    drawn: Branch
    searched: Branch

    @property
    def labels(self) -> dict[str, str]:
        """What its rows begin with."""
        names = {"panel": self.scan.panel, "vehicle": self.vehicle}
        return {**names, "parameter": self.scan.parameter}


def hopf_scans(p: ReadingsParameters, vehicle: str | None = None) -> tuple[HopfScan, ...]:
    """Fig. 7's curves of a vehicle (default: the study's); none if it has no Hopf point."""
    name = vehicle or p.vehicle
    loaded = p.load(name)
    hopf = first_hopf(stability_changes(loaded, p.window))
    if hopf is None:
        return ()
    system = hunting_system(loaded)
    return tuple(_scanned(p, name, system, hopf, scan) for scan in FIGURE_7)


def _scanned(
    p: ReadingsParameters, vehicle: str, system: System, hopf: HopfPoint, scan: Scan
) -> HopfScan:
    value = system.values[scan.parameter]
    drawn, searched = (
        hopf_branch(system, hopf, scan.parameter, scan.around(value, wide), p.control)
        for wide in (False, True)
    )
    return HopfScan(vehicle, scan, system, drawn, searched)


def curve_frame(scans: Sequence[HopfScan]) -> pd.DataFrame:
    """Hopf curves over the panels' windows: panel, vehicle, parameter, then ``hopf_frame``'s."""
    return pd.concat([labelled(hopf_frame(s.drawn), s.labels) for s in scans], ignore_index=True)


def gh_frame(scans: Sequence[HopfScan]) -> pd.DataFrame:
    """Every generalised Hopf point found, inside the panels and outside.

    Columns: panel, vehicle, parameter, point, value (SI), v m/s, slc, inside.
    """
    frames = [
        labelled(special_frame(s.searched.of_kind("GH")), s.labels).assign(
            inside=[s.scan.shows(float(point.values[1])) for point in s.searched.of_kind("GH")]
        )
        for s in scans
    ]
    return pd.concat([f for f in frames if len(f)] or frames[:1], ignore_index=True)


def search_frame(scans: Sequence[HopfScan]) -> pd.DataFrame:
    """How far generalised Hopf points were searched, and the range of speeds inside the panel.

    Columns: panel, vehicle, parameter, lowest and highest m/s, found (inside the panel and in
    all), low and high (SI) with the words of each end.
    """
    return pd.DataFrame([_searched(s) for s in scans])


def _searched(s: HopfScan) -> dict[str, object]:
    speeds = s.drawn.values[:, 0]
    (low, low_words), (high, high_words) = ends(s.searched)
    points = s.searched.of_kind("GH")
    return {
        **s.labels,
        "lowest": float(speeds.min()),
        "highest": float(speeds.max()),
        "inside": sum(s.scan.shows(float(point.values[1])) for point in points),
        "found": len(points),
        "low": float(low[1]),
        "high": float(high[1]),
        "words": f"searched from {low[1]:.6g} ({low_words}) to {high[1]:.6g} ({high_words})",
    }


def speeds_at(s: HopfScan, values: Sequence[float]) -> pd.DataFrame:
    """Hopf points solved for at given values of the coefficient: value, v m/s, flc.

    Values beyond the ends of the curve are left out.
    """
    found = [(value, hopf_at(s.system, s.drawn, value)) for value in values]
    rows = [(value, hopf.value, hopf.lyapunov) for value, hopf in found if hopf is not None]
    return pd.DataFrame(rows, columns=["value", "v", "flc"])


def printed_gh(scans: Sequence[HopfScan], wanted: Sequence[tuple[str, float]]) -> pd.DataFrame:
    """What was found for generalised Hopf points (parameter, value); see ``gh_for``."""
    search = search_frame(scans)
    words = dict(zip(search["parameter"], search["words"], strict=True))
    return gh_for(gh_frame(scans), wanted, words)


def grid(p: ReadingsParameters, scan: Scan) -> NDArray[np.float64]:
    """Values of the coefficient spread evenly over the panel."""
    return np.linspace(*scan.window, _POINTS[p.resolution])
