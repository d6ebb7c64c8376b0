"""Ranges of inputs, and the message about a value outside of its own."""

from __future__ import annotations


def within(name: str, value: float, low: float, high: float, unit: str = "") -> None:
    """ValueError naming the field, its value and its range, unless low <= value <= high."""
    if not low <= value <= high:
        raise ValueError(
            f"{name} = {value:g} is out of range; give a value between {low:g} and {high:g} "
            f"{unit}".rstrip()
        )
