"""The unit of a file's numbers: given, stated in the file, or told by the profile's width."""

from __future__ import annotations

import re

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.reading import Reading

#: Length of a unit in m, and the widths of profiles, m, by which a unit is recognised.
UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254}
WIDTHS = (0.02, 0.3)

_ANY = "mm|cm|um|µm|inch|in|m"
_UNIT = re.compile(
    rf"[\[(]\s*({_ANY})\s*[\])]|[_/]({_ANY})\b|\b(?:in|units?)\s*[:=]?\s*(mm|cm|um|µm|m)\b",
    re.IGNORECASE,
)


def in_metres(reading: Reading, unit: str | None) -> tuple[Array, Array]:
    """x and z in m: by the unit given, else that of the file, else by the profile's width."""
    stated = _stated_unit(reading)
    if unit is not None and unit not in UNITS:
        raise ValueError(f'unknown unit "{unit}"; known are {", ".join(UNITS)}')
    known = unit or stated or _inferred_unit(reading)
    if known != "mm" and not unit:
        reading.notes.append(
            f"read in {known}: " + ("as the file says" if stated else "as its width says")
        )
    width = float(np.ptp(reading.x)) * UNITS[known]
    if not WIDTHS[0] <= width <= WIDTHS[1]:
        raise reading.error(
            f"is {width * 1e3:.4g} mm wide in {known}, a profile has "
            f"{WIDTHS[0] * 1e3:g} to {WIDTHS[1] * 1e3:g} mm",
            "state another unit",
        )
    return reading.x * UNITS[known], reading.z * UNITS[known]


def _stated_unit(reading: Reading) -> str | None:
    found = _UNIT.search(f" {reading.words} [{reading.header.get('unit', '')}] ")
    if found is None:
        return None
    word = next(group for group in found.groups() if group).lower()
    return {"µm": "um", "inch": "in"}.get(word, word)


def _inferred_unit(reading: Reading) -> str:
    width = float(np.ptp(reading.x))
    for unit in ("mm", "m", "um"):
        if WIDTHS[0] <= width * UNITS[unit] <= WIDTHS[1]:
            return unit
    raise reading.error(
        f"is {width:.4g} wide, which is a profile's width neither in mm nor in m",
        "state the unit",
    )
