"""Rail profiles by formula, in mm: the running surface of the head.

Sources: 60E1 of EN 13674-1; CHN60 after TB/T 2344, its radii as commonly quoted and its joints by
tangency; rail A of EN 15302, whose formula holds its inclination and its place in the track.
"""

from __future__ import annotations

from wheelset.profiles.curves import Piece, arc, line
from wheelset.profiles.wheels import Formula

#: Slope of the flanks of a rail head.
FLANK = 20.0


def _symmetric(joints: tuple[float, ...], pieces: tuple[Piece, ...], flank: float) -> Formula:
    """A head from its right half: the crown, arcs outward, then the 1:20 flank to ``flank``.

    joints: where each piece ends; the last arc ends in (y, z) at the flank's beginning.
    """
    *ends, z = joints
    right = (*pieces[1:], line(z - FLANK * ends[-1], FLANK))
    left = tuple(_mirrored(piece) for piece in reversed(right))
    outer = (*ends, flank)
    return (*(-y for y in reversed(outer)), *outer), (*left, pieces[0], *right)


def _mirrored(piece: Piece) -> Piece:
    p = tuple((-1) ** k * c for k, c in enumerate(piece.p))
    return Piece(p, piece.sense, piece.radius, -piece.centre)


RAIL_60E1: Formula = _symmetric(
    (10.228, 26.026512, 35.999826, 14.299938),
    (arc(300, 0, 300, -1), arc(80, 7.50053, 80.12790, -1), arc(13, 23.01603, 14.94915, -1)),
    37.15,
)

CHN60: Formula = _symmetric(
    (10.0, 25.342300, 35.399641, 14.192770),
    (arc(300, 0, 300, -1), arc(80, 7.33333, 80.12226, -1), arc(13, 22.41586, 14.84196, -1)),
    36.5,
)

EN_15302_RAIL_A: Formula = (
    (-32.6340, -23.2401, -7.8749, 13.0989, 28.6709, 39.2705),
    (
        arc(13, -19.63949, 15.899044, -1),
        arc(80, -1.0825, 80.277908, -1),
        arc(300, 17.5966, 299.48349, -1),
        arc(80, 14.29829, 79.508225, -1),
        arc(13, 26.33535, 13.598369, -1),
    ),
)
