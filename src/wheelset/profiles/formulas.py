"""Profiles given by formula in mm, as curves in m."""

from __future__ import annotations

from wheelset.profiles.curves import Piece, PiecewiseCurve
from wheelset.profiles.wheels import Formula


def in_metres(formula: Formula, millimetre: float = 1e-3) -> PiecewiseCurve:
    """A formula in mm as a curve in m."""
    joints, pieces = formula
    return PiecewiseCurve(
        tuple(y * millimetre for y in joints), tuple(_scaled(piece, millimetre) for piece in pieces)
    )


def _scaled(piece: Piece, unit: float) -> Piece:
    p = tuple(c * unit ** (1 - k) for k, c in enumerate(piece.p))
    return Piece(p, piece.sense, piece.radius * unit, piece.centre * unit)
