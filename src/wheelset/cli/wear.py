"""Command over wear: ``wear``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from wheelset.cli.errors import clear_errors, error_console
from wheelset.cli.profile_options import loaded
from wheelset.cli.tables import show_table

if TYPE_CHECKING:
    import pandas as pd

    from wheelset.wear import Simulation, Store, WearHistory

#: Spacing of the written profiles, m.
SPACING = 1e-4


def wear(
    wheel: Annotated[str, typer.Argument(metavar="WHEEL", help="A packaged name, or a file.")],
    rail: Annotated[str, typer.Argument(metavar="RAIL", help="A packaged name, or a file.")],
    out: Annotated[Path, typer.Option(help="Folder of the results; an interrupted run resumes.")],
    law: Annotated[str, typer.Option(help="archard_kth, usfd or zobory.")] = "archard_kth",
    mileages: Annotated[
        str, typer.Option(help="Mileages in 1e4 km, ascending.")
    ] = "0.2,4.8,6.8,9.4,11.7,14.5,18.5",
    rate: Annotated[
        float,
        typer.Option(help="Wear of the field, mm per 1e4 km; 0 leaves the law as published."),
    ] = 0.055,
    conditions: Annotated[int, typer.Option(help="Conditions drawn, a power of two.")] = 256,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the conditions.")] = 1,
    smoothing: Annotated[float, typer.Option(help="Average of the wear over y, mm.")] = 2.5,
) -> None:
    """Simulate how a wheel's profile wears over mileage.

    The depth at the last mileage is put in (--rate); the shape of the wear is computed from the
    contacts under a stated operation. Into the folder go a profile for every mileage, which
    the command conicity reads, depths.csv with all of them and history.csv.
    """
    from wheelset.profiles import ContactOutcome
    from wheelset.wear import Simulation, Store, Strips, WearOutcome, wear_law

    with (
        clear_errors(ContactOutcome, WearOutcome, exit_code=1),
        clear_errors(ValueError, OSError),
    ):
        simulation = Simulation(
            loaded(wheel, "wheel", "gcv", None),
            loaded(rail, "rail", "gcv", None),
            wear_law(law),
            mileages=_numbers(mileages),
            field_rate=rate or None,
            strips=Strips(smoothing=smoothing * 1e-3),
            count=conditions,
            seed=seed,
        )
        history = _run(simulation, Store.open(out, simulation.settings()))
        summary = history.summary()
        _write(history, summary, out)
    _show(history, summary)


def _numbers(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(f'--mileages "{text}": numbers in 1e4 km, as 0.2,4.8, expected') from None


def _run(simulation: Simulation, store: Store) -> WearHistory:
    """The history, with a bar on stderr."""
    from wheelset.wear import evolve, history_of

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=error_console(), transient=True) as bar:
        task = bar.add_task("wear", total=1.0)
        passed = []
        for progress in evolve(simulation, store):
            bar.update(task, completed=progress.done)
            passed.append(progress)
    return history_of(simulation, passed)


def _write(history: WearHistory, summary: pd.DataFrame, folder: Path) -> None:
    """Profiles, depths and history, each whole or not at all."""
    from wheelset.wear.store import write_whole

    files = {"depths.csv": history.to_csv(), "history.csv": summary.to_csv(lineterminator="\n")}
    for mileage, profile in history.profiles():
        y, z = profile.points(SPACING)
        rows = "".join(f"{a * 1e3:.6f},{b * 1e3:.6f}\n" for a, b in zip(y, z, strict=True))
        files[f"{profile.name}.csv"] = f"# {profile.source}, {mileage:g}e4 km\ny_mm,z_mm\n{rows}"
    for name, text in files.items():
        write_whole(folder / name, text.encode())
    error_console().print(f"wrote {len(files)} files to {folder}", highlight=False)


def _show(history: WearHistory, summary: pd.DataFrame) -> None:
    s = history.simulation
    columns = ["1e4 km", "depth mm", "at y mm", "band mm", "tan γe 3 mm", "jumps"]
    rows = [
        [
            f"{mileage:g}",
            f"{row.greatest_depth_mm:.4f}",
            f"{row.at_mm:.2f}",
            f"{row.band_from_mm:.1f} .. {row.band_to_mm:.1f}",
            f"{row.conicity_3mm:.4f}".replace("nan", "no wave"),
            f"{row.contact_jumps:.0f}",
        ]
        for mileage, row in zip(summary.index, summary.itertuples(), strict=True)
    ]
    show_table(f"{s.wheel.name} on {s.rail.name}, worn by {s.law.name}", columns, rows, 6)
    Console().print(_words(history), highlight=False, soft_wrap=True)


def _words(history: WearHistory) -> str:
    if history.simulation.field_rate is None:
        return "the law as published, not calibrated"
    return (
        f"calibrated: the law times {history.factor:.4g}; depth at the last mileage is put in, "
        "its shape and growth are computed"
    )
