"""Both programs on one case, in turns, and what the times say."""

from __future__ import annotations

import re
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.auto07p import AutoFailed, Case, Peer, Problem, Settings
from benchmarks.engine.errors import auto_fold, reference
from benchmarks.engine.study import (
    FORMS,
    FULL_40,
    HALF_10,
    HALF_20,
    TOLERANCE,
    Form,
    Study,
    ours,
    theirs,
)
from wheelset.bifurcation.cycles.cycle_curve import Meshing

#: Both with steps up to this instead: few points, as many as the curve needs.
LONG = 5.0

OURS, EXACT, DIFFERENCES = "ours", "AUTO, exact Jacobians", "AUTO, differences"

#: Whose study, in which form, is compared with whose.
PAIRS = (
    (HALF_20, FULL_40),
    (FULL_40, FULL_40),
    (HALF_20, HALF_20),
    (HALF_10, HALF_10),
)


@dataclass(frozen=True)
class Contender:
    """One program with its settings; ``run`` does the whole study."""

    program: str
    form: Form
    run: Callable[[], Study]
    note: str = ""


@dataclass(frozen=True)
class Rounds:
    """A contender's studies, one a round; or why it gave none."""

    contender: Contender
    studies: Sequence[Study]
    failure: str = ""

    def seconds(self, stage: str) -> list[float]:
        """Of a whole stage, or of the whole "study", round by round."""
        if stage == "study":
            return [sum(map(_whole, s.stages.values())) for s in self.studies]
        return [_whole(s.stages[stage]) for s in self.studies]

    def a_step(self, stage: str) -> list[float]:
        """Seconds of one step, round by round."""
        return [s.stages[stage].seconds / s.stages[stage].steps for s in self.studies]


def _whole(stage) -> float:
    return stage.seconds + stage.preparation


def contenders(case: Case, peer: Peer) -> list[Contender]:
    """All of a case, in the order of a round: ours and AUTO's alternate."""
    made = []
    for form in FORMS:
        made += [
            Contender(OURS, form, partial(ours, case, form)),
            *_autos(case, peer, form),
            Contender(OURS, form, partial(ours, case, form, Meshing()), "automatic accuracy"),
        ]
    exact = peer.using(jacobian=True)
    long = "long steps"
    made.append(Contender(OURS, HALF_20, partial(ours, case, HALF_20, longest=LONG), long))
    made.append(Contender(EXACT, HALF_20, partial(theirs, case, exact, HALF_20, LONG), long))
    return made


def _autos(case: Case, peer: Peer, form: Form) -> Iterable[Contender]:
    for name, jacobian in ((DIFFERENCES, False), (EXACT, True)):
        yield Contender(name, form, partial(theirs, case, peer.using(jacobian=jacobian), form))


def contest(case: Case, folder: Path, rounds: int) -> dict[str, Any]:
    """Studies, their errors and ratios of a case, after one round that is not counted."""
    peer = Peer(
        Problem(case.system, folder, case.free), Settings(scales=case.scales, tolerance=TOLERANCE)
    )
    taking_part = contenders(case, peer)
    met: list[list[Study | str]] = [[] for _ in taking_part]
    for number in range(rounds + 1):
        for contender, results in zip(taking_part, met, strict=True):
            result = _tried(contender)
            if number:
                results.append(result)
    done = [_rounds(c, results) for c, results in zip(taking_part, met, strict=True)]
    best = reference(case)
    other = auto_fold(case, peer)
    return {
        "reference": {
            "fold": best.fold,
            "fold_of_auto": other,
            "relative_difference": [abs(a / b - 1) for a, b in zip(best.fold, other, strict=True)],
            "interpolation": best.error,
        },
        "studies": [_described(r, best) for r in done],
        "ratios": ratios(done),
    }


def _tried(contender: Contender) -> Study | str:
    """The second of two runs in a row, so that the processor's caches hold the contender's own work
    and not the one's before it; or AUTO's last words without the folder they name.
    """
    try:
        contender.run()
        return contender.run()
    except AutoFailed as failure:
        return re.sub(r"[: ]*/\S+", "", str(failure))


def _rounds(contender: Contender, results: Sequence[Study | str]) -> Rounds:
    studies = [r for r in results if isinstance(r, Study)]
    words = [r for r in results if isinstance(r, str)]
    return Rounds(contender, [] if words else studies, words[0] if words else "")


def _described(rounds: Rounds, best) -> dict[str, Any]:
    contender = rounds.contender
    names = {"program": contender.program, "form": str(contender.form), "note": contender.note}
    if rounds.failure:
        return {**names, "failure": rounds.failure}
    study = rounds.studies[-1]
    return {
        **names,
        "intervals_at_the_end": study.intervals,
        **best.of(study),
        "study": _times(rounds.seconds("study")),
        "stages": {name: _stage(rounds, name) for name in study.stages},
    }


def _stage(rounds: Rounds, name: str) -> dict[str, Any]:
    stage = rounds.studies[-1].stages[name]
    return {
        "steps": stage.steps,
        "iterations": stage.iterations,
        "whole": _times(rounds.seconds(name)),
        "a_step": _times(rounds.a_step(name)),
    }


def _times(seconds: Sequence[float]) -> dict[str, float]:
    return {"median_ms": 1e3 * statistics.median(seconds), "least_ms": 1e3 * min(seconds)}


def ratios(done: Sequence[Rounds]) -> list[dict[str, Any]]:
    """How many times longer AUTO takes than we do: medians over the rounds' own ratios."""
    by = {
        (r.contender.program, r.contender.form): r
        for r in done
        if not r.contender.note and not r.failure
    }
    return [
        {
            "ours": str(own),
            "auto": str(other),
            "jacobians": program,
            **_ratio(by, own, other, program),
        }
        for own, other in PAIRS
        for program in (DIFFERENCES, EXACT)
        if (program, other) in by
    ]


def _ratio(by, own: Form, other: Form, program: str) -> dict[str, float]:
    we, they = by[OURS, own], by[program, other]
    return {
        "cycle_step": _median_ratio(they.a_step("cycles"), we.a_step("cycles")),
        "fold_step": _median_ratio(they.a_step("lpc_curve"), we.a_step("lpc_curve")),
        "cycles": _median_ratio(they.seconds("cycles"), we.seconds("cycles")),
        "fold_curve": _median_ratio(they.seconds("lpc_curve"), we.seconds("lpc_curve")),
        "study": _median_ratio(they.seconds("study"), we.seconds("study")),
    }


def _median_ratio(theirs: Sequence[float], ours: Sequence[float]) -> float:
    return statistics.median(a / b for a, b in zip(theirs, ours, strict=True))
