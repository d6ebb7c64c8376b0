"""Where the origin of a measured profile is: the taping point of a wheel, the top of a rail."""

from __future__ import annotations

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.errors import ProfileError
from wheelset.profiles.points import Points

#: Distance of the taping point from a wheel's back face; of the flange's tip from it, m.
TAPING, TIP = 0.070, -0.055

#: Where the tip of a flange lies if the file's origin is the taping point, or the back face, m.
TIP_FROM_TAPING, TIP_FROM_BACK = (-0.061, -0.049), (0.008, 0.022)

#: Height on the flange by which one without a tip is placed, and where it is then, m.
FLANK, FLANK_AT = 0.010, (-0.0425, -0.0345)

#: A rail's gauge point below its top; where it is if the file's origin is the head's middle, m.
GAUGE_DEPTH, GAUGE_AT, HALF_HEAD = 0.014, (-0.042, -0.028), -0.036

#: A shift smaller than this is the accuracy of the measurement, m.
AGREES = 1e-4


def referenced(points: Points, origin: float | None = None) -> Points:
    """With y and z from the profile's own origin; ``origin``: its y in the file [m], if known."""
    if origin is not None:
        shifted = points.noted(f"origin put at y = {origin * 1e3:g} mm", y=points.y - origin)
    else:
        found = _wheel_shift(points) if points.kind == "wheel" else _rail_shift(points)
        shift, words = found
        shifted = points.noted(words, y=points.y + shift) if words else points
    return _at_height(shifted)


def _at_height(points: Points) -> Points:
    """z = 0 at a wheel's taping point, at a rail's top."""
    wheel = points.kind == "wheel"
    if wheel and not points.y[0] < 0 < points.y[-1]:
        raise ProfileError("the taping point is not on the profile; state the y of its origin")
    zero = float(np.interp(0.0, points.y, points.z) if wheel else points.z.min())
    if abs(zero) < 1e-9:
        return points
    what = "the taping point" if wheel else "the top"
    return points.noted(f"z set to 0 at {what}: {-zero * 1e3:+.3f} mm", z=points.z - zero)


def _wheel_shift(points: Points) -> tuple[float, str]:
    """By the back face, else by where the flange is."""
    if points.face is not None:
        shift = -TAPING - points.face
        if abs(shift) < AGREES:
            return 0.0, ""
        return (
            shift,
            f"moved by {shift * 1e3:+.3f} mm: the back face is 70 mm from the taping point",
        )
    tip = _tip(points.y, points.z)
    if tip is None:
        return _by_flank(points)
    if TIP_FROM_TAPING[0] <= tip <= TIP_FROM_TAPING[1]:
        return 0.0, ""
    if TIP_FROM_BACK[0] <= tip <= TIP_FROM_BACK[1]:
        return -TAPING, "moved by -70 mm: the file's origin is at the wheel's back"
    shift = TIP - tip
    return shift, (
        f"moved by {shift * 1e3:+.3f} mm: the flange's tip put 55 mm from the taping point "
        "(no back face was measured)"
    )


def _tip(y: Array, z: Array) -> float | None:
    """The y of the flange's tip, if the profile goes beyond it."""
    k = int(z.argmax())
    return float(y[k]) if k >= 3 and z[k] - z[0] > 1e-4 else None


def _by_flank(points: Points) -> tuple[float, str]:
    """A flange measured in part: the file's origin is believed if its flank is where it may be."""
    tread = float(np.interp(0.0, points.y, points.z)) if points.y[0] < 0 < points.y[-1] else 0.0
    above = np.flatnonzero(points.z - tread >= FLANK)
    if len(above):
        at = float(points.y[above[-1]])
        if FLANK_AT[0] <= at <= FLANK_AT[1]:
            return 0.0, "the flange's tip was not measured: the file's origin is kept"
        raise ProfileError(
            f"the flange, 10 mm above the tread, is at y = {at * 1e3:.1f} mm and has no tip: the "
            "taping point cannot be found; state the y of the origin"
        )
    return 0.0, "only the foot of the flange was measured: the file's origin is kept"


def _rail_shift(points: Points) -> tuple[float, str]:
    """A head whose gauge side is not near -36 mm is moved there."""
    top = points.z.min()
    inside = np.flatnonzero(
        (points.y < points.y[points.z.argmin()]) & (points.z >= top + GAUGE_DEPTH)
    )
    if not len(inside):
        return 0.0, "the gauge point was not measured: the file's origin is kept"
    at = float(points.y[inside[-1]])
    if GAUGE_AT[0] <= at <= GAUGE_AT[1]:
        return 0.0, ""
    shift = HALF_HEAD - at
    return shift, f"moved by {shift * 1e3:+.3f} mm: the gauge side put at y = -36 mm"
