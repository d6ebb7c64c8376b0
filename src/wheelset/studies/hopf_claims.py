"""What section 4 says about Fig. 7 in words, each sentence measured on the curves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.studies.hopf_curves import HopfScan, grid, search_frame, speeds_at
from wheelset.studies.section_curves import ReadingsParameters
from wheelset.studies.section_rows import claim_frame, exponent, part_where

Row = tuple[object, ...]

#: A speed that moves less than this, m/s, stays the same; more than this, it varies noticeably.
SAME, NOTICEABLE = 0.01, 1.0

#: A speed that varies slowly stays within this part of itself over the whole panel.
SLOW = 0.10

#: The power of a1 that Table 3's own Hopf speeds follow from 0.05 to 0.35 is -0.552.
POWER = (-0.60, -0.50)
TABLE_3_A1 = (0.05, 0.35)


def figure_7_claims(p: ReadingsParameters, scans: Sequence[HopfScan]) -> pd.DataFrame:
    """Fig. 7's panels, columns as ``claim_frame``; none without curves."""
    if not scans:
        return claim_frame([])
    panels = {s.scan.panel: s for s in scans}
    search = search_frame(scans).set_index("panel")
    rows = [*_panel_a(p, panels["a"]), *_panel_b(p, panels["b"]), *_panel_c(p, panels["c"])]
    rows += [_spread(name, search) for name in "dfh"] + [_slow(name, search) for name in "eg"]
    counts = {"a": 0, "b": 1, "c": 2, "d": 0, "e": 0, "f": 0, "g": 0, "h": 0}
    rows += [_count(name, search, wanted) for name, wanted in counts.items()]
    return claim_frame(sorted(rows, key=lambda row: str(row[0])))


def _panel_a(p: ReadingsParameters, s: HopfScan) -> list[Row]:
    curve = speeds_at(s, grid(p, s.scan).tolist())
    table = speeds_at(s, TABLE_3_A1)
    falls = part_where(np.diff(curve["v"]) < 0)
    low, high = POWER
    return [
        ("Fig. 7: a", "falls with a1: part of the panel where it does", falls, "1", 1.0, 1.0),
        ("Fig. 7: a", "inversely: power of a1 from 0.05 to 0.35 (Table 3's own rows: -0.55)",
         exponent(table, "v"), "1", low, high),
    ]  # fmt: skip


def _panel_b(p: ReadingsParameters, s: HopfScan) -> list[Row]:
    curve = speeds_at(s, grid(p, s.scan).tolist())
    points = [float(point.values[1]) for point in s.drawn.of_kind("GH")]
    spread = float(np.ptp(curve["v"]))
    rows: list[Row] = [
        ("Fig. 7: b", "varies little: range of the speed in m/s", spread, "1", 0.0, SAME)
    ]
    if len(points) == 1:
        below = curve["value"] < points[0]
        rows += [
            ("Fig. 7: b", "supercritical below GH: part that is",
             part_where((curve["flc"][below] < 0).to_numpy()), "1", 1.0, 1.0),
            ("Fig. 7: b", "subcritical above: part that is",
             part_where((curve["flc"][~below] > 0).to_numpy()), "1", 1.0, 1.0),
        ]  # fmt: skip
    return rows


def _panel_c(p: ReadingsParameters, s: HopfScan) -> list[Row]:
    curve = speeds_at(s, grid(p, s.scan).tolist())
    if len(curve) < 3:
        raise NoConvergence(f"the Hopf curve over {s.scan.parameter} has {len(curve)} points", ())
    lowest, (low, high) = float(curve["value"].iloc[curve["v"].argmin()]), s.scan.window
    inside = min(lowest - low, high - lowest) / (high - low)
    spread = float(np.ptp(curve["v"]))
    return [
        ("Fig. 7: c", "varies noticeably: range of the speed in m/s", spread, "1", NOTICEABLE,
         np.inf),
        ("Fig. 7: c", "falls, then rises, as the axes say: distance of the lowest speed from the "
         "panel's sides as a part of its width", inside, "1", 0.05, 0.5),
    ]  # fmt: skip


def _spread(panel: str, search: pd.DataFrame) -> Row:
    spread = _measured(search, panel, "highest") - _measured(search, panel, "lowest")
    claim = f"stays the same with {_name(search, panel)}: range of the speed in m/s"
    return f"Fig. 7: {panel}", claim, spread, "1", 0.0, SAME


def _slow(panel: str, search: pd.DataFrame) -> Row:
    lowest, highest = (_measured(search, panel, end) for end in ("lowest", "highest"))
    claim = f"varies slowly with {_name(search, panel)}: range as a part of the speed"
    return f"Fig. 7: {panel}", claim, (highest - lowest) / highest, "1", SAME / highest, SLOW


def _count(panel: str, search: pd.DataFrame, wanted: int) -> Row:
    found = _measured(search, panel, "inside")
    claim = f"GH points inside the panel, {wanted} in the paper"
    return f"Fig. 7: {panel}", claim, found, "1", float(wanted), float(wanted)


def _name(search: pd.DataFrame, panel: str) -> str:
    return str(search["parameter"][panel])


def _measured(search: pd.DataFrame, panel: str, column: str) -> float:
    return float(search[column][panel])
