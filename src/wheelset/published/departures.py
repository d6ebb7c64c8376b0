"""Known departures: numbers of the paper that a vehicle does not reproduce, with the reason.

They are data (departures.toml), read by the strict xfails of tests/paper and by the book, so that
both give the same reason.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True)
class Departure:
    """``item`` and ``quantity`` of ``items.ITEMS`` that differ when computed for ``vehicle``."""

    item: str
    quantity: str
    vehicle: str
    reason: str

    @property
    def key(self) -> tuple[str, str, str]:
        """What the departure is known by."""
        return self.item, self.quantity, self.vehicle


@cache
def departures() -> tuple[Departure, ...]:
    """All known departures, in the order of the file."""
    text = files("wheelset.published").joinpath("departures.toml").read_text(encoding="utf-8")
    return tuple(Departure(**entry) for entry in tomllib.loads(text)["departure"])


def departure_of(item: str, quantity: str, vehicle: str) -> Departure | None:
    """The known departure of that item for that vehicle, or None."""
    for departure in departures():
        if departure.key == (item, quantity, vehicle):
            return departure
    return None
