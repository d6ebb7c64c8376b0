"""Which way a measured profile lies: flange or gauge side at negative y, z down."""

from __future__ import annotations

import numpy as np

from wheelset.profiles.errors import ProfileError
from wheelset.profiles.points import Points

#: A flange or a rail's corners stand out at least so far, m: otherwise the profile has no side.
STANDS_OUT = 4e-3

#: Width of the chamfer at a wheel's outer rim, m.
CHAMFER = 6e-3


def oriented(points: Points) -> Points:
    """Flange side or gauge side at negative y, z down, found from the shape itself."""
    return _oriented_wheel(points) if points.kind == "wheel" else _oriented_rail(points)


def _oriented_wheel(points: Points) -> Points:
    """The flange is what stands out most from the tread, short of the chamfer at the rim."""
    out = points.z - np.median(points.z)
    rim = CHAMFER if np.ptp(points.y) > 6 * CHAMFER else 0.0
    inner = (points.y > points.y.min() + rim) & (points.y < points.y.max() - rim)
    sign = 1.0 if out[inner].max() >= -out[inner].min() else -1.0
    if abs(out).max() < STANDS_OUT:
        raise ProfileError(
            f"no flange: the profile is flat to {abs(out).max() * 1e3:.1f} mm, so that its sides "
            "cannot be told; measure up to the flange"
        )
    flange = points.y[sign * out > 0.5 * (sign * out).max()].mean()
    middle = 0.5 * (points.y.min() + points.y.max())
    return _flipped(points, sign < 0, flange > middle, "flange")


def _oriented_rail(points: Points) -> Points:
    """The edges of a head lie below its top; the gauge side is measured further down."""
    middle = 0.5 * (points.y.min() + points.y.max())
    inner = abs(points.y - middle) < 0.25 * np.ptp(points.y)
    up = np.median(points.z[~inner]) < np.median(points.z[inner])
    down = -points.z if up else points.z
    left, right = (down[side].max() for side in (points.y < middle, points.y >= middle))
    top = down.min()
    if max(left, right) - top < STANDS_OUT / 2:
        raise ProfileError("no rail head: the profile is flat; measure down to the gauge corner")
    outward = right - left > 0.25 * (max(left, right) - top)
    if abs(right - left) <= 0.25 * (max(left, right) - top):
        points = points.noted(
            "both sides of the head reach equally deep: negative y is the gauge side"
        )
    return _flipped(points, bool(up), bool(outward), "gauge side")


def _flipped(points: Points, upside: bool, mirrored: bool, what: str) -> Points:
    if upside:
        points = points.noted("z turned to point down", z=-points.z)
    if mirrored:
        points = points.noted(f"mirrored: the {what} was at positive y", y=-points.y)
    return points
