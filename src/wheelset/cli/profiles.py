"""Commands over profiles: ``profiles``, ``conicity``."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console

from wheelset.cli.errors import clear_errors, error_console
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
    distinct,
    inclination,
    loaded,
    named_jumps,
    setup_words,
)
from wheelset.cli.tables import show_json, show_table

if TYPE_CHECKING:
    import pandas as pd

    from wheelset.profiles import Contact, Profile, Setup
    from wheelset.profiles.conicity import ConicityTable

#: Half the range of displacements that is searched, m, and the spacing of the search, m.
REACH, SPACING = 0.010, 5e-5

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")]
Wheel = Annotated[str, typer.Argument(metavar="WHEEL", help="A packaged name, or a file.")]
Rail = Annotated[str, typer.Argument(metavar="RAIL", help="A packaged name, or a file.")]


def profiles(as_json: AsJson = False) -> None:
    """List the packaged wheel and rail profiles."""
    from wheelset.profiles import packaged_profiles

    rows: list[dict[str, Any]] = [
        {"name": p.name, "kind": p.kind, "from": p.domain[0], "to": p.domain[1], "source": p.source}
        for p in packaged_profiles()
    ]
    if as_json:
        show_json(rows)
        return
    columns = ["name", "kind", "y mm", "source"]
    shown = [
        (r["name"], r["kind"], f"{r['from'] * 1e3:.1f} .. {r['to'] * 1e3:.1f}", r["source"])
        for r in rows
    ]
    show_table("Packaged profiles", columns, shown)


def conicity(
    wheel: Wheel,
    rail: Rail,
    gauge: Gauge = 1435.0,
    cant: Cant = "1:40",
    back_to_back: BackToBack = 1353.0,
    r0: Annotated[float, typer.Option(help="Nominal rolling radius, mm.")] = 460.0,
    r0_right: Annotated[
        float | None, typer.Option(help="Nominal radius of the right wheel, mm, if it differs.")
    ] = None,
    roll: Annotated[bool, typer.Option(help="Let the wheelset roll as it moves sideways.")] = True,
    en15302: Annotated[
        bool,
        typer.Option(
            "--en15302",
            help="Set-up of EN 15302: level axle, profile origins at 750 mm, 0.1 mm grid. Rail "
            "files are taken to hold their inclination.",
        ),
    ] = False,
    amplitudes: Amplitudes = "1:8:1",
    wheel_right: WheelRight = None,
    rail_right: RailRight = None,
    smooth: Smooth = "gcv",
    unit: Unit = None,
    wheel_origin: WheelOrigin = None,
    rail_origin: RailOrigin = None,
    as_json: AsJson = False,
    csv: Annotated[Path | None, typer.Option(help="Write the conicities to this file.")] = None,
    contact_csv: Annotated[
        Path | None, typer.Option(help="Write the contacts over y to this file, SI units.")
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="Draw profiles and results, SVG.")] = None,
) -> None:
    """Equivalent conicity of a wheelset on a track, to EN 15302.

    Names are packaged profiles (see the command profiles); files are two columns y, z in CSV or
    text, or MiniProf's .mpt, .whl, .ban, .rai. What was repaired in them is reported.
    """
    from wheelset.profiles import ContactOutcome, conicity_table

    with clear_errors(ContactOutcome, exit_code=1), clear_errors(ValueError):
        wanted = amplitudes_in_metres(amplitudes)
        if plot and plot.suffix.lower() != ".svg":
            raise ValueError(f'--plot {plot}: figures are drawn as SVG; end the name in ".svg"')

        def a_wheel(name: str) -> Profile:
            return loaded(name, "wheel", smooth, unit, wheel_origin)

        def a_rail(name: str) -> Profile:
            return _placed(loaded(name, "rail", smooth, unit, rail_origin), en15302)

        chosen: dict[str, Any] = {
            "wheel": a_wheel(wheel),
            "wheel_right": wheel_right and a_wheel(wheel_right),
            "rail": a_rail(rail),
            "rail_right": rail_right and a_rail(rail_right),
        }
        setup = _setup(
            gauge=gauge * 1e-3,
            cant=inclination(cant),
            back_to_back=back_to_back * 1e-3,
            r0=r0 * 1e-3,
            r0_right=r0_right and r0_right * 1e-3,
            roll=roll,
        )
        if en15302:
            setup = _standard(setup, chosen["rail"])
        contact = _contact(setup, chosen, max(wanted))
        table = conicity_table(contact, wanted)
        if not table.rows:
            raise table.missing[0]
    with clear_errors(OSError):
        _write(table, contact, csv, contact_csv, plot)
    if as_json:
        show_json(_record(table, contact))
    else:
        _show(table, contact)


def _placed(rail: Profile, en15302: bool) -> Profile:
    """In the standard's set-up a rail from a file holds its inclination."""
    from wheelset.profiles.catalogue import CATALOGUE

    return replace(rail, in_place=True) if en15302 and rail.name not in CATALOGUE else rail


