"""Branches: stable and unstable parts, and the special points on them; curves in two parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import cycle, pairwise

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, SpecialPoint
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumPoint
from wheelset.bifurcation.equilibria.hopf_points import HopfCurvePoint
from wheelset.plotting.style import BLUE, GREEN, INK, ORANGE, PURPLE, SKY, panels, styled

COLORS = (BLUE, ORANGE, GREEN, PURPLE, SKY)

#: Shapes of special points, so that they are told apart by more than their letters.
MARKS = {
    "H": "o", "LP": "D", "BP": "s", "NSE": "x",
    "LPC": "D", "BPC": "s", "PD": "^", "NS": "v",
    "GH": "*", "BT": "P", "ZH": "X", "HH": "h",
    "CPC": "<", "R1": ">", "R2": "p", "GPD": "*",
    "LPPD": "d", "LPBPC": "d", "LPNS": "8", "PDNS": "8",
}  # fmt: skip

#: Points of the same letters that are nearer than this part of the drawing are one.
NEAR = 1e-3


@dataclass(frozen=True)
class Quantity:
    """What an axis shows: a free parameter or a measure of the solutions by name, the label with
    its unit, and how many of that unit the SI unit is: "max y", "$y$ (mm)", 1e3. of_equilibria: the
    measure of equilibria where that has another name: "y".
    """

    name: str
    label: str
    factor: float = 1.0
    of_equilibria: str = ""


class Part(Enum):
    """What a part of a branch is, and how its line is drawn; the last of two wins a step."""

    WHOLE = "", "-"
    STABLE = "stable", "-"
    SUPERCRITICAL = "supercritical", "-"
    UNSTABLE = "unstable", "--"
    SUBCRITICAL = "subcritical", "--"
    UNDEFINED = "criticality undefined", "-."
    NEITHER = "neutral saddle", ":"

    @property
    def words(self) -> str:
        """As in the legend."""
        return self.value[0]

    @property
    def line(self) -> str:
        """Matplotlib's style of line."""
        return self.value[1]


@dataclass(frozen=True)
class Knot:
    """A point on a drawing, in the axes' units; ``letters`` of a special point."""

    x: float
    y: float
    part: Part
    letters: str
    critical: bool


@styled
def branch_diagram(branches: Mapping[str, Branch], x: Quantity, y: Quantity) -> Figure:
    """Branches by name in one diagram.

    Of equilibria and cycles the stable parts are solid, the unstable ones dashed. Of Hopf curves
    in two parameters the supercritical parts (H-) are solid, the subcritical ones (H+) dashed, and
    neutral saddles dotted. Lines change at the special points.
    """
    figure, (ax,) = panels(1, 1, 4.4)
    parts: set[Part] = set()
    for (name, branch), color in zip(branches.items(), cycle(COLORS), strict=False):
        parts |= draw_branch(ax, branch, x, y, color, name)
    ax.set(xlabel=x.label, ylabel=y.label)
    add_legend(ax, parts)
    return figure


def draw_branch(
    ax: Axes, branch: Branch, x: Quantity, y: Quantity, color: str = BLUE, label: str = ""
) -> set[Part]:
    """A branch with its special points on given axes; returns the sorts of parts it has."""
    knots = _knots(branch, x, y)
    runs = _runs(knots)
    for part, run in runs:
        ax.plot([k.x for k in run], [k.y for k in run], color=color, linestyle=part.line)
    if label:
        ax.plot([], [], color=color, label=label)
    for number, knot in enumerate(knots):
        if knot.letters:
            _mark(ax, knot, [*knots[max(number - 1, 0) : number], *knots[number + 1 : number + 2]])
    return {part for part, _ in runs}


def add_legend(ax: Axes, parts: set[Part]) -> None:
    """What colours and lines mean."""
    for part in Part:
        if part in parts and part.words:
            ax.plot([], [], color=INK, linestyle=part.line, label=part.words)
    if ax.get_legend_handles_labels()[1]:
        ax.legend()


# --- what is where -------------------------------------------------------------------------------


