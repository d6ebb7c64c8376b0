"""Section 5's curves as rows of tables: what is drawn, generalised Hopf points, ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch
from wheelset.studies.lpc_curves import FoldScan
from wheelset.studies.section_rows import ends, gh_for, hopf_frame, labelled, special_frame


def curve_frame(scans: Sequence[FoldScan]) -> pd.DataFrame:
    """Both curves of every panel: panel, vehicle, parameter, curve (Hopf, LPC), value (SI), v m/s,
    flc, part (H-, H+, GH, LPC), point (letters of special points), amplitude m.
    """
    frames = [labelled(hopf_frame(s.hopf), s.labels) for s in scans if s.hopf is not None]
    frames += [labelled(_fold_frame(s.folds), s.labels) for s in scans if s.folds is not None]
    return pd.concat(frames, ignore_index=True)


def _fold_frame(folds: Branch) -> pd.DataFrame:
    table = folds.table(("max y",)).rename(columns={"max y": "amplitude"})
    table = table.rename(columns={folds.parameters[1]: "value"})
    frame = table[["value", "v", "amplitude", "point"]]
    return frame.assign(curve="LPC", part="LPC", flc=np.nan)


def gh_frame(scans: Sequence[FoldScan]) -> pd.DataFrame:
    """Generalised Hopf points of the Hopf curves, also those that no fold curve reaches.

    Columns: panel, vehicle, parameter, point, value (SI), v m/s, slc, inside.
    """
    frames = [
        labelled(special_frame(s.hopf.of_kind("GH")), s.labels) for s in scans if s.hopf is not None
    ]
    frame = pd.concat([f for f in frames if len(f)] or frames[:1], ignore_index=True)
    windows = {s.scan.panel: s.scan for s in scans}
    pairs = zip(frame["panel"], frame["value"], strict=True)
    return frame.assign(inside=[windows[name].shows(value) for name, value in pairs])


def printed_gh(scans: Sequence[FoldScan], wanted: Sequence[tuple[str, float]]) -> pd.DataFrame:
    """What was found for generalised Hopf points (parameter, value); see ``gh_for``."""
    words = {
        s.scan.parameter: "searched from {:.6g} to {:.6g}".format(*s.scan.searched) for s in scans
    }
    return gh_for(gh_frame(scans), wanted, words)


def end_frame(scans: Sequence[FoldScan]) -> pd.DataFrame:
    """Where and why every fold curve ends.

    Columns: panel, vehicle, parameter, low, low_v, high, high_v (SI), words.
    """
    return pd.DataFrame([_ends(s) for s in scans])


def _ends(s: FoldScan) -> dict[str, object]:
    if s.folds is None:
        return {**s.labels, "words": s.words}
    (low, low_words), (high, high_words) = ends(s.folds)
    points = [f"{point.kind} at {point.values[1]:.6g}" for point in s.folds.special]
    found = f"; special points: {', '.join(points)}" if points else ""
    return {
        **s.labels,
        "low": float(low[1]), "low_v": float(low[0]),
        "high": float(high[1]), "high_v": float(high[0]),
        "words": f"low end: {low_words}; high end: {high_words}{found}",
    }  # fmt: skip
