"""What a simulation of wear found: depths by mileage, and what they do to the contact."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.integrate import trapezoid

from wheelset import __version__
from wheelset.profiles import ContactOutcome, Profile, contact_geometry, equivalent_conicity
from wheelset.profiles.worn import worn
from wheelset.wear.patch import Array
from wheelset.wear.simulation import MILEAGE, Progress, Simulation

#: Share of the greatest depth that bounds the wear band, and the amplitude of the conicity, m.
BAND, AMPLITUDE = 0.1, 3e-3


@dataclass(frozen=True, eq=False)
class WearHistory:
    """Depths of wear, vertical, m: ``depth`` (mileages, places) over y [m].

    rates: of depth, alike, m/m. factor: what the law was multiplied by. steps: accepted ones.
    error: greatest of a step, m.
    """

    simulation: Simulation
    y: Array
    depth: Array
    rates: Array
    factor: float
    steps: int
    error: float

    @property
    def mileages(self) -> tuple[float, ...]:
        """1e4 km, ascending."""
        return self.simulation.mileages

    def profiles(self) -> Iterator[tuple[float, Profile]]:
        """Mileage [1e4 km] and worn wheel."""
        wheel, law = self.simulation.wheel, self.simulation.law.name
        for mileage, depth in zip(self.mileages, self.depth, strict=True):
            name = f"{wheel.name}@{mileage:g}-{law}"
            yield mileage, worn(wheel, self.y, depth, name, f"worn by simulation, {law}")

    def to_frame(self) -> pd.DataFrame:
        """Depth [mm] by mileage over y [mm]: the table of the packaged files."""
        names = [f"depth_mm_{mileage:g}" for mileage in self.mileages]
        index = pd.Index(np.round(self.y * 1e3, 9), name="y_mm")
        return pd.DataFrame(self.depth.T * 1e3, index=index, columns=names)

    def to_csv(self) -> str:
        """The file of depths, with a header that says how they were made."""
        header = "".join(f"# {line}\n" for line in self.words())
        return header + self.to_frame().to_csv(float_format="%.9f", lineterminator="\n")

    def words(self) -> Iterator[str]:
        """How the depths were made, in lines."""
        s = self.simulation
        yield f"Simulated wear of {s.wheel.name} on {s.rail.name}; not measured."
        yield "depth_mm_M: z of the new wheel less z of the worn one at M x 1e4 km, mm"
        yield f"made by wheelset {__version__}: {self.command()}"
        if s.field_rate is None:
            yield "calibration: none, the law as published"
        else:
            yield (
                f"calibration: the law times {self.factor:.9g}, so that the greatest depth at "
                f"{s.mileages[-1]:g} x 1e4 km is that of {s.field_rate:g} mm per 1e4 km"
            )
        for name, value in s.settings().items():
            yield f"{name}: {json.dumps(value)}"

    def command(self) -> str:
        """The command that makes them with the default operation, set-up and steps."""
        s = self.simulation
        mileages = ",".join(f"{mileage:g}" for mileage in s.mileages)
        return (
            f"wheelset wear {s.wheel.name} {s.rail.name} --law {s.law.name} --mileages {mileages} "
            f"--rate {s.field_rate or 0:g} --conditions {s.count} --seed {s.seed} "
            f"--smoothing {s.strips.smoothing * 1e3:g} --out FOLDER"
        )

    def summary(self) -> pd.DataFrame:
        """A row a mileage: depths, band, rate, conicity and contact jumps, in mm and 1e4 km.

        The conicity is missing (NaN) where the worn wheel has no wave of that amplitude.
        """
        rows = [
            {**self._depths(k), **self._contact(profile)}
            for k, (_, profile) in enumerate(self.profiles())
        ]
        return pd.DataFrame(rows, index=pd.Index(self.mileages, name="mileage_1e4km"))

    def _depths(self, k: int) -> dict[str, float]:
        depth, y = self.depth[k], self.y * 1e3
        band = y[depth > BAND * depth.max()]
        return {
            "greatest_depth_mm": depth.max() * 1e3,
            "at_mm": y[depth.argmax()],
            "depth_at_taping_mm": float(np.interp(0.0, self.y, depth)) * 1e3,
            "band_from_mm": band[0],
            "band_to_mm": band[-1],
            "removed_mm2": float(trapezoid(depth, self.y)) * 1e6,
            "greatest_rate_mm_per_1e4km": self.rates[k].max() * MILEAGE * 1e3,
        }

    def _contact(self, wheel: Profile) -> dict[str, float]:
        s = self.simulation
        contact = contact_geometry(wheel, s.rail, s.setup, trim=True)
        try:
            conicity = equivalent_conicity(contact, AMPLITUDE).integration
        except ContactOutcome:
            conicity = np.nan
        return {"conicity_3mm": conicity, "contact_jumps": len(contact.jumps)}


def history_of(simulation: Simulation, progress: Iterable[Progress]) -> WearHistory:
    """The history of a simulation that is run to its end."""
    every = list(progress)
    run, asked = ([p.state for p in every if p.stage == stage] for stage in ("run", "asked"))
    factor = run[-1].distance / (simulation.mileages[-1] * MILEAGE)
    return WearHistory(
        simulation,
        simulation.strips.y,
        np.array([state.depth for state in asked]),
        np.array([state.rate for state in asked]) * factor,
        factor,
        run[-1].number,
        max(state.error for state in run),
    )
