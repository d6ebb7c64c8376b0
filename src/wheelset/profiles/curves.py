"""Curves z(y): pieces of arcs, lines and polynomials, and splines. Lengths in m.

A piece is ``z = p(y) + sense sqrt(R^2 - (y - c)^2)``: an arc has a constant p, a line or a
polynomial has sense 0. One formula for all is what makes a whole profile one array operation.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BSpline, make_interp_spline

Array = NDArray[np.float64]

#: Spacing at which a curve is sampled where it cannot be turned by formula, m.
SAMPLING = 5e-5

#: An arc ends at this share of its radius beside its centre: z(y) has no slope at the whole.
UPRIGHT = 1 - 1e-7


class Curve(Protocol):
    """A graph z(y) with two derivatives."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last y."""
        ...

    def __call__(self, y: ArrayLike, derivative: int = 0) -> Array:
        """z or its first or second derivative, of the shape of y."""
        ...

    def jet(self, y: Array) -> tuple[Array, Array, Array]:
        """z, z' and z'' together."""
        ...

    def moved(self, dy: float, dz: float) -> Curve:
        """Shifted by (dy, dz)."""
        ...

    def rotated(self, angle: float) -> Curve:
        """Turned about (0, 0) so that slopes decrease by ``angle`` [rad]."""
        ...


@dataclass(frozen=True)
class Piece:
    """``z = p(y) + sense sqrt(radius^2 - (y - centre)^2)``; p by ascending powers."""

    p: tuple[float, ...]
    sense: int = 0
    radius: float = 1.0
    centre: float = 0.0

    @property
    def turns(self) -> bool:
        """Whether a rotation leaves it a piece: arcs and lines."""
        return len(self.p) == 1 if self.sense else len(self.p) <= 2


def arc(radius: float, y: float, z: float, sense: int) -> Piece:
    """An arc about (y, z): sense +1 is the half with larger z, the lower one."""
    return Piece((z,), sense, radius, y)


def line(z0: float, slope: float) -> Piece:
    """``z = z0 + slope y``."""
    return Piece((z0, slope))


def polynomial(*p: float) -> Piece:
    """``z = p0 + p1 y + p2 y^2 + ...``."""
    return Piece(p)


@dataclass(frozen=True)
class PiecewiseCurve:
    """Pieces between joints: ``len(joints) == len(pieces) + 1``, joints ascending."""

    joints: tuple[float, ...]
    pieces: tuple[Piece, ...]
    _table: Array = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if len(self.joints) != len(self.pieces) + 1 or list(self.joints) != sorted(self.joints):
            raise ValueError(
                f"{len(self.pieces)} pieces need {len(self.pieces) + 1} ascending joints, "
                f"got {self.joints}"
            )
        object.__setattr__(self, "_table", _tabulated(self.pieces))

    @property
    def domain(self) -> tuple[float, float]:
        """First and last joint."""
        return self.joints[0], self.joints[-1]

    def __call__(self, y: ArrayLike, derivative: int = 0) -> Array:
        """z, z' or z''; beyond the ends the end pieces are continued."""
        return self.jet(np.asarray(y, float))[derivative]

    def jet(self, y: Array) -> tuple[Array, Array, Array]:
        """z, z' and z'' together."""
        k = np.searchsorted(self.joints[1:-1], y)
        sense, square, centre, *p = self._table.take(k, axis=1)
        w = y - centre
        root = np.sqrt(np.maximum(square - w * w, 1e-18))
        p0, p1, p2 = _horner(p, y)
        return p0 + sense * root, p1 - sense * w / root, p2 - sense * square / root**3

    def moved(self, dy: float, dz: float) -> PiecewiseCurve:
        """Shifted by (dy, dz)."""
        joints = tuple(y + dy for y in self.joints)
        return PiecewiseCurve(joints, tuple(_moved(piece, dy, dz) for piece in self.pieces))

    def rotated(self, angle: float) -> Curve:
        """Exact for arcs and lines; a curve with polynomials becomes a spline."""
        if not all(piece.turns for piece in self.pieces):
            return _rotated_samples(self, angle)
        y, _ = _turn(np.array(self.joints), self(self.joints), angle)
        return _standing(y.tolist(), [_rotated(piece, angle) for piece in self.pieces])


