"""The goals set for the engine, and what was reached.

A ratio is AUTO's time over ours, AUTO's faster way of getting Jacobians taken.
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
        _row(words, name, least, _worst(case["ratios"], own, auto, quantity), "times", True)
        for words, own, auto, quantity, least in RATIOS
        for name, case in cases.items()
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


def _worst(ratios: list[dict[str, Any]], own: str, auto: str, quantity: str) -> float:
    return min(row[quantity] for row in ratios if (row["ours"], row["auto"]) == (own, auto))