def _setup(**values: Any) -> Setup:
    from wheelset.profiles import Setup

    return Setup(**values)


def _standard(setup: Setup, rail: Profile) -> Setup:
    """EN 15302's; a rail without its place is laid by gauge and inclination."""
    from wheelset.profiles import EN_15302

    standard = replace(EN_15302, r0=setup.r0, r0_right=setup.r0_right)
    if rail.in_place:
        return standard
    return replace(standard, rail_origin=None, gauge=setup.gauge, cant=setup.cant)


def _contact(setup: Setup, chosen: dict[str, Any], largest: float) -> Contact:
    import numpy as np

    from wheelset.profiles import EN_15302_GRID, contact_geometry

    level = setup.wheel_origin is not None
    spacing = EN_15302_GRID if level else SPACING
    half = int(np.ceil(max(REACH, largest + 0.002) / spacing))
    y = np.arange(-half, half + 1) * spacing
    return contact_geometry(y=y, setup=setup, trim=True, **chosen)


def _frame(table: ConicityTable) -> pd.DataFrame:
    """The table in the units of the trade: mm, m for the wavelength."""
    frame = table.to_frame().reset_index()
    for column in ("amplitude", "low", "high", "dr"):
        frame[column] *= 1e3
    units = {"amplitude": "amplitude_mm", "low": "low_mm", "high": "high_mm", "dr": "dr_mm"}
    return frame.rename(columns={**units, "wavelength": "wavelength_m"})


def _write(
    table: ConicityTable,
    contact: Contact,
    csv: Path | None,
    contact_csv: Path | None,
    plot: Path | None,
) -> None:
    for path, frame in ((csv, _frame(table).set_index("amplitude_mm")), (contact_csv, None)):
        if path:
            (contact.to_frame() if frame is None else frame).to_csv(path)
            error_console().print(f"wrote {path}", highlight=False)
    if plot:
        from wheelset.plotting.profiles import conicity_panels
        from wheelset.plotting.style import save

        save(conicity_panels(contact.to_frame(), table.to_frame()), plot)
        error_console().print(f"wrote {plot}", highlight=False)


def _record(table: ConicityTable, contact: Contact) -> dict[str, Any]:
    return {
        "setup": asdict(contact.setup),
        "profiles": [
            {"name": p.name, "kind": p.kind, "source": p.source, "notes": list(p.notes)}
            for p in distinct(contact)
        ],
        "conicity": [asdict(row) for row in table.rows],
        "missing": [{"amplitude": m.amplitude, "reason": m.reason} for m in table.missing],
        "nonlinearity": table.nonlinearity,
        "jumps": [asdict(jump) for jump in contact.jumps],
        "ended": [str(reason) for reason in contact.ended],
    }


def _show(table: ConicityTable, contact: Contact) -> None:
    names = " / ".join(p.name for p in distinct(contact))
    for profile in distinct(contact):
        for note in profile.notes:
            error_console().print(f"{profile.name}: {note}", highlight=False, soft_wrap=True)
    columns = ["mm", "tan γe", "regression", "harmonic", "wave m", "Δr mm", "angle par."]
    rows = [
        [
            f"{row.amplitude * 1e3:g}",
            *(f"{value:.4f}" for value in (row.integration, row.regression, row.harmonic)),
            f"{row.wavelength:.3f}",
            f"{row.dr * 1e3:.4f}",
            f"{row.contact_angle:.3f}",
        ]
        for row in table.rows
    ]
    show_table(f"{names}: equivalent conicity by amplitude", columns, rows, 7)
    _show_words(table, contact)


def _show_words(table: ConicityTable, contact: Contact) -> None:
    lines = [setup_words(contact.setup)]
    if table.nonlinearity is not None:
        lines.append(f"nonlinearity parameter (2 to 4 mm): {table.nonlinearity * 1e-3:+.4f} 1/mm")
    lines += named_jumps(contact, " jumps, all in --json")
    lines += [str(reason) for reason in (*table.missing, *contact.ended)]
    for text in lines:
        Console().print(text, highlight=False, soft_wrap=True)