def _knots(branch: Branch, x: Quantity, y: Quantity) -> list[Knot]:
    """All points to draw, in order along the branch."""
    critical = {special.index for special in branch.special}
    at: list[tuple[float, str, BranchPoint | SpecialPoint]]
    at = [(float(k), "", branch.points[k]) for k in _ordinary(branch)]
    at += [(special.index, special.kind, special) for special in branch.special]
    return [
        Knot(
            _value(branch, point, x),
            _value(branch, point, y),
            _part(branch, point),
            letters,
            index in critical,
        )
        for index, letters, point in sorted(at, key=lambda entry: entry[:2])
    ]


def _ordinary(branch: Branch) -> range:
    """Numbers of the points, but for one beyond a cycle's birth, where the walk noticed it."""
    last = len(branch) - 1
    births = [special.index for special in branch.of_kind("H")]
    before = branch.began.kind == "problem" and any(index < 1 for index in births)
    behind = branch.ended.kind == "problem" and any(index > last - 1 for index in births)
    return range(before, last + 1 - behind)


def _value(branch: Branch, point: BranchPoint | SpecialPoint, quantity: Quantity) -> float:
    """In the axis' unit."""
    name, solution = quantity.name, point.solution
    if name in branch.parameters:
        return quantity.factor * float(point.values[branch.parameters.index(name)])
    if quantity.of_equilibria and isinstance(solution, EquilibriumPoint):
        name = quantity.of_equilibria
    return quantity.factor * float(solution.measure(name))


def _part(branch: Branch, point: BranchPoint | SpecialPoint) -> Part:
    """What the branch is at a point."""
    solution = point.solution
    if len(branch.parameters) == 1:
        return Part.UNSTABLE if solution.unstable else Part.STABLE
    return _part_of_hopf(solution) if isinstance(solution, HopfCurvePoint) else Part.WHOLE


def _part_of_hopf(point: HopfCurvePoint) -> Part:
    if point.kind == "neutral saddle":
        return Part.NEITHER
    if point.lyapunov is None:
        return Part.UNDEFINED
    return Part.SUPERCRITICAL if point.lyapunov < 0 else Part.SUBCRITICAL


def _runs(knots: Sequence[Knot]) -> list[tuple[Part, list[Knot]]]:
    """Parts of the same sort; where one changes into another, both have the knot."""
    runs: list[tuple[Part, list[Knot]]] = []
    for one, other in pairwise(knots):
        part = _between(one, other)
        if not runs or runs[-1][0] is not part:
            runs.append((part, [one]))
        runs[-1][1].append(other)
    return runs


def _between(one: Knot, other: Knot) -> Part:
    """What a branch is between two points: a special one, being critical, has no say beside an
    ordinary one; of two that differ, the part that comes last in ``Part``.
    """
    said = [knot.part for knot in (one, other) if not knot.critical]
    return max(said or [one.part, other.part], key=list(Part).index)


# --- marks ---------------------------------------------------------------------------------------


def _mark(ax: Axes, knot: Knot, beside: Sequence[Knot]) -> None:
    """A special point with its letters, once, though several branches pass it."""
    if any(_same(ax, knot, text) for text in ax.texts):
        return
    shape = MARKS.get(knot.letters, "o")
    ax.plot(
        knot.x, knot.y, shape, mfc="white", mec=INK, ms=11 if shape == "*" else 7, mew=1.4,
        zorder=3, clip_on=False,
    )  # fmt: skip
    right = not any(k.x > knot.x and k.y > knot.y for k in beside)  # not on the branch itself
    ax.annotate(
        knot.letters, (knot.x, knot.y), xytext=(6 if right else -6, 6), textcoords="offset points",
        ha="left" if right else "right",
    )  # fmt: skip


def _same(ax: Axes, knot: Knot, text: Text) -> bool:
    """Whether letters that were written before belong to the same point."""
    if not isinstance(text, Annotation) or text.get_text() != knot.letters:
        return False
    (x, y), box = text.xy, ax.dataLim
    return abs(x - knot.x) <= NEAR * box.width and abs(y - knot.y) <= NEAR * box.height