@dataclass(frozen=True, eq=False)
class SplineCurve:
    """A B-spline z(y)."""

    spline: BSpline
    _derivatives: tuple[BSpline, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        derivatives = (self.spline, self.spline.derivative(1), self.spline.derivative(2))
        object.__setattr__(self, "_derivatives", derivatives)

    @classmethod
    def through(cls, y: Array, z: Array) -> SplineCurve:
        """The cubic spline through points, y ascending."""
        return cls(make_interp_spline(y, z, k=3))

    @property
    def domain(self) -> tuple[float, float]:
        """First and last knot."""
        t, k = self.spline.t, self.spline.k
        return float(t[k]), float(t[-k - 1])

    def __call__(self, y: ArrayLike, derivative: int = 0) -> Array:
        """z, z' or z''."""
        return np.asarray(self._derivatives[derivative](np.asarray(y, float)))

    def jet(self, y: Array) -> tuple[Array, Array, Array]:
        """z, z' and z'' together."""
        return self(y), self(y, 1), self(y, 2)

    def moved(self, dy: float, dz: float) -> SplineCurve:
        """Shifted by (dy, dz)."""
        s = self.spline
        return SplineCurve(BSpline(s.t + dy, s.c + dz, s.k))

    def rotated(self, angle: float) -> SplineCurve:
        """The spline through the rotated points."""
        return _rotated_samples(self, angle)


def samples(curve: Curve, spacing: float) -> Array:
    """Equidistant y over the whole domain, no further apart than ``spacing``."""
    low, high = curve.domain
    return np.linspace(low, high, int(np.ceil((high - low) / spacing - 1e-9)) + 1)


def _tabulated(pieces: tuple[Piece, ...]) -> Array:
    """Rows: sense, radius^2, centre, p0, p1, ...; a column for each piece."""
    degree = max(len(piece.p) for piece in pieces)
    p = np.array([piece.p + (0.0,) * (degree - len(piece.p)) for piece in pieces]).T
    # a polynomial's root is multiplied by zero; its radius only has to keep it real
    square = [piece.radius**2 if piece.sense else 1.0 for piece in pieces]
    return np.vstack([[q.sense for q in pieces], square, [q.centre for q in pieces], p])


def _horner(p: list[Array], y: Array) -> tuple[Array, Array, Array]:
    """A polynomial and two derivatives; the coefficients ascend."""
    p0, p1, p2 = p[-1], np.zeros_like(y), np.zeros_like(y)
    for coefficient in p[-2::-1]:
        p2 = p2 * y + p1
        p1 = p1 * y + p0
        p0 = p0 * y + coefficient
    return p0, p1, 2 * p2


def _standing(joints: list[float], pieces: list[Piece]) -> PiecewiseCurve:
    """Without pieces at the ends that hang over, and ending short of the vertical."""
    while joints[1] <= joints[0]:
        joints, pieces = joints[1:], pieces[1:]
    while joints[-1] <= joints[-2]:
        joints, pieces = joints[:-1], pieces[:-1]
    first, last = pieces[0], pieces[-1]
    if first.sense:
        joints[0] = max(joints[0], first.centre - UPRIGHT * first.radius)
    if last.sense:
        joints[-1] = min(joints[-1], last.centre + UPRIGHT * last.radius)
    return PiecewiseCurve(tuple(joints), tuple(pieces))


def _moved(piece: Piece, dy: float, dz: float) -> Piece:
    shifted = np.polynomial.Polynomial(piece.p)(np.polynomial.Polynomial([-dy, 1.0])).coef
    p = (float(shifted[0]) + dz, *(float(c) for c in shifted[1:]))
    return Piece(p, piece.sense, piece.radius, piece.centre + dy)


def _turn(y: Array, z: Array, angle: float) -> tuple[Array, Array]:
    c, s = np.cos(angle), np.sin(angle)
    return y * c + z * s, z * c - y * s


def _rotated(piece: Piece, angle: float) -> Piece:
    if piece.sense:
        y, z = _turn(np.array(piece.centre), np.array(piece.p[0]), angle)
        return arc(piece.radius, float(y), float(z), piece.sense)
    z0, slope = (*piece.p, 0.0)[:2]
    y, z = _turn(np.array(0.0), np.array(z0), angle)
    turned = float(np.tan(np.arctan(slope) - angle))
    return line(float(z - turned * y), turned)


def _rotated_samples(curve: Curve, angle: float) -> SplineCurve:
    y = samples(curve, SAMPLING)
    y, z = _turn(y, curve(y), angle)
    graph = np.concatenate([[True], np.diff(np.maximum.accumulate(y)) > 0])
    return SplineCurve.through(y[graph], z[graph])
