"""Commands over the physics: ``vehicles``, ``hopf``, ``simulate``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console

from wheelset.cli.errors import clear_errors, error_console
from wheelset.cli.tables import show_json, show_table

if TYPE_CHECKING:
    from wheelset.bifurcation.integration.trajectory import Trajectory
    from wheelset.vehicle import Vehicle

#: Spacing of the rows of a CSV file, s; the time at the end that counts as late, s.
SAMPLE, LAST = 1e-3, 1.0
MOST_EVENTS = 20

#: Kinds of events that say more than the ending does; corners are contacts under another name.
SHOWN = ("crossing", "entered", "left")

VehicleName = Annotated[
    str, typer.Argument(metavar="VEHICLE", help="A packaged name, or the path of a TOML file.")
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", help="name=value[ unit], e.g. a1=0.3; may be given several times."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")]


def vehicles(
    name: Annotated[
        str | None, typer.Argument(metavar="[VEHICLE]", help="Show this one in full.")
    ] = None,
    overrides: Overrides = None,
    as_json: AsJson = False,
) -> None:
    """List the packaged vehicles, or every number of one with its unit and source."""
    from wheelset.vehicle import VehicleError, load_vehicle, vehicle_names

    with clear_errors(VehicleError):
        if name is None:
            _list_vehicles([load_vehicle(known) for known in vehicle_names()], as_json)
        else:
            _show_vehicle(load_vehicle(name, overrides or ()), as_json)


def _list_vehicles(known: list[Vehicle], as_json: bool) -> None:
    if as_json:
        show_json([{"name": v.name, "title": v.title} for v in known])
    else:
        show_table("Packaged vehicles", ["name", "title"], [(v.name, v.title) for v in known])


def _show_vehicle(vehicle: Vehicle, as_json: bool) -> None:
    options = vehicle.options.model_dump()
    if as_json:
        rows = [row._asdict() for row in vehicle.table()]
        show_json({"name": vehicle.name, "options": options, "quantities": rows})
        return
    Console().print(f"[bold]{vehicle.title}[/]\n{vehicle.description.strip()}\n")
    show_table("Model", ["option", "value"], options.items())
    columns = ["", "value", "unit", "status", "source", "meaning"]
    show_table(
        "Parameters",
        columns,
        [
            (r.name, f"{r.value:.8g}", r.unit, r.status, r.source, r.meaning)
            for r in vehicle.table()
        ],
    )


def hopf(
    name: VehicleName,
    overrides: Overrides = None,
    v_min: Annotated[float, typer.Option(min=0.1, help="Lowest speed, m/s.")] = 5.0,
    v_max: Annotated[float, typer.Option(help="Highest speed, m/s.")] = 200.0,
    as_json: AsJson = False,
) -> None:
    """Find every speed at which straight running changes its stability.

    Hopf points come with their frequency and first Lyapunov coefficient (FLC, MATCONT's
    normalisation in SI units): negative is supercritical, positive subcritical.
    """
    from wheelset.bifurcation.equilibria.hopf import instabilities
    from wheelset.bifurcation.outcomes import NumericalOutcome
    from wheelset.hunting import hunting_system
    from wheelset.vehicle import load_vehicle

    with clear_errors(NumericalOutcome, exit_code=1), clear_errors(ValueError):
        system = hunting_system(load_vehicle(name, overrides or ()))
        points = instabilities(system, "v", (v_min, v_max))
    if as_json:
        show_json([_point_record(point) for point in points])
    elif points:
        columns = ["v m/s", "km/h", "Hz", "FLC", "kind", "what happens"]
        show_table(f"{name}: stability of straight running", columns, map(_point_row, points), 4)
    else:
        Console().print(f"{name}: no change of stability between {v_min:g} and {v_max:g} m/s")


def _point_record(point: Any) -> dict[str, Any]:
    return {
        "kind": point.kind,
        "speed": point.value,
        "frequency": getattr(point, "frequency", None),
        "lyapunov": getattr(point, "lyapunov", None),
        "state": list(point.state),
        "unstable_below_above": list(point.unstable),
        "words": point.words,
        "reason": getattr(point, "reason", ""),
    }


def _point_row(point: Any) -> list[str]:
    record = _point_record(point)
    frequency, lyapunov = record["frequency"], record["lyapunov"]
    return [
        f"{point.value:.4f}",
        f"{point.value * 3.6:.2f}",
        "" if frequency is None else f"{frequency / 6.283185307179586:.4f}",
        "" if lyapunov is None else f"{lyapunov:.6g}",
        point.kind,
        point.words,
    ]


def simulate(
    name: VehicleName,
    speed: Annotated[float, typer.Option(min=0.1, help="Running speed, m/s.")],
    y0: Annotated[float, typer.Option(help="Initial lateral displacement, m.")] = 0.005,
    psi0: Annotated[float, typer.Option(help="Initial yaw angle, rad.")] = 0.0,
    duration: Annotated[float, typer.Option(min=1e-3, help="Simulated time, s.")] = 5.0,
    overrides: Overrides = None,
    method: Annotated[str, typer.Option(help="DOP853, RK45, Radau, BDF or LSODA.")] = "DOP853",
    settle: Annotated[
        bool, typer.Option("--settle", help="Stop when an equilibrium or a cycle is reached.")
    ] = False,
    csv: Annotated[
        Path | None, typer.Option(help="Write the motion, every millisecond, to this file.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Run the wheelset down straight track from a disturbance and say what becomes of it."""
    from wheelset.bifurcation.integration.integrate import integrate
    from wheelset.hunting import flange_contact, hunting_system
    from wheelset.vehicle import load_vehicle

    with clear_errors(ValueError):
        vehicle = load_vehicle(name, overrides or ())
        trajectory = integrate(
            hunting_system(vehicle, speed=speed),
            [y0, psi0, 0.0, 0.0],
            duration,
            method=method,
            events=flange_contact(vehicle),
            stop_when_settled=settle,
        )
    if csv:
        with clear_errors(OSError):
            _write_csv(trajectory, csv)
    record = _trajectory_record(trajectory)
    if as_json:
        show_json(record)
    else:
        _show_trajectory(f"{name} at {speed:g} m/s, y(0) = {y0 * 1e3:g} mm", record)
    if record["failed"]:
        raise typer.Exit(1)


