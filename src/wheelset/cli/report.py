"""The command ``report``: a wheel, a rail and a vehicle in, one HTML page out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from wheelset.cli.errors import clear_errors, error_console
from wheelset.cli.hunting import Overrides
from wheelset.cli.profile_options import (
    Amplitudes,
    BackToBack,
    Cant,
    Gauge,
    RailOrigin,
    RailRight,
    Smooth,
    Unit,
    WheelOrigin,
    WheelRight,
    amplitudes_in_metres,
    inclination,
    loaded,
)

if TYPE_CHECKING:
    from wheelset.profiles import Contact, Profile, Setup
    from wheelset.publishing.report_page import Page
    from wheelset.studies.profile_report import ProfileReport
    from wheelset.vehicle import Vehicle


def report(
    context: typer.Context,
    wheel: Annotated[str, typer.Option(help="Wheel: a packaged name, or a file.")],
    rail: Annotated[str, typer.Option(help="Rail: a packaged name, or a file.")],
    vehicle: Annotated[str, typer.Option(help="Vehicle: a packaged name, or a TOML file.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The page.")] = Path("report.html"),
    overrides: Overrides = None,
    gauge: Gauge = 1435.0,
    cant: Cant = "1:40",
    back_to_back: BackToBack = 1353.0,
    wheel_right: WheelRight = None,
    rail_right: RailRight = None,
    smooth: Smooth = "gcv",
    unit: Unit = None,
    wheel_origin: WheelOrigin = None,
    rail_origin: RailOrigin = None,
    amplitudes: Amplitudes = "1:8:1",
    v_min: Annotated[float, typer.Option(min=0.1, help="Lowest speed, m/s.")] = 10.0,
    v_max: Annotated[float, typer.Option(help="Highest speed, m/s.")] = 200.0,
    width: Annotated[
        float, typer.Option(help="Average over the displacement: standard deviation, mm.")
    ] = 0.5,
    csv: Annotated[Path | None, typer.Option(help="Write the tables to this folder.")] = None,
) -> None:
    """Report on a wheelset: geometry, conicity, critical speeds, diagram, as one HTML page.

    Names are packaged (see the commands profiles and vehicles), or files. The rolling radius and
    the distance of the contacts are the vehicle's.
    """
    from wheelset.cli.report_read import heading_of
    from wheelset.profiles import ContactOutcome, Setup
    from wheelset.vehicle import load_vehicle

    with clear_errors(ValueError):
        wanted = amplitudes_in_metres(amplitudes)
        window, averaged = _window(v_min, v_max), _width(width)
        car = load_vehicle(vehicle, overrides or ())
        wheels, rails = (wheel, wheel_right), (rail, rail_right)
        profiles = {
            **_profiles("wheel", wheels, smooth, unit, wheel_origin),
            **_profiles("rail", rails, smooth, unit, rail_origin),
        }
        track = _on_track(
            car,
            Setup(gauge=gauge * 1e-3, cant=inclination(cant), back_to_back=back_to_back * 1e-3),
        )
    heading = heading_of(context, car, track, profiles)
    try:
        contact = _contact(car, track, profiles)
    except ContactOutcome as outcome:
        _finish(_without_contact(heading, outcome), output)
        raise typer.Exit(1) from outcome
    found = _computed(car, contact, wanted, window, averaged)
    with clear_errors(OSError):
        if csv:
            _write_tables(found, csv)
        _finish(_page(heading, found), output)
    if not found.conicity.rows and all(s.run is None for s in found.speeds):
        raise typer.Exit(1)


def _window(v_min: float, v_max: float) -> tuple[float, float]:
    if not v_min < v_max <= 1000:
        raise ValueError(
            f"--v-min {v_min:g}, --v-max {v_max:g}: the first has to be below the second, and that "
            "at most 1000 m/s"
        )
    return v_min, v_max


def _width(width: float) -> float:
    if not 0.1 <= width <= 2:
        raise ValueError(
            f"--width {width:g} mm is out of range; it lies between 0.1 and 2 mm, as a part of the "
            "lateral displacement"
        )
    return width * 1e-3


def _profiles(
    kind: str, names: tuple[str, str | None], smooth: str, unit: str | None, origin: float | None
) -> dict[str, Profile | None]:
    """Left and right one as ``contact_geometry`` takes them."""
    left, right = (loaded(name, kind, smooth, unit, origin) if name else None for name in names)
    return {kind: left, f"{kind}_right": right}


def _on_track(vehicle: Vehicle, setup: Setup) -> Setup:
    from wheelset.studies.on_profiles import on_track

    return on_track(vehicle, setup)


def _contact(vehicle: Vehicle, track: Setup, profiles: dict[str, Any]) -> Contact:
    from wheelset.studies.on_profiles import searched

    contact = searched(vehicle=vehicle, track=track, **profiles)
    _say(f"contact known from {contact.y[0] * 1e3:.2f} to {contact.y[-1] * 1e3:.2f} mm")
    return contact


def _computed(
    vehicle: Vehicle,
    contact: Contact,
    amplitudes: list[float],
    window: tuple[float, float],
    width: float,
) -> ProfileReport:
    from wheelset.studies.profile_report import profile_report

    return profile_report(vehicle, contact, amplitudes, window, width, _say)


def _without_contact(heading: dict[str, Any], outcome: Exception) -> Page:
    from wheelset.cli.report_sections import page_without_contact

    error_console().print(f"[bold red]error:[/] {outcome}", highlight=False, soft_wrap=True)
    return page_without_contact(heading, str(outcome))


def _page(heading: dict[str, Any], found: ProfileReport) -> Page:
    from wheelset.cli.report_sections import page_of

    _say("drawing")
    return page_of(heading, found)


def _write_tables(found: ProfileReport, folder: Path) -> None:
    from wheelset.studies.profile_report import cycles_table, speeds_table

    folder.mkdir(parents=True, exist_ok=True)
    tables = {
        "contact": found.contact.to_frame().reset_index(),
        "conicity": found.conicity.to_frame().reset_index(),
        "speeds": speeds_table(found),
        "cycles": cycles_table(found),
    }
    for name, table in tables.items():
        table.to_csv(folder / f"{name}.csv", index=False)
    _say(f"wrote {', '.join(tables)} to {folder}, SI units")


def _finish(page: Page, output: Path) -> None:
    from wheelset.publishing.report_page import write_page

    write_page(page, output)
    typer.echo(output)


def _say(words: str) -> None:
    error_console().print(words, highlight=False, soft_wrap=True, markup=False)
