"""Jumps of the contact: displacements at which a wheel touches in two places at once.

Between two displacements whose contacts lie further apart than a contact travels smoothly, the
interval is halved, and every half that still holds such a step is halved again, to WIDTH. What is
left of the step then is a jump; a contact that only travels fast has closed it by then.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wheelset.profiles.search import SIDES, Settled, Wheelset

#: Width to which a jump is located, m.
WIDTH = 1e-6

#: Parts into which an interval is divided.
PARTS = 8

#: A step of the contact over the wheel that asks for a closer look, and one that is a jump, m.
SUSPECT, JUMP = 5e-4, 1e-4


@dataclass(frozen=True)
class Jump:
    """At y [m], to 1e-6 m, the contact of a wheel leaves ``u_from`` for ``u_to`` as y grows.

    u: places on the wheel's profile, m. dr_step: by how much the rolling radius jumps, m.
    """

    side: str
    y: float
    u_from: float
    u_to: float
    dr_step: float

    def __str__(self) -> str:
        return (
            f"{self.side} wheel at y = {self.y * 1e3:+.3f} mm: contact jumps from "
            f"{self.u_from * 1e3:.2f} to {self.u_to * 1e3:.2f} mm on the wheel, "
            f"radius by {self.dr_step * 1e3:+.3f} mm"
        )


def closely_settled(wheelset: Wheelset, settled: Settled) -> Settled:
    """With contacts at both ends of every interval, WIDTH or less, that holds a jump."""
    while len(wide := _suspects(settled)):
        width = np.diff(settled.y)[wide, None] / PARTS
        inner = (settled.y[wide, None] + width * np.arange(1, PARTS)).ravel()
        near = np.interp(inner, settled.y, settled.roll)
        settled = settled.joined(wheelset.settle(inner, near))
    return settled


def _suspects(settled: Settled) -> NDArray[np.intp]:
    """Intervals wider than WIDTH over which a contact steps by more than SUSPECT."""
    steps = np.maximum(abs(np.diff(settled.left.u)), abs(np.diff(settled.right.u)))
    return np.flatnonzero((steps > SUSPECT) & (np.diff(settled.y) > WIDTH))


def jumps(settled: Settled, wheelset: Wheelset) -> tuple[Jump, ...]:
    """The jumps among closely settled contacts, by displacement."""
    narrow = np.diff(settled.y) <= WIDTH
    found = []
    for side, wheel in zip(SIDES, (wheelset.left, wheelset.right), strict=True):
        u = getattr(settled, side).u
        for k in np.flatnonzero(narrow & (abs(np.diff(u)) > JUMP)):
            middle = float(0.5 * (settled.y[k] + settled.y[k + 1]))
            before, after = float(u[k]), float(u[k + 1])
            step = float(wheel.curve(after) - wheel.curve(before))
            found.append(Jump(side, middle, before, after, step))
    return tuple(_united(sorted(found, key=lambda jump: (jump.side, jump.y))))


def beside_jumps(settled: Settled) -> NDArray[np.bool_]:
    """The displacements on either side of a jump."""
    step = np.maximum(abs(np.diff(settled.left.u)), abs(np.diff(settled.right.u)))
    jumping = (np.diff(settled.y) <= WIDTH) & (step > JUMP)
    return np.append(jumping, False) | np.append(False, jumping)


def _united(found: list[Jump]) -> list[Jump]:
    """By displacement; one jump for those of a wheel that touch one another."""
    united: list[Jump] = []
    for jump in found:
        before = united[-1] if united else None
        if before and before.side == jump.side and jump.y - before.y < 5 * WIDTH:
            step = before.dr_step + jump.dr_step
            united[-1] = replace(before, u_to=jump.u_to, dr_step=step)
        else:
            united.append(jump)
    return sorted(united, key=lambda jump: jump.y)
