"""The measurement itself: ``python -m benchmarks.engine ROUNDS``, with one thread set outside."""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.auto07p import paper, toy
from benchmarks.engine.cold import cold_start
from benchmarks.engine.contest import contest
from benchmarks.engine.costs import against_intervals, against_size, breakdown, line
from benchmarks.engine.goals import goals
from benchmarks.engine.machine import described
from benchmarks.engine.report import show
from benchmarks.engine.study import FORMS

RESULTS = Path(__file__).parents[1] / "results" / "engine.json"


def measure(rounds: int) -> dict[str, Any]:
    cases = {}
    for case in (toy(), paper()):
        with tempfile.TemporaryDirectory() as folder:
            cases[case.name] = contest(case, Path(folder), rounds)
    intervals = against_intervals(paper())
    lines = [line(intervals, of) for of in ("cycle", "fold")]
    cold = cold_start(paper())
    return {
        "machine": described(),
        "rounds": rounds,
        "cases": cases,
        "against_intervals": intervals,
        "cost_lines": lines,
        "against_size": against_size(),
        "breakdown": {str(form): breakdown(paper(), form) for form in FORMS},
        "cold_start": cold,
        "goals": goals(cases, cold, lines),
    }


def main() -> None:
    record = measure(int(sys.argv[1]))
    show(record)
    RESULTS.parent.mkdir(exist_ok=True)
    RESULTS.write_text(json.dumps(record, indent=1) + "\n")
    print(f"stored in {RESULTS.relative_to(RESULTS.parents[2])}")


if __name__ == "__main__":
    main()
