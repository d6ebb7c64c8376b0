"""What section 5 says about Fig. 8 in words, each sentence measured on the curves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import SpecialPoint
from wheelset.studies.lpc_curves import FoldScan, grid, sheet, speeds_at
from wheelset.studies.section_curves import ReadingsParameters
from wheelset.studies.section_rows import claim_frame, exponent, part_where

Row = tuple[object, ...]
Frames = Mapping[str, pd.DataFrame]

#: A speed that moves less than this, m/s, remains the same; up to LITTLE it changes a little; a
#: curve that moves more than LARGE varies significantly.
SAME, LITTLE, LARGE = 0.01, 0.1, 5.0

#: The fall of the linear critical speed over Fig. 8(c), m/s, that still is little.
FALL = 3.0

#: The power of a1 that Table 3's rows from 0.05 to 0.35 follow: -0.55 (Hopf) and -0.48 (LPC).
POWERS = {"v_lin": (-0.60, -0.50), "v_non": (-0.53, -0.43)}
TABLE_3_A1 = (0.05, 0.35)

#: A rise is sharp at first if its first tenth is this much steeper than the middle, and linear if
#: the curve leaves the straight line through its second half by less than this part of the rise.
SHARP, STRAIGHT = 1.5, 0.10

#: The least speed on the panel's axis, m/s, by panel.
AXIS = {"d": 50.6, "f": 51.4, "h": 51.0}

#: A fold this far below the axis, m/s, is tolerated: as far as the rule for LPC speeds goes.
BELOW = 0.5


def panel_speeds(p: ReadingsParameters, scans: Sequence[FoldScan]) -> dict[str, pd.DataFrame]:
    """Both critical speeds on an even grid of every panel, by panel."""
    return {s.scan.panel: speeds_at(s, grid(p, s.scan).tolist()) for s in scans}


def numbers(scans: Sequence[FoldScan]) -> dict[str, float]:
    """lpc_drop: fall of the LPC speed in percent as a1 goes from 0.05 to 0.15; lpc_change: its fall
    in m/s as c3 goes from -1e5 to 1e5. NaN where the fold does not reach.
    """
    panels = {s.scan.panel: s for s in scans}
    first, second = speeds_at(panels["a"], (0.05, 0.15))["v_non"]
    low, high = speeds_at(panels["d"], (-1e5, 1e5))["v_non"]
    return {"lpc_drop": 100 * (1 - second / first), "lpc_change": low - high}


def figure_8_claims(frames: Frames, scans: Sequence[FoldScan]) -> pd.DataFrame:
    """Fig. 8's panels, columns as ``claim_frame``; none without fold curves.

    frames: from ``panel_speeds``.
    """
    panels = {s.scan.panel: s for s in scans}
    if any(s.folds is None for s in scans):
        return claim_frame([])
    rows = [*_panel_a(panels["a"], frames["a"]), *_panel_b(frames["b"])]
    rows += [*_panel_c(panels["c"], frames["c"]), *_panel_d(frames["d"])]
    for name in "eg":
        rows += _rises(panels[name])
    for name in "fh":
        rows += _little(name, frames[name])
    rows += [_gh_inside(name, panels[name]) for name in "bc"]
    return claim_frame(sorted(rows, key=lambda row: str(row[0])))


def _panel_a(s: FoldScan, frame: pd.DataFrame) -> list[Row]:
    table, both = speeds_at(s, TABLE_3_A1), frame.dropna()
    gap = (both["v_lin"] - both["v_non"]).to_numpy()
    rows: list[Row] = [
        ("Fig. 8: a", f"{words} falls inversely with a1: its power from 0.05 to 0.35",
         exponent(table, column), "1", *POWERS[column])
        for column, words in (("v_lin", "the Hopf speed"), ("v_non", "the LPC speed"))
    ]  # fmt: skip
    closer = "the two get closer as a1 grows: part of the panel where they do"
    return [
        *rows,
        ("Fig. 8: a", closer, part_where(np.diff(gap) < 0), "1", 1.0, 1.0),
        ("Fig. 8: a", "the LPC speed is the lower one: part of the panel where it is",
         part_where(gap > 0), "1", 1.0, 1.0),
    ]  # fmt: skip


def _panel_b(frame: pd.DataFrame) -> list[Row]:
    folds = frame.dropna(subset=["v_non"])
    spread, moved = np.ptp(frame["v_lin"]), np.ptp(folds["v_non"])
    falls, grows = np.diff(folds["v_non"]) < 0, np.diff(frame["flc"]) > 0
    subcritical = (folds["flc"] > 0).to_numpy()
    return [
        ("Fig. 8: b", "the Hopf speed remains the same: range in m/s", spread, "1", 0.0, SAME),
        ("Fig. 8: b", "the LPC speed varies significantly: range in m/s", moved, "1", LARGE,
         np.inf),
        ("Fig. 8: b", "the larger a3, the smaller the LPC speed: part of the panel",
         part_where(falls), "1", 1.0, 1.0),
        ("Fig. 8: b", "and the larger the FLC: part of the panel", part_where(grows), "1", 1.0,
         1.0),
        ("Fig. 8: b", "LPC only with a positive FLC: part of the curve", part_where(subcritical),
         "1", 1.0, 1.0),
    ]  # fmt: skip


def _panel_c(s: FoldScan, frame: pd.DataFrame) -> list[Row]:
    assert s.folds is not None
    folds, right = frame.dropna(subset=["v_non"]), float(sheet(s.folds)[-1].values[1])
    fall = frame["v_lin"].iloc[0] - frame["v_lin"].iloc[-1]
    return [
        ("Fig. 8: c", "the LPC speed falls with c1: part of the curve",
         part_where(np.diff(folds["v_non"]) < 0), "1", 1.0, 1.0),
        ("Fig. 8: c", "significantly: range in m/s", np.ptp(folds["v_non"]), "1", LARGE, np.inf),
        ("Fig. 8: c", "the Hopf speed falls little: in m/s", fall, "1", 0.0, FALL),
        ("Fig. 8: c", "the LPC curve reaches c1 = 200, its last row of Table 3: it reaches",
         right, "1", 200.0, np.inf),
    ]  # fmt: skip


def _panel_d(frame: pd.DataFrame) -> list[Row]:
    folds = frame["v_non"].dropna()
    return [
        ("Fig. 8: d", "the LPC speed falls with c3: part of the panel",
         part_where(np.diff(folds) < 0), "1", 1.0, 1.0),
        _on_axis("d", folds),
    ]  # fmt: skip


def _little(name: str, frame: pd.DataFrame) -> list[Row]:
    folds = frame["v_non"].dropna()
    return [
        (f"Fig. 8: {name}", "the LPC speed changes a little: range in m/s", np.ptp(folds), "1",
         0.0, LITTLE),
        (f"Fig. 8: {name}", "the Hopf speed does not: range in m/s", np.ptp(frame["v_lin"]), "1",
         0.0, SAME),
        _on_axis(name, folds),
    ]  # fmt: skip


def _on_axis(name: str, folds: pd.Series) -> Row:
    below = max(0.0, AXIS[name] - float(folds.min()))
    claim = f"the axis from {AXIS[name]:g} m/s shows the LPC curve: it lies below by, in m/s"
    return f"Fig. 8: {name}", claim, below, "1", 0.0, 0.0, BELOW


def _rises(s: FoldScan) -> list[Row]:
    """Sharply, then linearly, up to GH where it coincides with the Hopf curve: panels e and g."""
    assert s.folds is not None
    name = f"Fig. 8: {s.scan.panel}"
    curve = np.array([point.values for point in sheet(s.folds)])
    speed, value = curve.T
    low, high = s.scan.window
    sharp, bent = _shape(value, speed)
    rises = part_where(np.diff(speed) > 0)
    rows: list[Row] = [
        (name, "the LPC speed rises: part of the curve", rises, "1", 1.0, 1.0),
        (name, "sharply at first: slope of the first tenth over that of the middle", sharp, "1",
         SHARP, np.inf),
        (name, "then linearly: distance of the second half from a straight line, as a part of the "
         "rise", bent, "1", 0.0, STRAIGHT),
    ]  # fmt: skip
    return [*rows, *_end(name, s.gh, (value[-1], speed[-1]), (low, high))]


def _end(
    name: str, gh: Sequence[SpecialPoint], last: tuple[float, float], window: tuple[float, float]
) -> list[Row]:
    """The curve's upper end, (coefficient, speed), is a GH point."""
    value, speed = last
    ends = [point for point in gh if abs(point.values[1] / value - 1) < 0.01]
    if not ends:
        return [(name, "ends in a GH point: number of its upper ends", 0, "1", 1.0, 1.0)]
    at, gap = float(ends[0].values[1]), abs(float(ends[0].values[0]) - speed)
    return [
        (name, "ends in a GH point inside the panel: at", at, "1", *window),
        (name, "coincides with the Hopf curve there: distance in m/s", gap, "1", 0.0, SAME),
    ]


