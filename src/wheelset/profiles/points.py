"""Points on their way to a profile."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wheelset.profiles.curves import Array
from wheelset.profiles.profile import Kind


@dataclass(frozen=True, eq=False)
class Points:
    """Points of a profile, m: y outward, z down once oriented; what was done to them.

    face: y of a wheel's vertical back face, if one was measured.
    """

    kind: Kind
    y: Array
    z: Array
    notes: tuple[str, ...] = ()
    face: float | None = None

    def noted(self, note: str, y: Array | None = None, z: Array | None = None) -> Points:
        """With another note, and other points if given."""
        y, z = self.y if y is None else y, self.z if z is None else z
        return replace(self, y=y, z=z, notes=(*self.notes, note))

    def only(self, keep: NDArray[np.bool_], note: str) -> Points:
        """Some of the points, if any are left out."""
        return self if keep.all() else self.noted(note, self.y[keep], self.z[keep])
