"""Which contacts occur, and how far the contact formulas may be off there and elsewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from wheelset.profiles import contact_geometry, load_profile
from wheelset.studies import model
from wheelset.studies.contact_formulas import Parameters
from wheelset.studies.contact_formulas_exact import COEFFICIENTS, Array
from wheelset.studies.contact_formulas_model import evaluate
from wheelset.vehicle import ModelOptions
from wheelset.vehicle import quantities as q

_POINTS = {"quick": 121, "paper": 601}

#: What the formulas are said to keep to, relative errors: of Eq. (6) as printed, and of the fits
#: of Kalker's coefficients.
CLAIMED = {"ab": 0.0066, "b/a": 0.055, **dict.fromkeys(COEFFICIENTS, 0.02)}


@dataclass(frozen=True, eq=False)
class _Contacts:
    """A/B of both wheels over displacements, and |y| [m] from which Hertz's formulas are undefined
    (infinite: nowhere).
    """

    of: str
    ratio: Array
    end: float


def visited(p: Parameters) -> pd.DataFrame:
    """Contacts within reach: of, low, high (A/B), k_low, k_high (b/a by Eq. 6), words.

    The first row is the pair of profiles. A vehicle that leaves Hertz's domain within reach has no
    greatest A/B, and words say where that is.
    """
    contacts = [_on_profiles(p), *(_of_vehicle(p, v) for v in p.vehicles)]
    return pd.DataFrame([_range(c, p.reach) for c in contacts])


def _on_profiles(p: Parameters) -> _Contacts:
    y = np.linspace(-p.reach, p.reach, _POINTS[p.resolution])
    found = contact_geometry(load_profile(p.wheel, "wheel"), load_profile(p.rail, "rail"), y=y)
    wheels = (found.left, found.right)
    ratio = np.concatenate([_ratio(wheel.r, wheel.rho, ModelOptions()) for wheel in wheels])
    end = np.abs(np.tile(found.y, 2)[ratio <= 0]).min(initial=np.inf)
    return _Contacts(f"{p.wheel} on {p.rail}", ratio, end)


def _of_vehicle(p: Parameters, name: str) -> _Contacts:
    ends = model.domain(_own(p, name))[["low", "high"]].abs()
    return _Contacts(name, _vehicle_ratio(p, name), float(ends.to_numpy().min()))


def centred_ratio(p: Parameters, name: str) -> float:
    """A/B of a vehicle's left wheel at y = 0."""
    ratio = _vehicle_ratio(p, name)
    return float(ratio[len(ratio) // 4])


def _vehicle_ratio(p: Parameters, name: str) -> Array:
    """A/B of a vehicle's own geometry from -reach to reach, the left wheel first."""
    vehicle, geometry = p.load(name), model.contact_geometry(_own(p, name))
    r, rho = vehicle.values["r0"] + geometry["dr"].to_numpy(), geometry["rho"].to_numpy()
    return _ratio(r, rho, vehicle.options)


def _own(p: Parameters, name: str) -> model.Parameters:
    return model.Parameters(vehicle=name, reach=p.reach, changes=p.changes, resolution=p.resolution)


def _ratio(r: Array, rho: Array, options: ModelOptions) -> Array:
    """A/B by Eq. (5)."""
    A, B = (evaluate(s, {q.r: r, q.rho: rho}, options) for s in (q.A, q.B))
    return np.asarray(A / B)


def _range(contacts: _Contacts, reach: float) -> dict[str, object]:
    inside, words = contacts.ratio > 0, ""
    low, high = contacts.ratio[inside].min(), contacts.ratio[inside].max()
    if contacts.end <= reach:
        high = np.inf
        words = f"leaves the domain of Hertz's formulas at |y| = {1e3 * contacts.end:.2f} mm"
    k = evaluate(q.ratio, {q.A: np.array([low, high]), q.B: 1.0}, ModelOptions())
    ends = {"low": low, "high": high, "k_low": k[0], "k_high": k[1]}
    return {"of": contacts.of, **ends, "words": words}


def bounds(errors: pd.DataFrame, points: pd.DataFrame, where: pd.DataFrame) -> pd.DataFrame:
    """How far the formulas are off: one row a formula, reading and what it is compared with.

    errors: of ``hertz_errors``; points: of ``kalker_points`` at one nu; where: of ``visited``,
    whose first row counts. Columns: quantity, reading, against, over (A/B or b/a), first, last,
    greatest (error of greatest modulus), at, rms, visited (greatest modulus where the profiles
    touch), claimed, from, to (about 1, where the claim holds; missing without a claim).
    """
    profiles, rows = where.iloc[0], []
    keys = ["quantity", "reading", "against"]
    for (quantity, reading, against), group in errors.groupby(keys, sort=False):
        who = {"quantity": quantity, "reading": reading, "against": against, "over": "A/B"}
        claimed = CLAIMED.get(str(quantity)) if reading == "inside" else None
        error = group.set_index("ratio")["error"]
        rows.append({**who, **_bound(error, (profiles["low"], profiles["high"]), claimed)})
    for name, group in points.groupby("coefficient"):
        who = {"quantity": name, "reading": "", "against": "Kalker", "over": "b/a"}
        ends, error = (profiles["k_low"], profiles["k_high"]), group.set_index("k")["error"]
        rows.append({**who, **_bound(error, ends, CLAIMED[str(name)])})
    return pd.DataFrame(rows)


def _bound(error: pd.Series, ends: tuple[float, float], claimed: float | None) -> dict[str, object]:
    place, values = error.index.to_numpy(), error.to_numpy()
    worst = np.abs(values).argmax()
    touched = np.abs(values[(place >= ends[0]) & (place <= ends[1])])
    low, high = _kept(error, claimed) if claimed else (None, None)
    return {
        "first": place[0],
        "last": place[-1],
        "greatest": values[worst],
        "at": place[worst],
        "rms": float(np.sqrt(np.mean(values**2))),
        "visited": touched.max() if touched.size else None,
        "claimed": claimed,
        "from": low,
        "to": high,
    }


def _kept(error: pd.Series, claimed: float) -> tuple[float, float]:
    """The range about 1 in which every error keeps to the claim."""
    place = error.index.to_numpy()
    off = place[error.abs().to_numpy() > claimed]
    below, above = off[off < 1].max(initial=0), off[off > 1].min(initial=np.inf)
    inside = place[(place > below) & (place < above)]
    return float(inside[0]), float(inside[-1])
