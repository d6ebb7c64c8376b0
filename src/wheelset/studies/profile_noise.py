"""From a profile's points to critical speeds: what spacing and measurement noise do to them."""

from __future__ import annotations

import numpy as np
import pandas as pd

from wheelset.profiles import Profile, SplineGeometry, profile_from_points
from wheelset.studies.on_profiles import on_geometry, searched, speeds_row
from wheelset.studies.profile_contact import Parameters

#: Spacings of the points, m, and of those that get noise; its standard deviation, m; samples.
SPACINGS = {"paper": (5e-5, 1e-4, 2e-4), "quick": (2e-4,)}
NOISY, NOISE, SAMPLES = (1e-4, 2e-4), 5e-6, {"paper": 6, "quick": 2}

#: The |y| up to which cycles are followed, m: the slowest of the small ones lies within.
REACH = 0.0045

COLUMNS = ["spacing", "noise", "seed", "v_lin", "v_non"]


def resampled(profile: Profile, spacing: float, noise: float = 0.0, seed: int = 0) -> Profile:
    """A profile measured again: points at a spacing [m] with white noise [m], read as a file is."""
    y, z = profile.points(spacing)
    z = z + noise * np.random.default_rng(seed).standard_normal(len(z))
    return profile_from_points(profile.name, profile.kind, y, z)


def round_trips(p: Parameters) -> pd.DataFrame:
    """Critical speeds on the wheel as it is (spacing 0), through points, and through noisy points.

    Columns: spacing m, noise m, seed; v_lin, v_non m/s, the slowest cycle of at most REACH.
    """
    rows = [_row(p, 0.0, 0.0, 0)]
    spacings, seeds = SPACINGS[p.resolution], range(SAMPLES[p.resolution])
    rows += [_row(p, spacing, 0.0, 0) for spacing in spacings]
    rows += [_row(p, s, NOISE, seed) for s in spacings if s in NOISY for seed in seeds]
    return pd.DataFrame(rows, columns=COLUMNS)


def _row(p: Parameters, spacing: float, noise: float, seed: int) -> dict[str, object]:
    wheel, rail = p.profiles
    measured = resampled(wheel, spacing, noise, seed) if spacing else wheel
    contact = searched(measured, rail, p.loaded, p.track)
    geometry = SplineGeometry.of(contact, REACH, p.width)
    row = speeds_row(on_geometry(p.loaded, contact, geometry, p.window))
    given = {"spacing": spacing, "noise": noise, "seed": seed}
    return {**given, "v_lin": row["v_lin"], "v_non": row["v_non"]}


def scatter(trips: pd.DataFrame) -> pd.DataFrame:
    """By spacing and noise: root mean square and largest change of both speeds, m/s, samples.

    Against the wheel as it is.
    """
    exact = trips.iloc[0]
    rows = []
    for (spacing, noise), group in trips.iloc[1:].groupby(["spacing", "noise"], sort=False):
        row = {"spacing": spacing, "noise": noise, "samples": len(group)}
        for speed in ("v_lin", "v_non"):
            off = (group[speed].astype(float) - float(exact[speed])).abs()
            row |= {f"{speed}_rms": float(np.sqrt((off**2).mean())), f"{speed}_most": off.max()}
        rows.append(row)
    return pd.DataFrame(rows)
