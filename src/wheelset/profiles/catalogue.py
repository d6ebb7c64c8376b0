"""The packaged profiles by name. A new profile is its formula and a line here.

Simulated worn wheels, ``LMB10@4.8-usfd`` (mileage in 1e4 km, law), are those of ``worn.py``.
"""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from wheelset.profiles import rails, wheels
from wheelset.profiles.errors import ProfileError
from wheelset.profiles.formulas import in_metres
from wheelset.profiles.profile import Kind, Profile
from wheelset.profiles.wheels import Formula
from wheelset.profiles.worn import worn_name, worn_names, worn_profiles

#: name: formula in mm, kind, whether inclination and place are in it, source.
CATALOGUE: dict[str, tuple[Formula, Kind, bool, str]] = {
    "LMB10": (wheels.LMB10, "wheel", False, "Chinese high-speed wheel, CR400BF"),
    "LMA": (wheels.LMA, "wheel", False, "Chinese high-speed wheel, CRH2"),
    "S1002": (wheels.S1002, "wheel", False, "EN 13715, flange thickness 32.5 mm"),
    "EN15302-A": (wheels.EN_15302_A, "wheel", False, "EN 15302, reference wheel A"),
    "EN15302-B": (wheels.EN_15302_B, "wheel", False, "EN 15302, reference wheel B"),
    "60E1": (rails.RAIL_60E1, "rail", False, "EN 13674-1"),
    "CHN60": (rails.CHN60, "rail", False, "TB/T 2344; radii as quoted, joints by tangency"),
    "EN15302-RailA": (rails.EN_15302_RAIL_A, "rail", True, "EN 15302, reference rail A, inclined"),
}


def packaged(name: str) -> Profile:
    """The packaged profile of that name, upper and lower case alike; ProfileError otherwise."""
    names = (*CATALOGUE, *worn_names())
    by_folded = {known.casefold(): known for known in names}
    known = by_folded.get(name.casefold())
    if known is None:
        close = get_close_matches(name.casefold(), by_folded, n=1)
        hint = f' (did you mean "{by_folded[close[0]]}"?)' if close else ""
        raise ProfileError(
            f'unknown profile "{name}"{hint}: neither a file nor one of {", ".join(CATALOGUE)}, '
            f"nor a simulated worn wheel as {worn_name(4.8, 'usfd')}"
        )
    if known not in CATALOGUE:
        mileage, law = worn_names()[known]
        return worn_profiles(law)[mileage]
    formula, kind, in_place, source = CATALOGUE[known]
    return Profile(known, kind, in_metres(formula), in_place=in_place, source=source)


def packaged_profiles() -> Iterator[Profile]:
    """All of them: wheels, rails, simulated worn wheels."""
    return (packaged(name) for name in (*CATALOGUE, *worn_names()))
