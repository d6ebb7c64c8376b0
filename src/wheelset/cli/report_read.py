"""The first section of a report: the command, what was read, and what is not from print."""

from __future__ import annotations

import math
import shlex
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

import typer

from wheelset import __version__
from wheelset.cli.profile_options import setup_words
from wheelset.profiles import Profile, Setup
from wheelset.publishing.report_page import Code, Grid, Listing, Part, Section, Words
from wheelset.vehicle import Vehicle
from wheelset.vehicle.parameters import BY_NAME

#: A vehicle's polynomials of contact geometry and flange, which real profiles replace.
REPLACED = ("geometry", "flange")


def number(value: float | None, form: str, scale: float = 1.0) -> str:
    """A cell: a dash for what there is not. ValueError for what is no number."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if not math.isfinite(value):
        raise ValueError(f"{value} cannot be shown; a finite number is wanted")
    return format(value * scale, form).replace("-", "−")


def heading_of(
    context: typer.Context,
    vehicle: Vehicle,
    track: Setup,
    profiles: Mapping[str, Profile | None],
) -> dict[str, Any]:
    """What stands in every report, whatever is found."""
    known = [p for p in profiles.values() if p]
    wheels, rails = (
        " and ".join(dict.fromkeys(p.name for p in known if p.kind == kind))
        for kind in ("wheel", "rail")
    )
    return {
        "title": f"{wheels} on {rails}: {vehicle.title}",
        "command": _command(context),
        "made": f"wheelset {__version__}, {datetime.now(UTC):%Y-%m-%d %H:%M} UTC",
        "track": setup_words(track),
        "vehicle": vehicle,
        "profiles": known,
    }


def _command(context: typer.Context) -> str:
    """The command as it was typed, but for the order of its options."""
    words = ["wheelset", "report"]
    for parameter in context.command.params:
        name = str(parameter.name)
        source = context.get_parameter_source(name)
        if source is None or source.name != "COMMANDLINE":
            continue
        value = context.params[name]
        for one in value if isinstance(value, list | tuple) else [value]:
            words += [parameter.opts[0], str(one)]
    return shlex.join(words)


def read_section(heading: dict[str, Any]) -> Section:
    """What was read, repaired and assumed; heading: of ``heading_of``."""
    vehicle: Vehicle = heading["vehicle"]
    rows = [
        (p.name, p.kind, number(p.domain[0], ".1f", 1e3), number(p.domain[1], ".1f", 1e3), p.source)
        for p in heading["profiles"]
    ]
    notes = tuple(f"{p.name}: {note}" for p in heading["profiles"] for note in p.notes)
    parts: list[Part] = [
        Code(heading["command"]),
        Grid("Profiles", ("name", "kind", "from mm", "to mm", "source"), tuple(rows)),
        Listing(notes),
        Words(heading["track"][0].upper() + heading["track"][1:] + "."),
        Words(f"Vehicle {vehicle.name}: {vehicle.title}. {vehicle.description}".strip()),
        Words(_flange_words(vehicle)),
        _unprinted(vehicle),
    ]
    return Section("What was read", tuple(parts))


def _flange_words(vehicle: Vehicle) -> str:
    """What of the vehicle the profiles stand in place of."""
    words = "The profiles stand in place of the vehicle's polynomials of contact geometry. "
    law = vehicle.options.flange_law
    if law == "none":
        return words + "It has no flange law: flange contact is in the profiles."
    return (
        f'{words}Its flange law "{law}" acts besides the flange of the profiles; '
        "--set flange_law=none leaves it out."
    )


def _unprinted(vehicle: Vehicle) -> Grid:
    """What of the vehicle is not from print; the profiles stand in place of its polynomials."""
    rows = tuple(
        (r.name, number(r.value, ".6g"), r.unit, r.status, r.reason or r.source)
        for r in vehicle.table()
        if r.status != "printed" and not _replaced(r.name)
    )
    caption = "Of the vehicle not printed but inferred, assumed, or given by you"
    return Grid(caption, ("name", "value", "unit", "status", "reason"), rows)


def _replaced(name: str) -> bool:
    return BY_NAME[name].table in REPLACED
