"""When a computed number agrees with a printed one: the rule, in one place.

A difference is measured against ``absolute + relative |published|`` after half a unit of the last
printed digit has been taken off it, because the print says no more.

* Hopf speeds agree within 0.02 m/s and are tolerated within 0.1 m/s, rounding included: a speed is
  printed to 0.01 m/s, and one unit of that beside its rounding is what rounded inputs may cost;
  two parts in a thousand leave the linear model right.
* First Lyapunov coefficients agree within 2 percent: third derivatives of a fitted geometry. 10
  percent leaves sign and size right.
* Cycle bifurcations (LPC, BPC, PD) carry the error of the whole nonlinear model: 0.1 and 0.5 m/s.
* Normal form and second Lyapunov coefficients: 5 and 20 percent. Parameter values at GH points: 1
  and 5 percent.
* A parameter of the model agrees if it rounds to the print, or is within 1e-9 of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Verdict = Literal["agrees", "within tolerance", "differs", "not yet"]
VERDICTS: tuple[Verdict, ...] = ("agrees", "within tolerance", "differs", "not yet")


@dataclass(frozen=True)
class Margin:
    """Allowed difference beyond the rounding of print; ``absolute`` in the item's unit."""

    absolute: float = 0.0
    relative: float = 0.0

    def admits(self, excess: float, published: float) -> bool:
        """Whether a difference exceeding the rounding by ``excess`` is inside the margin."""
        return excess <= self.absolute + self.relative * abs(published)


@dataclass(frozen=True)
class Rule:
    """Margins of the first two verdicts."""

    agrees: Margin
    tolerated: Margin


_CYCLE = Rule(Margin(absolute=0.1), Margin(absolute=0.5))
_NORMAL_FORM = Rule(Margin(relative=0.05), Margin(relative=0.20))
_TEXT = Rule(Margin(relative=0.05), Margin(relative=0.20))

RULES: dict[str, Rule] = {
    "hopf_speed": Rule(Margin(absolute=0.015), Margin(absolute=0.095)),
    "flc": Rule(Margin(relative=0.02), Margin(relative=0.10)),
    "lpc_speed": _CYCLE,
    "bpc_speed": _CYCLE,
    "pd_speed": _CYCLE,
    "nfc": _NORMAL_FORM,
    "slc": _NORMAL_FORM,
    "gh_value": Rule(Margin(relative=0.01), Margin(relative=0.05)),
    "value": Rule(Margin(relative=1e-9), Margin(relative=1e-9)),
    "amplitude": _TEXT,
    "lpc_drop": _TEXT,
    "lpc_change": _TEXT,
    "stiffness_spread": _TEXT,
}


def verdict(quantity: str, published: float, computed: float, rounding: float) -> Verdict:
    """The verdict on ``computed``; ``rounding`` is half a unit of the last printed digit."""
    rule = RULES[quantity]
    excess = max(0.0, abs(computed - published) - rounding * (1 + 1e-9))
    if rule.agrees.admits(excess, published):
        return "agrees"
    if rule.tolerated.admits(excess, published):
        return "within tolerance"
    return "differs"
