"""The paper's figures: panels, axis windows, pages.

A window is what a panel shows, so that ours can be laid beside the paper's. Units are those of
the axis label.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Axis:
    """Label with unit, and the range shown, in that unit."""

    label: str
    low: float
    high: float


@dataclass(frozen=True)
class Panel:
    """One panel of a figure. ``x`` and ``y`` are None for a sketch."""

    figure: int
    name: str
    page: int
    shows: str
    x: Axis | None = None
    y: Axis | None = None

    @property
    def label(self) -> str:
        """As the book names it: ``Fig. 7: a``."""
        return f"Fig. {self.figure}: {self.name}" if self.name else f"Fig. {self.figure}"


def panel(figure: int, name: str = "") -> Panel:
    """The panel of that figure and name; KeyError if the paper has none."""
    for one in PANELS:
        if (one.figure, one.name) == (figure, name):
            return one
    raise KeyError(f'Fig. {figure} has no panel "{name}"')


def _mm(low: float, high: float, label: str = "yw/mm") -> Axis:
    return Axis(label, low, high)


def _force(high: float) -> Axis:
    return Axis("force/kN", -high, high)


def _speed(low: float, high: float) -> Axis:
    return Axis("v/(m/s)", low, high)


_STIFF_X = Axis("Kpx/(MN/m)", 0, 1.5)
_STIFF_Y = Axis("Kpy/(MN/m)", 0, 3)
_HOPF = "Hopf speed over "
_LPC = "Hopf and LPC speeds over "

# fmt: off
PANELS: tuple[Panel, ...] = (
    Panel(1, "", 991, "sketch: wheelset and primary suspension"),
    Panel(2, "", 992, "sketch: curvatures at the contact point"),
    Panel(3, "", 992, "sketch: contact geometry and axes"),
    Panel(4, "piecewise linear", 997, "flange force, Eq. (24)", _mm(-15, 15), _force(100)),
    Panel(4, "polynomial", 997, "flange force, Eq. (25)", _mm(-15, 15), _force(100)),
    Panel(4, "exponential", 997, "flange force, Eq. (26)", _mm(-15, 15), _force(100)),
    Panel(4, "reciprocal", 997, "flange force, Eq. (27)", _mm(-15, 15), _force(10)),
    *(
        Panel(5, f"case {case}, {flange}", 997, "motion at v = 40 m/s from y = 10 mm",
              Axis("time/s", 0, 5), _mm(-12, 12))
        for case in (1, 2) for flange in ("none", "polynomial")
    ),
    Panel(6, "case 1, none", 998, "cycle amplitude", _speed(50, 65), _mm(0, 15)),
    Panel(6, "case 1, polynomial", 998, "cycle amplitude", _speed(25, 60), _mm(0, 15)),
    Panel(6, "case 1, exponential", 998, "cycle amplitude", _speed(50, 65), _mm(0, 15)),
    Panel(6, "case 1, reciprocal", 998, "cycle amplitude", _speed(50, 65), _mm(0, 15)),
    Panel(6, "case 2, none", 998, "cycle amplitude", _speed(50, 60), _mm(0, 15)),
    Panel(6, "case 2, polynomial", 998, "cycle amplitude", _speed(25, 60), _mm(0, 15)),
    Panel(6, "case 2, exponential", 998, "cycle amplitude", _speed(50, 60), _mm(0, 15)),
    Panel(6, "case 2, reciprocal", 998, "cycle amplitude", _speed(50, 55), _mm(0, 15)),
    Panel(7, "a", 999, f"{_HOPF}a1", Axis("a1", 0, 3), _speed(0, 500)),
    Panel(7, "b", 999, f"{_HOPF}a3", Axis("a3", -4e5, 4e5), _speed(51, 52)),
    Panel(7, "c", 999, f"{_HOPF}c1", Axis("c1", -2000, 3000), _speed(46, 60)),
    Panel(7, "d", 999, f"{_HOPF}c3", Axis("c3", -4e6, 4e6), _speed(51, 52)),
    Panel(7, "e", 999, f"{_HOPF}e1", Axis("e1", -1000, 1000), _speed(50, 56)),
    Panel(7, "f", 999, f"{_HOPF}e3", Axis("e3", -6e5, 6e5), _speed(51, 52)),
    Panel(7, "g", 999, f"{_HOPF}f1", Axis("f1", -1200, 1200), _speed(50, 53)),
    Panel(7, "h", 999, f"{_HOPF}f3", Axis("f3", -4e6, 4e6), _speed(51, 52)),
    Panel(8, "a", 1000, f"{_LPC}a1", Axis("a1", 0, 1), _speed(0, 200)),
    Panel(8, "b", 1000, f"{_LPC}a3", Axis("a3", -1e3, 5e3), _speed(25, 55)),
    Panel(8, "c", 1000, f"{_LPC}c1", Axis("c1", -200, 200), _speed(40, 70)),
    Panel(8, "d", 1000, f"{_LPC}c3", Axis("c3", -3e5, 3e5), _speed(50.6, 51.8)),
    Panel(8, "e", 1000, f"{_LPC}e1", Axis("e1", -2500, 1000), _speed(40, 55)),
    Panel(8, "f", 1000, f"{_LPC}e3", Axis("e3", -1e5, 1e5), _speed(51.4, 51.8)),
    Panel(8, "g", 1000, f"{_LPC}f1", Axis("f1", -2500, 1500), _speed(40, 55)),
    Panel(8, "h", 1000, f"{_LPC}f3", Axis("f3", 6.3e6, 6.7e6), _speed(51, 52)),
    Panel(9, "a", 1001, "worn wheel profiles", _mm(-60, 60, "y/mm"), _mm(-10, 30, "z/mm")),
    Panel(9, "b", 1001, "worn wheel profiles, enlarged",
          _mm(-15, 15, "y/mm"), _mm(-1.5, 1.5, "z/mm")),
    Panel(10, "a", 1002, "rolling radius", _mm(-6, 6), Axis("r/m", 0.459, 0.462)),
    Panel(10, "b", 1002, "equivalent conicity", _mm(0, 14), Axis("equivalent conicity", 0, 0.8)),
    Panel(10, "c", 1002, "contact angle", _mm(-8, 8), Axis("delta/rad", -0.05, 0.15)),
    Panel(10, "d", 1002, "wheel curvature", _mm(-8, 8), Axis("Rw2/(1/m)", -400, 400)),
    Panel(11, "", 1003, "stiffness for a Hopf speed of 70 m/s", _STIFF_X, _STIFF_Y),
)
# fmt: on
