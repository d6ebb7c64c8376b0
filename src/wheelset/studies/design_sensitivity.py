"""How both critical speeds move with every parameter: exact derivatives, and ten per cent."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.curves.continuation import both_ways
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.fold_sensitivity import fold_sensitivity
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_sensitivity import hopf_sensitivity
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.studies.design import Reading
from wheelset.studies.first_fold import WIDTH
from wheelset.vehicle.parameters import BY_NAME

#: The change of a tornado chart, a part of the value.
CHANGE = 0.1

#: Coefficients that stay zero by symmetry: differences of left and right.
ASYMMETRIES = ("da", "dc", "dh")


def names_of(reading: Reading) -> tuple[str, ...]:
    """The vehicle's parameters in its equations, without differences of left and right."""
    names = reading.found.system.parameter_names
    return tuple(n for n in names if n in BY_NAME and not n.startswith(ASYMMETRIES))


def sensitivities(reading: Reading) -> pd.DataFrame:
    """Derivatives of both speeds, one row a parameter, the greatest effect on v_non first.

    Columns: parameter, meaning, unit, value (SI), lin and non: dv/d(parameter) [m/s per SI unit],
    lin_change and non_change: that times a tenth of the value [m/s].
    """
    system, names = reading.found.system, names_of(reading)
    lin = hopf_sensitivity(system, reading.hopf, names)
    non = fold_sensitivity(system, reading.cycle, "v", names)
    frame = pd.DataFrame(
        {
            "parameter": names,
            "meaning": [BY_NAME[name].meaning for name in names],
            "unit": [BY_NAME[name].unit for name in names],
            "value": [reading.values[name] for name in names],
            "lin": [lin[name] for name in names],
            "non": [non[name] for name in names],
        }
    )
    for speed in ("lin", "non"):
        frame[f"{speed}_change"] = CHANGE * frame["value"] * frame[speed]
    order = frame["non_change"].abs().sort_values(ascending=False).index
    return frame.loc[order].reset_index(drop=True)


def tornado(reading: Reading, table: pd.DataFrame, most: int) -> pd.DataFrame:
    """Both speeds computed anew with the strongest parameters ten per cent lower and higher.

    table: of ``sensitivities``. Columns: parameter, speed (lin, non), lower, higher: changes of
    the speed [m/s], missing where there is none; tangent: the change by the derivative; words.
    """
    effect = table[["lin_change", "non_change"]].abs().max(axis=1)
    strongest = table.loc[effect.sort_values(ascending=False).index[:most]]
    return pd.DataFrame(
        [row for name in strongest["parameter"] for row in _bars(reading, name, table)]
    )


def _bars(reading: Reading, name: str, table: pd.DataFrame) -> list[dict[str, object]]:
    known = table.set_index("parameter").loc[name]
    value = reading.values[name]
    ends = sorted((value * (1 - CHANGE), value * (1 + CHANGE)), key=abs)
    folds, words = _folds(reading, name, ends)
    speeds = {"lin": _hopf_speeds(reading, name, ends), "non": folds}
    at = {"lin": reading.hopf.value, "non": float(reading.fold.values[0])}
    return [
        {
            "parameter": name,
            "speed": speed,
            "lower": found[0] - at[speed],
            "higher": found[1] - at[speed],
            "tangent": known[f"{speed}_change"],
            "words": words if speed == "non" else "",
        }
        for speed, found in speeds.items()
    ]


def _hopf_speeds(reading: Reading, name: str, values: list[float]) -> list[float]:
    hopf, system = reading.hopf, reading.found.system
    return [
        hopf_point(system.with_values(**{name: v}), "v", hopf.value, hopf.frequency).value
        for v in values
    ]


def _folds(reading: Reading, name: str, values: list[float]) -> tuple[list[float], str]:
    """Speeds of the fold at two values of a parameter, NaN where the curve does not get there."""
    window = {name: (min(values), max(values))}
    width = abs(values[1] - values[0])
    try:
        start = lpc_from_cycle(reading.found.system, reading.cycle, ("v", name), (WIDTH, width))
        curve = both_ways(start.problem, start.u, direction=start.tangent, windows=window)
    except NumericalOutcome as outcome:
        return [np.nan, np.nan], str(outcome)
    return [_at_end(curve, value) for value in values], _words(curve)


def _at_end(curve: Branch, value: float) -> float:
    near = [p.values[0] for p in (curve.points[0], curve.points[-1]) if _same(p.values[1], value)]
    return float(near[0]) if near else np.nan


def _same(a: float, b: float) -> bool:
    return bool(abs(a - b) <= 1e-9 * abs(b))


def _words(curve: Branch) -> str:
    return "; ".join(str(e) for e in (curve.began, curve.ended) if e.kind != "window")


def ranks(tables: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """How the readings rank and sign the parameters: parameter, then a column a reading and speed:
    the change of the speed for ten per cent more, m/s.
    """
    columns = {
        f"{title} {speed}": table.set_index("parameter")[f"{speed}_change"]
        for title, table in tables.items()
        for speed in ("lin", "non")
    }
    frame = pd.DataFrame(columns)
    return frame.loc[frame.abs().max(axis=1).sort_values(ascending=False).index].reset_index()
