"""Simulated wear of a wheel's profile: patches, slip, laws, operation, and the run over mileage."""

from wheelset.wear.errors import ContactLost, NoWear, PatchNotFound, StepTooSmall, WearOutcome
from wheelset.wear.history import WearHistory, history_of
from wheelset.wear.laws import WEAR_LAWS, WearLaw, wear_law
from wheelset.wear.operation import Curve, Operation
from wheelset.wear.rolling import Strips
from wheelset.wear.simulation import MILEAGES, Progress, Simulation, evolve
from wheelset.wear.stepping import Stepping
from wheelset.wear.store import Store

__all__ = [
    "MILEAGES",
    "WEAR_LAWS",
    "ContactLost",
    "Curve",
    "NoWear",
    "Operation",
    "PatchNotFound",
    "Progress",
    "Simulation",
    "StepTooSmall",
    "Stepping",
    "Store",
    "Strips",
    "WearHistory",
    "WearLaw",
    "WearOutcome",
    "evolve",
    "history_of",
    "wear_law",
]
