"""A trajectory: accepted states, dense output, events, and how it ended."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.integration.endings import Ending
from wheelset.bifurcation.integration.events import Event
from wheelset.bifurcation.integration.plan import Plan
from wheelset.bifurcation.integration.step import Step

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The solution of x' = f(x, p) from t[0] to t[-1].

    t: (points,), s. x: (points, n), in the states' units; corners and both ends are points.
    events: in the order of time. outcome: how it ended. steps: the polynomials between points.
    plan: what was integrated and how, from which ``extend`` goes on.
    """

    t: Array
    x: Array
    events: tuple[Event, ...]
    outcome: Ending
    steps: tuple[Step, ...]
    plan: Plan

    def __call__(self, t: ArrayLike) -> Array:
        """States at any times inside, shape t.shape + (n,).

        Raises ValueError, naming the range, for a time outside.
        """
        times = np.asarray(t, dtype=np.float64)
        flat = times.reshape(-1)
        self._check_inside(flat)
        states = np.empty((len(flat), self.x.shape[1]))
        piece = np.clip(np.searchsorted(self.t, flat, side="right") - 1, 0, None)
        for k in np.unique(piece):
            chosen = piece == k
            last = k == len(self.steps)
            states[chosen] = self.x[k] if last else self.steps[k].dense(flat[chosen]).T
        return states.reshape((*times.shape, self.x.shape[1]))

    def _check_inside(self, times: Array) -> None:
        outside = times[~((times >= self.t[0]) & (times <= self.t[-1]))]
        if len(outside):
            raise ValueError(
                f"t = {outside[0]:.9g} is outside {self.t[0]:.9g} .. {self.t[-1]:.9g} s; "
                "ask inside, or go on with extend()"
            )

    def state(self, name: str) -> Array:
        """One state at the accepted points, (points,); ValueError with the names there are."""
        names = self.plan.system.state_names
        if name not in names:
            raise ValueError(f"unknown state {name!r}; there are {', '.join(names)}")
        return self.x[:, names.index(name)]

    def to_frame(self, t: ArrayLike | None = None) -> pd.DataFrame:
        """A pandas frame, one column a state, indexed by t [s]: accepted points or given times."""
        import pandas as pd

        times = self.t if t is None else np.asarray(t, dtype=np.float64)
        values = self.x if t is None else self(times)
        names = list(self.plan.system.state_names)
        return pd.DataFrame(values, index=pd.Index(times, name="t"), columns=names)
