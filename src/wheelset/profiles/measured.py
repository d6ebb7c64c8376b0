"""From a name or a file to a profile."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wheelset.profiles.catalogue import packaged
from wheelset.profiles.curves import Array
from wheelset.profiles.errors import ProfileError, ProfileFileError
from wheelset.profiles.points import Points
from wheelset.profiles.profile import Kind, Profile, Side
from wheelset.profiles.reading import Reading, read_points
from wheelset.profiles.reference import referenced
from wheelset.profiles.repair import repaired
from wheelset.profiles.smoothing import Smoothing, smoothed
from wheelset.profiles.units import in_metres

#: Kind of a profile by the ending of MiniProf's files.
ENDINGS: dict[str, Kind] = {".whl": "wheel", ".ban": "rail", ".rai": "rail"}

_SIDES: dict[str, Side] = {"l": "left", "r": "right"}


def load_profile(
    name_or_path: str | Path,
    kind: Kind,
    *,
    smoothing: Smoothing = "gcv",
    unit: str | None = None,
    origin: float | None = None,
) -> Profile:
    """The packaged profile of that name, or the measured one in a file (see ``read_profile``).

    Raises ProfileError if it is neither, or a wheel where a rail is wanted.
    """
    path = Path(name_or_path)
    if path.is_file() or path.suffix.lower() in {".csv", ".txt", ".dat", ".mpt", *ENDINGS}:
        profile = read_profile(path, kind, smoothing=smoothing, unit=unit, origin=origin)
    else:
        profile = packaged(str(name_or_path))
    if profile.kind != kind:
        raise ProfileError(f"{profile.name} is a {profile.kind}, a {kind} is wanted here")
    return profile


def read_profile(
    path: str | Path,
    kind: Kind | None = None,
    *,
    smoothing: Smoothing = "gcv",
    unit: str | None = None,
    origin: float | None = None,
) -> Profile:
    """A measured profile; every repair is in its ``notes``.

    kind: "wheel" or "rail", by the file's ending if not given. unit: "m", "cm", "mm", "um" or
    "in" if the file's is known. origin: y [m] of the taping point or the rail's middle in
    the oriented file, if it cannot be found. Raises ProfileFileError naming file, line and reason.
    """
    path = Path(path)
    kind = kind or ENDINGS.get(path.suffix.lower())
    if kind is None:
        raise ProfileError(f"{path}: wheel or rail? say which, its name does not tell")
    reading = read_points(path)
    y, z = in_metres(reading, unit)
    points = Points(kind, y, z, tuple(reading.notes))
    try:
        return _profile(reading, referenced(repaired(points), origin), smoothing)
    except ProfileFileError:
        raise
    except ProfileError as error:
        raise reading.error(str(error), "see the file in a plot") from error


def profile_from_points(
    name: str, kind: Kind, y: Array, z: Array, *, smoothing: Smoothing = "gcv", notes: bool = True
) -> Profile:
    """A profile through points [m] in this package's coordinates, repaired but not moved."""
    points = repaired(Points(kind, np.asarray(y, float), np.asarray(z, float)))
    curve, words = smoothed(points.y, points.z, smoothing)
    kept = (*points.notes, words) if notes else ()
    return Profile(name, kind, curve, source="points", notes=kept)


def _profile(reading: Reading, points: Points, smoothing: Smoothing) -> Profile:
    curve, words = smoothed(points.y, points.z, smoothing)
    header = reading.header
    side = header.get("side") or header.get("rail_side") or header.get("wheel_side") or ""
    return Profile(
        reading.path.name,
        points.kind,
        curve,
        side=_SIDES.get(side[:1].lower(), "both"),
        source=f"{reading.path}: {len(points.y)} points",
        notes=(*points.notes, words),
    )
