"""What may happen to a simulation of wear in place of a worn profile, by name."""

from __future__ import annotations

from dataclasses import dataclass


class WearOutcome(ArithmeticError):
    """Base of what may happen in place of wear."""


@dataclass(eq=False)
class PatchNotFound(WearOutcome):
    """No penetration was found at which the strips carry the load.

    load: the normal force, N. penetration: where the search ended, m.
    """

    load: float
    penetration: float

    def __str__(self) -> str:
        return (
            f"no contact patch carries {self.load:.4g} N: the penetration ended at "
            f"{self.penetration * 1e3:.4g} mm; is the gap known far enough beside the contact?"
        )


@dataclass(eq=False)
class ContactLost(WearOutcome):
    """Too many of the displacements have no contact on the profiles.

    share: of the distance run under them. reason: of the first of them.
    """

    share: float
    reason: str

    def __str__(self) -> str:
        return (
            f"{self.share:.1%} of the distance is run where the contact is not known: "
            f"{self.reason}; narrow the displacements of the operation"
        )


@dataclass(eq=False)
class StepTooSmall(WearOutcome):
    """The step that keeps the error below its bound has become too small.

    distance, step: where and how far, km. error: of that step, m.
    """

    distance: float
    step: float
    error: float

    def __str__(self) -> str:
        return (
            f"the step fell to {self.step:.3g} km at {self.distance:.6g} km with an error of "
            f"{self.error * 1e6:.3g} um; loosen the tolerance or widen the smoothing"
        )


@dataclass(eq=False)
class NoWear(WearOutcome):
    """Nothing is removed under these conditions: there is no rate to be scaled."""

    law: str

    def __str__(self) -> str:
        return f"the law {self.law} removes nothing under this operation: no factor can be found"
