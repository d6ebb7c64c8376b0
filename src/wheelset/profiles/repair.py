"""Points of a profile put right: direction, order, duplicates, spikes, gaps; all is noted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.errors import ProfileError
from wheelset.profiles.orientation import oriented
from wheelset.profiles.points import Points
from wheelset.profiles.spikes import without_spikes

#: A back face: three points or more within so much in y, over so much in z, m.
FACE_WIDTH, FACE_HEIGHT = 1.5e-4, 2e-3

#: A sorted contour may be so much longer than the file's before the file's order is right.
LONGER = 1.02

#: Points closer than this in y are one, m; a gap wider than GAP is noted, than HOLE refused, m.
SAME, GAP, HOLE = 1e-8, 1.5e-3, 8e-3


def repaired(points: Points) -> Points:
    """Oriented, in order, without duplicates and spikes. Raises ProfileError for a hole."""
    points = _ascending(oriented(points))
    points = replace(points, face=_back_face(points)) if points.kind == "wheel" else points
    points = _without_duplicates(_graph(points))
    return _checked_gaps(without_spikes(points))


def _back_face(points: Points) -> float | None:
    """The innermost points, if they stand above one another."""
    face = points.y < points.y.min() + FACE_WIDTH
    if np.count_nonzero(face) < 3 or np.ptp(points.z[face]) < FACE_HEIGHT:
        return None
    return float(np.median(points.y[face]))


def _ascending(points: Points) -> Points:
    if points.y[-1] > points.y[0]:
        return points
    return points.noted(
        "points run from outside to inside: reversed", points.y[::-1], points.z[::-1]
    )


def _graph(points: Points) -> Points:
    """Ascending y: points out of order are sorted, an overhang is cut off."""
    back = np.diff(points.y) < 0
    if not back.any():
        return points
    order = np.argsort(points.y, kind="stable")
    y, z = points.y[order], points.z[order]
    if _length(y, z) <= LONGER * _length(points.y, points.z):
        return points.noted(f"{int(back.sum())} points out of order: sorted by y", y, z)
    first, last = int(points.y.argmin()), int(points.y.argmax())
    within = np.zeros(len(points.y), bool)
    if first < last:
        run = points.y[first : last + 1]
        within[first : last + 1] = run >= np.maximum.accumulate(run)
    if within.sum() < 0.5 * len(within):
        raise ProfileError("the points are in no order along the profile; sort them by y")
    lost = int((~within).sum())
    return points.only(within, f"{lost} points behind the widest place (overhang) left out")


def _length(y: Array, z: Array) -> float:
    return float(np.hypot(np.diff(y), np.diff(z)).sum())


def _without_duplicates(points: Points) -> Points:
    """Of points with one y, the outermost: the lowest of a wheel, the highest of a rail."""
    group = np.concatenate([[0], np.cumsum(np.diff(points.y) > SAME)])
    count = int(group[-1]) + 1
    if count == len(points.y):
        return points
    z = np.full(count, -np.inf if points.kind == "wheel" else np.inf)
    (np.maximum if points.kind == "wheel" else np.minimum).at(z, group, points.z)
    y = points.y[np.searchsorted(group, np.arange(count))]
    return points.noted(f"{len(points.y) - count} points of equal y merged", y, z)


def _checked_gaps(points: Points) -> Points:
    """A gap is a step much wider than those beside it: a steep flank has wide steps of its own."""
    across, step = np.diff(points.y), np.hypot(np.diff(points.y), np.diff(points.z))
    k = int(across.argmax())
    if across[k] > HOLE:
        raise ProfileError(
            f"a hole of {across[k] * 1e3:.1f} mm at y = {points.y[k] * 1e3:.1f} mm; no more than "
            f"{HOLE * 1e3:g} mm are bridged"
        )
    beside = np.maximum(step[:-2], step[2:])
    wide = np.flatnonzero((step[1:-1] > GAP) & (step[1:-1] > 2.5 * beside)) + 1
    if not len(wide):
        return points
    worst = wide[step[wide].argmax()]
    place = f"{step[worst] * 1e3:.1f} mm at y = {points.y[worst] * 1e3:.1f} mm"
    return points.noted(f"{len(wide)} gaps bridged, up to {place}")