def _write_csv(trajectory: Trajectory, path: Path) -> None:
    """The sampled motion, SI units; written beside and moved, so that no half file is left."""
    import numpy as np

    t = trajectory.t
    samples = np.append(np.arange(t[0], t[-1], SAMPLE), t[-1])
    part = path.with_name(path.name + ".part")
    trajectory.to_frame(samples).to_csv(part)
    part.replace(path)
    error_console().print(f"wrote {path}: {len(samples)} rows, SI units", highlight=False)


def _trajectory_record(trajectory: Trajectory) -> dict[str, Any]:
    from wheelset.bifurcation.integration.endings import (
        ReachedEnd,
        SettledToCycle,
        SettledToEquilibrium,
    )

    outcome = trajectory.outcome
    late = trajectory.t >= trajectory.t[-1] - LAST
    record: dict[str, Any] = {
        "outcome": outcome.kind,
        "words": str(outcome),
        "failed": not isinstance(outcome, ReachedEnd | SettledToCycle | SettledToEquilibrium),
        "t_end": float(trajectory.t[-1]),
        "largest_y": float(abs(trajectory.x[:, 0]).max()),
        "largest_y_in_last_second": float(abs(trajectory.x[late, 0]).max()),
        "events": [{"t": e.t, "what": e.what} for e in trajectory.events if e.kind in SHOWN],
    }
    if isinstance(outcome, SettledToCycle):
        record["cycle"] = {"period": outcome.period, "amplitude_y": float(outcome.amplitude[0])}
    return record


def _show_trajectory(title: str, record: dict[str, Any]) -> None:
    rows = [
        ("ending", record["words"]),
        ("largest |y|", f"{record['largest_y'] * 1e3:.4f} mm"),
        ("largest |y| in the last second", f"{record['largest_y_in_last_second'] * 1e3:.4f} mm"),
    ]
    if cycle := record.get("cycle"):
        rows.append(("cycle", f"{cycle['amplitude_y'] * 1e3:.4f} mm, {1 / cycle['period']:.4f} Hz"))
    show_table(title, ["", ""], rows)
    events = record["events"]
    if events:
        shown = [(f"{e['t']:.6f}", e["what"]) for e in events[:MOST_EVENTS]]
        more = f", the first {MOST_EVENTS} of {len(events)}" if len(events) > MOST_EVENTS else ""
        show_table(f"Events{more}", ["t s", "what"], shown, 1)
