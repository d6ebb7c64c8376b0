"""What commands over profiles read from the command line alike, and say alike."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from wheelset.profiles import Contact, Profile, Setup
    from wheelset.profiles.smoothing import Smoothing

#: Jumps named one by one.
MOST_JUMPS = 12

Gauge = Annotated[float, typer.Option(help="Track gauge, mm.")]
Cant = Annotated[str, typer.Option(help="Rail inclination: 1:40, 0.025 or 0.")]
BackToBack = Annotated[float, typer.Option(help="Distance of the wheels' back faces, mm.")]
Amplitudes = Annotated[str, typer.Option(help="Amplitudes in mm: 1,2,3 or first:last:step.")]
WheelRight = Annotated[
    str | None, typer.Option(help="Right wheel, if it differs from the left one.")
]
RailRight = Annotated[str | None, typer.Option(help="Right rail, if it differs from the left one.")]
Smooth = Annotated[str, typer.Option(help="Smoothing of files: gcv, none, or the noise in mm.")]
Unit = Annotated[str | None, typer.Option(help="Unit of files: mm, m, cm, um, in.")]
WheelOrigin = Annotated[
    float | None,
    typer.Option(
        help="The y of the taping point in wheel files, mm, outward, if it cannot be found."
    ),
]
RailOrigin = Annotated[
    float | None,
    typer.Option(
        help="The y of the head's middle in rail files, mm, outward, if it cannot be found."
    ),
]


def amplitudes_in_metres(text: str) -> list[float]:
    """Amplitudes in m from ``1,2,3`` or ``1:8:0.5`` in mm."""
    try:
        if ":" in text:
            first, last, step = (float(part) for part in text.split(":"))
            count = int((last - first) / step + 1e-6) + 1
            found = [first + k * step for k in range(count)]
        else:
            found = [float(part) for part in text.split(",")]
    except (ValueError, ZeroDivisionError):
        found = []
    if not found or not all(0.05 <= a <= 20 for a in found):
        raise ValueError(
            f'--amplitudes "{text}": amplitudes in mm between 0.05 and 20 are expected, as 1,2,3 '
            "or first:last:step"
        )
    return [round(a * 1e-3, 9) for a in found]


def inclination(text: str) -> float:
    """A rail's inclination from ``1:40`` or ``0.025``."""
    try:
        one, _, run = text.partition(":")
        return float(one) / float(run) if run else float(one)
    except (ValueError, ZeroDivisionError):
        raise ValueError(f'--cant "{text}": 1:40, 0.025 or 0 is expected') from None


def loaded(
    name: str, kind: Any, smooth: str, unit: str | None, origin: float | None = None
) -> Profile:
    """The packaged profile of that name, or the one in a file; origin: its y there, mm."""
    from wheelset.profiles import load_profile

    how: Smoothing
    if smooth in ("gcv", "none"):
        how = "gcv" if smooth == "gcv" else "none"
    else:
        try:
            how = float(smooth) * 1e-3
        except ValueError:
            raise ValueError(f'--smooth "{smooth}": gcv, none or the noise in mm') from None
    place = None if origin is None else origin * 1e-3
    return load_profile(name, kind, smoothing=how, unit=unit, origin=place)


def named_jumps(contact: Contact, where: str) -> list[str]:
    """The contact's jumps in words, the first MOST_JUMPS one by one; where: the others are."""
    words = [str(jump) for jump in contact.jumps[:MOST_JUMPS]]
    left = len(contact.jumps) - MOST_JUMPS
    return [*words, f"and {left} more{where}"] if left > 0 else words


def distinct(contact: Contact) -> Iterable[Profile]:
    """Left and right profiles, those alike once."""
    return {id(p): p for p in (*contact.wheels, *contact.rails)}.values()


def setup_words(setup: Setup) -> str:
    """How the profiles stand, in a line."""
    motion = "rolls" if setup.roll else "axle level"
    radii = f"{setup.r0 * 1e3:g}"
    if setup.r0_right is not None:
        radii += f" and {setup.r0_right * 1e3:g}"
    if setup.wheel_origin and setup.rail_origin:
        place = f"profile origins at {setup.wheel_origin * 1e3:g} mm"
    else:
        place = (
            f"gauge {setup.gauge * 1e3:g}, back to back {setup.back_to_back * 1e3:g}, "
            f"cant {setup.cant:g}"
        )
    return f"set-up: {place}, r0 {radii} mm, {motion}"
