"""Every row of every table, every result in the text and every figure panel, as a list.

The status table of the book is this list beside what was computed, so that nothing of the paper
can be forgotten. An item is known by its name and a quantity: ("Table 3: a1=0.05", "flc").
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from wheelset.published.figures import PANELS, Panel
from wheelset.published.numbers import (
    CLAIMS,
    FLANGE_COEFFICIENTS,
    GENERALIZED_HOPF,
    SECTION_3_CYCLES,
    SECTION_4_HOPF,
    TABLE_1,
    TABLE_2,
    TABLE_3,
    TABLE_4,
    CyclePoint,
    FlangeHopf,
    GeneralizedHopf,
    GeometryRow,
    PrintedParameter,
    WornProfile,
)

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Item:
    """One published number or figure panel.

    published: None for a figure. unit: SI, or ``1``. decimals: of the last printed digit, in that
    unit; negative to the left of the point. page: in the journal.
    """

    item: str
    quantity: str
    published: float | None
    unit: str
    decimals: int
    page: int

    @property
    def key(self) -> tuple[str, str]:
        """What the item is known by."""
        return self.item, self.quantity

    @property
    def rounding(self) -> float:
        """Half a unit of the last printed digit: the print says no more."""
        return 0.5 * 10.0**-self.decimals


FLC_UNIT = "1/s"
FIGURE, SKETCH = "figure", "sketch"


def items_of(place: str) -> tuple[Item, ...]:
    """Items whose name begins with ``place``, such as ``Table 3`` or ``Fig. 4``."""
    return tuple(item for item in ITEMS if item.item == place or item.item.startswith(f"{place}:"))


def geometry_item(row: GeometryRow) -> str:
    """Name of a row of Table 3."""
    return f"Table 3: {row.parameter}={row.value:g}"


def flange_item(row: FlangeHopf) -> str:
    """Name of a row of Table 2."""
    return f"Table 2: case {row.case}, {row.flange}"


def item_frame(items: Sequence[Item]) -> pd.DataFrame:
    """The items as a table, one row each."""
    import pandas as pd

    return pd.DataFrame([asdict(item) for item in items])


def _speed(item: str, quantity: str, value: float, page: int, decimals: int = 2) -> Item:
    return Item(item, quantity, value, "m/s", decimals, page)


def _flc(item: str, value: float, page: int) -> Item:
    return Item(item, "flc", value, FLC_UNIT, 2, page)


def _table_1(row: PrintedParameter, place: str, page: int) -> Iterator[Item]:
    unit = row.unit_printed.removeprefix("M").removeprefix("k") if row.si != 1 else row.unit_printed
    unit = f"1{unit}" if unit.startswith("/") else unit
    yield Item(f"{place}: {row.symbol}", "value", row.si_value, unit, row.decimals, page)


def _table_2(row: FlangeHopf) -> Iterator[Item]:
    yield _speed(flange_item(row), "hopf_speed", row.hopf_speed, 996)
    yield _flc(flange_item(row), row.flc, 996)


def _table_3(row: GeometryRow) -> Iterator[Item]:
    name = geometry_item(row)
    yield _speed(name, "hopf_speed", row.hopf_speed, 1001)
    yield _flc(name, row.flc, 1001)
    if row.lpc_speed is not None:
        yield _speed(name, "lpc_speed", row.lpc_speed, 1001)
    if row.nfc is not None:
        yield Item(name, "nfc", row.nfc, "1/s", 2, 1001)


def _table_4(row: WornProfile) -> Iterator[Item]:
    name = f"Table 4: {row.mileage:g}e4 km"
    yield _speed(name, "hopf_speed", row.hopf_speed, 1002)
    yield _flc(name, row.flc, 1002)


def _cycle(row: CyclePoint) -> Iterator[Item]:
    twins = [c.speed for c in SECTION_3_CYCLES
             if (c.case, c.flange, c.point) == (row.case, row.flange, row.point)]  # fmt: skip
    number = f" {1 + twins.index(row.speed)}" if len(twins) > 1 else ""
    name = f"Section 3: case {row.case}, {row.flange}, {row.point}{number}"
    page = 997 if row.point == "PD" and row.flange == "reciprocal" and row.case == 2 else 996
    yield _speed(name, f"{row.point.lower()}_speed", row.speed, page, row.speed_decimals)
    if row.nfc is not None:
        yield Item(name, "nfc", row.nfc, "1/s", row.nfc_decimals, page)


def _generalized_hopf(row: GeneralizedHopf) -> Iterator[Item]:
    name = f"Section {row.section}: GH {row.parameter}={row.value:.12g}"
    page = 1001 if row.section == 5 else 999 if row.parameter == "f1" else 998
    yield Item(name, "gh_value", row.value, "SI", row.value_decimals, page)
    if row.slc is not None:
        yield Item(name, "slc", row.slc, "1/s", row.slc_decimals, page)


def _figure(panel: Panel) -> Iterator[Item]:
    kind = SKETCH if panel.x is None else FIGURE
    yield Item(panel.label, kind, None, "1", 0, panel.page)


def _all() -> Iterator[Item]:
    for parameter in TABLE_1:
        yield from _table_1(parameter, "Table 1", 995)
    for parameter in FLANGE_COEFFICIENTS:
        page = 995 if parameter.symbol in ("k0", "eta", "d1", "d2") else 996
        yield from _table_1(parameter, "Eqs. (24)-(27)", page)
    for flange_row in TABLE_2:
        yield from _table_2(flange_row)
    for cycle in SECTION_3_CYCLES:
        yield from _cycle(cycle)
    yield _speed("Section 4: default", "hopf_speed", SECTION_4_HOPF.hopf_speed, 998)
    yield _flc("Section 4: default", SECTION_4_HOPF.flc, 998)
    for point in GENERALIZED_HOPF:
        yield from _generalized_hopf(point)
    for row in TABLE_3:
        yield from _table_3(row)
    for profile in TABLE_4:
        yield from _table_4(profile)
    for claim in CLAIMS:
        name = f"Section {claim.section}: {claim.words}"
        yield Item(name, claim.quantity, claim.value, claim.unit, claim.decimals, claim.page)
    for panel in PANELS:
        yield from _figure(panel)


ITEMS: tuple[Item, ...] = tuple(_all())