def _shape(value: np.ndarray, speed: np.ndarray) -> tuple[float, float]:
    """How much steeper the first tenth is than the middle, and how bent the second half."""
    part = np.interp(np.linspace(value[0], value[-1], 201), value, speed)
    middle = (part[140] - part[60]) / 80
    half = part[100:]
    line = np.polyval(np.polyfit(np.arange(len(half)), half, 1), np.arange(len(half)))
    bent = float(np.abs(half - line).max() / (part[-1] - part[0]))
    return float((part[20] - part[0]) / 20 / middle), bent


def _gh_inside(name: str, s: FoldScan) -> Row:
    inside = sum(s.scan.shows(float(point.values[1])) for point in s.gh)
    return f"Fig. 8: {name}", "GH points inside the panel, 1 in the paper", inside, "1", 1.0, 1.0


def coefficient_for(s: FoldScan, speed: float) -> float | None:
    """The coefficient at which the fold has a speed, m/s, by interpolation; None out of reach."""
    if s.folds is None:
        return None
    curve = np.array([point.values for point in sheet(s.folds)])
    order = np.argsort(curve[:, 0])
    speeds, values = curve[order].T
    inside = speeds[0] <= speed <= speeds[-1]
    return float(np.interp(speed, speeds, values)) if inside else None
