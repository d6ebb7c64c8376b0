"""What can be wrong with a profile, and what a contact search may find instead of a contact."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


class ProfileError(ValueError):
    """A profile cannot be made or used."""


@dataclass(eq=False)
class ProfileFileError(ProfileError):
    """A file does not hold a profile: which file, where in it, why, and what to do.

    line: number of the line, from 1; ``None`` when the whole file is meant.
    """

    path: Path
    reason: str
    remedy: str
    line: int | None = None

    def __str__(self) -> str:
        where = f"{self.path}, line {self.line}" if self.line else f"{self.path}"
        return f"{where}: {self.reason}; {self.remedy}"


class ContactOutcome(ArithmeticError):
    """Base of what may happen in place of a contact or a conicity."""


@dataclass(eq=False)
class ProfileEnds(ContactOutcome):
    """The lowest gap lies at the end of a profile: what lies beyond it is not known.

    side, y: the wheel and the lateral displacement [m] at which it happens.
    """

    side: str
    y: float

    def __str__(self) -> str:
        return (
            f"the contact of the {self.side} wheel reaches the end of a profile at "
            f"y = {self.y * 1e3:.3f} mm; measure further or ask for a smaller displacement"
        )


@dataclass(eq=False)
class NotSettled(ContactOutcome):
    """No roll was found at which both wheels touch, at the displacement y [m]."""

    y: float

    def __str__(self) -> str:
        return (
            f"the wheelset does not settle on both rails at y = {self.y * 1e3:.3f} mm; "
            "ask for a smaller displacement"
        )


@dataclass(eq=False)
class NoPeriodicMotion(ContactOutcome):
    """The kinematic motion has no wave of this amplitude [m]."""

    amplitude: float
    reason: str

    def __str__(self) -> str:
        return f"no wave of amplitude {self.amplitude * 1e3:g} mm: {self.reason}"
