"""What may be different in the paper's program: structural choices, and the values it hides."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import compress, product

#: The vehicle's corrections without a source, set back: a fit without them is the honest one.
UNCORRECTED: tuple[str, ...] = ("f23_factor=1", "spin_cosine_exponent=0", "f0=0")


@dataclass(frozen=True)
class Free:
    """A hidden value that a fit may move, SI: its start and interval, and a typical change.

    logarithmic: the fit moves its logarithm, and ``scale`` is a change of that. natural: between
    what a railway vehicle of steel could have.
    """

    name: str
    start: float
    scale: float
    low: float
    high: float
    natural: tuple[float, float]
    logarithmic: bool = False

    def value(self, t: float) -> float:
        """The value at a coordinate t of the fit; t = 0 is the start."""
        if self.logarithmic:
            return self.start * math.exp(self.scale * t)
        return self.start + self.scale * t

    def coordinate(self, value: float) -> float:
        """The coordinate of a value."""
        if self.logarithmic:
            return math.log(value / self.start) / self.scale
        return (value - self.start) / self.scale

    @property
    def bounds(self) -> tuple[float, float]:
        """The interval as coordinates."""
        return self.coordinate(self.low), self.coordinate(self.high)

    def is_natural(self, value: float) -> bool:
        """Whether a vehicle of steel could have it."""
        return self.natural[0] <= value <= self.natural[1]


#: a1 keeps to what rounds to the printed 0.23. e0 stands for e0 + f0. Loads of 40 to 80 kN, steel,
#: contact angles below 8 degrees and radii of 3 cm and more at the centre are natural.
FREE: tuple[Free, ...] = (
    Free("a1", 0.2266, 5e-4, 0.225, 0.235, (0.225, 0.235)),
    Free("p0", 6000.0, 0.3, 1e3, 2e5, (4e4, 8e4), logarithmic=True),
    Free("e0", 18.0, 0.5, 0.5, 300.0, (0.0, 60.0), logarithmic=True),
    Free("c0", 0.1, 0.1, -0.5, 0.5, (0.0, 0.14)),
    Free("nu", 0.25, 0.1, 0.0, 0.49, (0.25, 0.32)),
    Free("radius_offset", 1e-3, 1e-3, -5e-3, 5e-3, (-1.2e-3, 1.2e-3)),
)

#: The corrections without a source, for a fit that may use them.
CORRECTIONS: tuple[Free, ...] = (
    Free("f23_factor", 1.0, 0.1, 0.5, 2.0, (0.999, 1.001)),
    Free("spin_cosine_exponent", 0.0, 1.0, -4.0, 4.0, (-0.001, 0.001)),
)


@dataclass(frozen=True)
class Variant:
    """A structure of the model: choices of options, and what is free in it.

    choices: option and value; what is not named is as physics and the printed equations say.
    """

    choices: tuple[tuple[str, str], ...]
    free: tuple[Free, ...] = FREE

    @property
    def overrides(self) -> tuple[str, ...]:
        """As overrides of a vehicle."""
        return tuple(f"{option}={value}" for option, value in self.choices)

    @property
    def words(self) -> str:
        """How it departs from the printed equations, the signs aside."""
        departing = [_WORDS[choice] for choice in self.choices if choice in _WORDS]
        if self.free != FREE:
            departing.append("corrections of f23 free")
        return "; ".join(departing) or "as printed"


#: The departures from print. Every option a fit could need is named in every variant, so that a
#: vehicle's own choices do not shine through.
_WORDS = {
    ("lateral_creepage_cosine", "omitted"): "ξy without cosine",
    ("normal_force", "constant"): "N constant",
    ("shape_exponent", "outside"): "0.63 outside",
    ("transverse_curvature", "full"): "B = ρ",
    ("lateral_spin_moment", "minus"): "−f23 ξy in Mz",
    ("spin_moment", "fit"): "C33 of Kalker",
}
_PRINTED = {
    "contact_angle_sign": "physical",
    "lateral_creepage_cosine": "included",
    "normal_force": "vertical",
    "shape_exponent": "inside",
    "transverse_curvature": "half",
    "lateral_spin_moment": "plus",
    "spin_moment": "none",
}

_CROSSED = (
    ("lateral_creepage_cosine", "omitted"),
    ("normal_force", "constant"),
    ("shape_exponent", "outside"),
    ("transverse_curvature", "full"),
)
_ALONE = (("lateral_spin_moment", "minus"), ("spin_moment", "fit"))
#: The signs that print wants.
REVERSED = ("contact_angle_sign", "reversed")


def variant(*departures: tuple[str, str], free: tuple[Free, ...] = FREE) -> Variant:
    """The printed structure with some choices made otherwise."""
    return Variant(tuple({**_PRINTED, **dict(departures)}.items()), free)


def variants(resolution: str) -> tuple[Variant, ...]:
    """The candidates: reversed signs with all departures crossed (quick: none or the first), the
    physical signs with one departure at a time, and the corrections of f23 once.
    """
    if resolution == "quick":
        return variant(REVERSED), variant(), variant(REVERSED, _CROSSED[0])
    crossed = [
        variant(REVERSED, *compress(_CROSSED, taken))
        for taken in product((False, True), repeat=len(_CROSSED))
    ]
    alone = [variant(), *(variant(one) for one in (*_CROSSED, *_ALONE))]
    others = [variant(REVERSED, one) for one in _ALONE]
    corrected = variant(REVERSED, _CROSSED[0], free=(*FREE, *CORRECTIONS))
    return (*crossed, *alone, *others, corrected)
