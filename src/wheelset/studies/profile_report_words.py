"""What a report on profiles comes to, in sentences made of its numbers."""

from __future__ import annotations

import numpy as np

from wheelset.studies.on_profiles import LowestCycle, lowest_cycle
from wheelset.studies.profile_report import ProfileReport, Speeds

#: Amplitude at which the conicity is named in the conclusion, m.
USUAL = 0.003

#: An equilibrium further from the middle than this is worth a word, m.
OFF_CENTRE = 1e-5


def conclusion(report: ProfileReport) -> tuple[str, ...]:
    """What an engineer would take away, a paragraph each."""
    texts = (_linear(report), _nonlinear(report), _criticality(report), _conicity(report))
    return tuple(text for text in (*texts, _rest(report.chosen)) if text)


def _linear(report: ProfileReport) -> str:
    chosen, (low, high) = report.chosen, report.window
    hopf = chosen.run and chosen.run.hopf
    if chosen.run is None:
        return f"No critical speeds: {chosen.words}."
    if not hopf:
        now = {(True, True): "stable at both ends", (False, False): "unstable at both ends"}
        return (
            f"No Hopf point between {low:g} and {high:g} m/s: straight running is "
            f"{now.get(chosen.stable, 'stable at one end only')} of this window."
        )
    change = "is lost" if hopf.unstable[1] > hopf.unstable[0] else "is gained"
    others = [s.run.hopf.value for s in report.speeds if s.run and s.run.hopf]
    return (
        f"Linear critical speed: the stability of straight running {change} at "
        f"{speed(hopf.value)}, by an oscillation of {hopf.frequency / (2 * np.pi):.2f} Hz "
        f"({min(others):.1f} to {max(others):.1f} m/s with the widths of the average used here)."
    )


def _nonlinear(report: ProfileReport) -> str:
    run = report.chosen.run
    lowest = run and lowest_cycle(run)
    if not (run and run.hopf and lowest):
        return ""
    if lowest.v > run.hopf.value * (1 - 1e-3):
        return (
            "Nonlinear critical speed: the same; no cycle was found below the linear critical "
            "speed, so that there small and large disturbances die out alike, as far as the "
            "cycles were followed."
        )
    return (
        f"Nonlinear critical speed: {_at_most(lowest)}{speed(lowest.v)}, where hunting has an "
        f"amplitude of {lowest.amplitude * 1e3:.1f} mm{_why(lowest)}. Between it and the linear "
        "critical speed it depends on the size of a disturbance whether the wheelset hunts."
    )


def _at_most(lowest: LowestCycle) -> str:
    return "at most " if lowest.bound else ""


def _why(lowest: LowestCycle) -> str:
    """What a bound from above is owed to."""
    if not lowest.bound:
        return ""
    return "; the speed was still falling with growing amplitude where the branch ends"


def _criticality(report: ProfileReport) -> str:
    """What FLC may be trusted with."""
    known = [(s.width, s.run.hopf) for s in report.speeds if s.run and s.run.hopf]
    values = [(w, h.lyapunov) for w, h in known if h.lyapunov is not None]
    if not values:
        return ""
    listed = ", ".join(
        f"{value:.3g} at {width * 1e3:g} mm".replace("-", "−") for width, value in values
    )
    listed = listed.replace("-", "−")
    one_sign = len({value > 0 for _, value in values}) == 1
    kind = "subcritical" if values[0][1] > 0 else "supercritical"
    trust = (
        f"All say {kind}; the size is that of the average, not of the wheel"
        if one_sign
        else "Its sign changes with the width: these profiles do not say whether small cycles are "
        "born stable or unstable"
    )
    return (
        f"First Lyapunov coefficient (FLC, 1/s) by width of the average: {listed}. {trust}. The "
        "coefficient is a third derivative of measured or piecewise curves in the middle; the "
        "cycles' speeds over their amplitudes, in the diagram, are what to rely on."
    )


def _conicity(report: ProfileReport) -> str:
    rows = report.conicity.rows
    if not rows:
        return f"No equivalent conicity: {report.conicity.missing[0]}."
    row = min(rows, key=lambda r: abs(r.amplitude - USUAL))
    words = f"Equivalent conicity {row.integration:.3f} at {row.amplitude * 1e3:g} mm"
    slope = report.conicity.nonlinearity
    if slope is None:
        return words + "."
    trend = "falls" if slope < 0 else "grows"
    return f"{words}; from 2 to 4 mm it {trend}, by {slope * 1e-3:+.4f} per mm.".replace("-", "−")


def _rest(chosen: Speeds) -> str:
    if not chosen.run or (abs(chosen.rest) < OFF_CENTRE and not chosen.others):
        return ""
    side = "left" if chosen.rest > 0 else "right"
    words = "The wheelset rests in the middle"
    if abs(chosen.rest) >= OFF_CENTRE:
        words = (
            f"The wheelset does not rest in the middle but {abs(chosen.rest) * 1e3:.2f} mm to the "
            f"{side}; all speeds are those of this state"
        )
    if chosen.others:
        places = ", ".join(f"{y * 1e3:+.2f}" for y in chosen.others)
        words += f". It could also rest at y = {places} mm"
    return words + "."


def speed(v: float) -> str:
    """A speed [m/s] in both units."""
    return f"{v:.1f} m/s ({v * 3.6:.0f} km/h)"
