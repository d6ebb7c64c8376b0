"""Worn wheels: a profile less a depth of wear, and those that travel with the package.

The packaged ones are simulated (``wheelset wear``), not measured. A file holds, after a commented
header that says how it was made, a row of column names and rows of ``y_mm`` and of the depth of
wear [mm] at every mileage [1e4 km]; the depth is vertical, z of the new wheel less z of the worn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from io import StringIO
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import BSpline, make_interp_spline

from wheelset.profiles import wheels
from wheelset.profiles.curves import SAMPLING, Array, Curve, SplineCurve, samples
from wheelset.profiles.errors import ProfileError
from wheelset.profiles.formulas import in_metres
from wheelset.profiles.profile import Profile

#: Wheel whose worn profiles are packaged, and the laws by which it was worn.
WHEEL, LAWS = "LMB10", ("archard_kth", "usfd")


@dataclass(frozen=True, eq=False)
class WornCurve:
    """A curve less a depth: ``z(y) - d(y)``; d is a spline, zero beyond its ends."""

    new: Curve
    depth: BSpline
    _derivatives: tuple[BSpline, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        d = self.depth
        object.__setattr__(self, "_derivatives", (d, d.derivative(1), d.derivative(2)))

    @classmethod
    def of(cls, new: Curve, y: Array, depth: Array) -> WornCurve:
        """With the cubic spline through depths [m] at places y [m], zero and flat at both ends."""
        flat = [(1, 0.0)]
        return cls(new, make_interp_spline(y, depth, k=3, bc_type=(flat, flat)))

    @property
    def domain(self) -> tuple[float, float]:
        """That of the new curve."""
        return self.new.domain

    def removed(self, y: ArrayLike, derivative: int = 0) -> Array:
        """d, d' or d''."""
        y = np.asarray(y, float)
        k = self.depth.k
        low, high = self.depth.t[k], self.depth.t[-k - 1]
        inside = (y >= low) & (y <= high)
        return np.where(inside, self._derivatives[derivative](np.clip(y, low, high)), 0.0)

    def __call__(self, y: ArrayLike, derivative: int = 0) -> Array:
        """z, z' or z''."""
        return self.new(y, derivative) - self.removed(y, derivative)

    def jet(self, y: Array) -> tuple[Array, Array, Array]:
        """z, z' and z'' together."""
        z, z1, z2 = self.new.jet(y)
        return z - self.removed(y), z1 - self.removed(y, 1), z2 - self.removed(y, 2)

    def moved(self, dy: float, dz: float) -> WornCurve:
        """Shifted by (dy, dz)."""
        d = self.depth
        return WornCurve(self.new.moved(dy, dz), BSpline(d.t + dy, d.c, d.k))

    def rotated(self, angle: float) -> Curve:
        """The spline through the rotated points."""
        y = samples(self, SAMPLING)
        return SplineCurve.through(y, self(y)).rotated(angle)


def worn(profile: Profile, y: Array, depth: Array, name: str = "", source: str = "") -> Profile:
    """The profile less a vertical depth [m] at places y [m], zero beyond them."""
    curve = WornCurve.of(profile.curve, y, depth)
    return replace(profile, name=name or profile.name, curve=curve, source=source)


def worn_profiles(law: str) -> Mapping[float, Profile]:
    """The packaged worn wheels of a law by mileage [1e4 km], ascending.

    Raises ProfileError for a law without them.
    """
    new = Profile(WHEEL, "wheel", in_metres(wheels.LMB10))
    mileages, y, depths = _table(law)
    return MappingProxyType(
        {
            mileage: worn(new, y, depth, worn_name(mileage, law), _source(mileage, law))
            for mileage, depth in zip(mileages, depths.T, strict=True)
        }
    )


def worn_name(mileage: float, law: str) -> str:
    """The name of a packaged worn wheel, as ``LMB10@4.8-usfd``."""
    return f"{WHEEL}@{mileage:g}-{law}"


def worn_names() -> Mapping[str, tuple[float, str]]:
    """Mileage [1e4 km] and law of every packaged worn wheel by its name."""
    return {worn_name(m, law): (m, law) for law in LAWS for m in _table(law)[0]}


def worn_header(law: str) -> tuple[str, ...]:
    """How the packaged wear of a law was made: the comments of its file."""
    lines = _text(law).splitlines()
    return tuple(line.removeprefix("#").strip() for line in lines if line.startswith("#"))


def _source(mileage: float, law: str) -> str:
    return f"simulated wear, {mileage:g}e4 km, {law}"


@cache
def _text(law: str) -> str:
    if law not in LAWS:
        raise ProfileError(f'no worn wheels of the law "{law}"; there are those of {LAWS}')
    name = f"{WHEEL}_worn_{law}.csv"
    return files("wheelset.data").joinpath("profiles", name).read_text("utf-8")


@cache
def _table(law: str) -> tuple[tuple[float, ...], Array, Array]:
    """Mileages, places y [m] and depths [m], (places, mileages)."""
    body = [line for line in _text(law).splitlines() if not line.startswith("#")]
    mileages = tuple(float(name.removeprefix("depth_mm_")) for name in body[0].split(",")[1:])
    rows = np.loadtxt(StringIO("\n".join(body[1:])), delimiter=",", ndmin=2)
    return mileages, rows[:, 0] * 1e-3, rows[:, 1:] * 1e-3
