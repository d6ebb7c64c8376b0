"""The benchmark's record in print."""

from __future__ import annotations

from typing import Any


def show(record: dict[str, Any]) -> None:
    for name, case in record["cases"].items():
        print(f"\n{name}: median ms over {record['rounds']} rounds, relative errors")
        print(
            f"{'':48s}{'cycle step':>18s}{'fold step':>18s}{'study':>9s}{'fold':>9s}{'curve':>9s}"
        )
        for study in case["studies"]:
            print(_study(study))
        print(f"\n{name}: AUTO's time over ours")
        for row in case["ratios"]:
            words = f"{row['ours']} beside {row['auto']}, {row['jacobians']}"
            print(
                f"  {words:52s} cycle step {row['cycle_step']:6.2f}  fold step "
                f"{row['fold_step']:6.2f}  study {row['study']:6.2f}"
            )
    _costs(record)
    print("\ngoals")
    for goal in record["goals"]:
        side = "at least" if goal["at_least"] else "at most"
        print(
            f"  {'met   ' if goal['met'] else 'missed'} {goal['goal']:52s} {goal['case']:6s} "
            f"{goal['reached']:8.3g} {goal['unit']:5s} ({side} {goal['wanted']:g})"
        )


def _study(study: dict[str, Any]) -> str:
    words = f"  {study['program']}, {study['form']} {study['note']}".rstrip()
    if "failure" in study:
        return f"{words:48s} {study['failure']}"
    steps = "".join(
        f"{stage['a_step']['median_ms']:10.3f} x {stage['steps']:5d}"
        for stage in (study["stages"][name] for name in ("cycles", "lpc_curve"))
    )
    return (
        f"{words:48s}{steps}{study['study']['median_ms']:9.1f}"
        f"{study['fold_speed_error']:9.1e}{study['curve_error']:9.1e}"
    )


def _costs(record: dict[str, Any]) -> None:
    for line in record["cost_lines"]:
        print(
            f"\n{line['of']}: {line['ms_for_nothing']:.3f} ms + {line['ms_an_interval']:.5f} ms an "
            f"interval, exponent {line['exponent']:.2f}"
        )
    for row in record["against_size"]:
        print(f"n = {row['n']:2d}: {row['linearised']:.3f} + {row['solved']:.3f} ms")
    for form, walks in record["breakdown"].items():
        for walk, parts in walks.items():
            named = {k.removesuffix("_ms"): v for k, v in parts.items() if k.endswith("_ms")}
            print(f"{form}, {walk}: " + ", ".join(f"{k} {v:.3f}" for k, v in named.items()))
    for name, figures in record["cold_start"].items():
        print(f"{name}: " + ", ".join(f"{k} {v:.4g}" for k, v in figures.items()))
