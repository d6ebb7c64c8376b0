"""Section 3's motions: Fig. 5, and what the piecewise linear law would have shown.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 3, Fig. 5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from wheelset.bifurcation.integration.endings import ReachedEnd
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.bifurcation.integration.trajectory import Trajectory
from wheelset.hunting import hunting_system
from wheelset.studies.flange_models import Parameters
from wheelset.vehicle.flange import FLANGE_LAWS

#: Flange laws of Fig. 5, and the one that the paper calls close to reality but does not simulate.
FIGURE_5_LAWS = ("none", "quintic")
EXTRA_LAWS = ("piecewise_linear",)

#: Motion below this is called rest, m.
VISIBLE = 1e-5

#: The end of a motion over which its amplitude is taken, s.
LAST = 1.0

_SAMPLES_PER_SECOND = {"quick": 100, "paper": 400}


@dataclass(frozen=True)
class Motion:
    """One motion of a case under a flange law, and how its integration ended."""

    case: int
    law: str
    trajectory: Trajectory

    @property
    def extent(self) -> tuple[float, float]:
        """Lowest and highest y in m over the last second of the motion."""
        t = self.trajectory.t
        late = self.trajectory(np.linspace(max(t[0], t[-1] - LAST), t[-1], 2001))[:, 0]
        return float(late.min()), float(late.max())

    @property
    def amplitude(self) -> float:
        """Half the peak-to-peak motion of the last second, m; 0 for rest anywhere."""
        lowest, highest = self.extent
        return (highest - lowest) / 2

    @property
    def offset(self) -> float:
        """Middle between the extremes of the last second, m; not 0 for rest aside."""
        return sum(self.extent) / 2

    @property
    def completed(self) -> bool:
        """Whether the motion could be followed for the whole duration."""
        return isinstance(self.trajectory.outcome, ReachedEnd)


def hunting_motions(p: Parameters, laws: tuple[str, ...] = FIGURE_5_LAWS) -> tuple[Motion, ...]:
    """Motions from y = initial_displacement at rest, for both cases under each law."""
    return tuple(_motion(p, case, name, law) for case, name in p.cases.items() for law in laws)


def _motion(p: Parameters, case: int, vehicle: str, law: str) -> Motion:
    loaded = p.load(vehicle, rows=[f"flange_law={law}"])
    system = hunting_system(loaded, speed=p.speed)
    start = [p.initial_displacement, 0.0, 0.0, 0.0]
    return Motion(case, law, integrate(system, start, p.duration))


def motion_frame(p: Parameters, motions: tuple[Motion, ...]) -> pd.DataFrame:
    """Sampled motions: case, law, panel, t s, y m, psi rad, yd m/s, psid rad/s."""
    return pd.concat([_sampled(p, motion) for motion in motions], ignore_index=True)


def _sampled(p: Parameters, motion: Motion) -> pd.DataFrame:
    end = motion.trajectory.t[-1]
    count = max(2, round(end * _SAMPLES_PER_SECOND[p.resolution]) + 1)
    frame = motion.trajectory.to_frame(np.linspace(0.0, end, count)).reset_index()
    frame.insert(0, "panel", _panel(motion))
    frame.insert(0, "law", motion.law)
    frame.insert(0, "case", motion.case)
    return frame


def outcome_frame(motions: tuple[Motion, ...]) -> pd.DataFrame:
    """How each motion ended.

    Columns: case, law, panel, title, amplitude m and offset m (half the difference and the middle
    of the extremes of the last second), motion in a word, contacts (times the flange was met, None
    where the law has no corner), ended_at s (NaN: the whole duration), outcome in words.
    """
    return pd.DataFrame([_outcome_row(motion) for motion in motions])


def _outcome_row(motion: Motion) -> dict[str, object]:
    outcome = motion.trajectory.outcome
    return {
        "case": motion.case,
        "law": motion.law,
        "panel": _panel(motion),
        "title": f"case {motion.case}, {FLANGE_LAWS[motion.law].title}",
        "amplitude": motion.amplitude,
        "offset": motion.offset,
        "motion": _word(motion),
        "contacts": contacts(motion),
        "ended_at": float("nan") if motion.completed else outcome.t,
        "outcome": str(outcome),
    }


def _word(motion: Motion) -> str:
    """What the wheelset does in the end, judged at a hundredth of a millimetre."""
    if not motion.completed:
        return "stopped"
    if motion.amplitude > VISIBLE:
        return "hunts"
    return "returns to the centre" if abs(motion.offset) <= VISIBLE else "rests aside"


def _panel(motion: Motion) -> str:
    return f"case {motion.case}, {motion.law}"


def contacts(motion: Motion) -> int | None:
    """How often the wheelset entered the flange: corners passed from inside."""
    if FLANGE_LAWS[motion.law].smooth:
        return None
    corners = [event for event in motion.trajectory.events if event.kind == "corner"]
    return sum(bool(event.state[0] * event.state[2] > 0) for event in corners)
