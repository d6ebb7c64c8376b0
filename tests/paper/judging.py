"""Rows of a table as test parameters; a known departure is a strict xfail with its reason."""

from __future__ import annotations

import pytest

from wheelset.published.departures import departure_of
from wheelset.published.items import Item


def judged(items, vehicle_of):
    """One parameter (item, vehicle) an item; vehicle_of gives an item's vehicle."""
    return [_parameter(item, vehicle_of(item)) for item in items]


def _parameter(item: Item, vehicle: str):
    departure = departure_of(*item.key, vehicle)
    reason = departure.reason if departure else ""
    marks = [pytest.mark.xfail(strict=True, reason=reason)] if departure else []
    return pytest.param(item, vehicle, marks=marks, id=f"{vehicle}: {item.item}, {item.quantity}")
