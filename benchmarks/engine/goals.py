"""The goals set for the engine, and what was reached.

A ratio is AUTO's time over ours: of AUTO as its users run it, with Jacobians by differences, and of
AUTO with the exact Jacobians that are written for it here.
"""

from __future__ import annotations

from typing import Any

#: What, our form, AUTO's form, quantity, at least so many times faster. Half the intervals do for
#: half the period, so the first and the last two rows compare equal accuracy.
RATIOS = (
    ("cycle step beside AUTO's full period", "half 20", "full 40", "cycle_step", 5.0),
    ("cycle step beside AUTO's half period", "half 20", "half 20", "cycle_step", 3.0),
    ("step of the fold curve beside AUTO's full period", "half 20", "full 40", "fold_step", 20.0),
    ("step of the fold curve beside AUTO's half period", "half 20", "half 20", "fold_step", 10.0),
    ("whole study beside AUTO's full period", "half 20", "full 40", "study", 5.0),
)

#: Of the whole process, nothing compiled before; of the process with everything compiled.
COLD_SECONDS, MEGABYTES = 30.0, 500.0

#: Exponent of the cost against intervals that still counts as linear.
LINEAR = 1.1


def goals(cases: dict[str, Any], cold: dict[str, Any], lines: list[Any]) -> list[dict[str, Any]]:
    """One row a goal and case: goal, case, wanted, reached, met; ``atleast`` or at most."""
    rows = [
        _row(words, f"{name}, {jacobians}", least, reached, "times", True)
        for words, own, auto, quantity, least in RATIOS
        for name, case in cases.items()
        for jacobians, reached in _ratios(case["ratios"], own, auto, quantity)
    ]
    memory = max(cold["cold"]["peak_mb"], cold["cached"]["peak_mb"])
    rows.append(_row("cold start", "paper", COLD_SECONDS, cold["cold"]["process_s"], "s", False))
    rows.append(_row("memory", "paper", MEGABYTES, memory, "MB", False))
    for line in lines:
        words = f"exponent of the cost against intervals, {line['of']}"
        rows.append(_row(words, "paper", LINEAR, line["exponent"], "", False))
    return rows


def _row(
    words: str, case: str, wanted: float, reached: float, unit: str, at_least: bool
) -> dict[str, Any]:
    met = reached >= wanted if at_least else reached <= wanted
    return {
        "goal": words,
        "case": case,
        "at_least": at_least,
        "wanted": wanted,
        "reached": reached,
        "unit": unit,
        "met": met,
    }


def _ratios(
    ratios: list[dict[str, Any]], own: str, auto: str, quantity: str
) -> list[tuple[str, float]]:
    """How AUTO gets its Jacobians, and its time over ours."""
    return [
        (row["jacobians"].removeprefix("AUTO, "), row[quantity])
        for row in ratios
        if (row["ours"], row["auto"]) == (own, auto)
    ]
