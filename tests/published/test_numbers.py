"""The printed numbers: every row is an item, and typed as the CSV files have them."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from wheelset.published import numbers
from wheelset.published.figures import PANELS, panel
from wheelset.published.items import ITEMS, item_frame, items_of
from wheelset.published.rules import RULES

CSV = Path(__file__).parents[3] / "shared" / "published"
needs_csv = pytest.mark.skipif(not CSV.is_dir(), reason="the typed CSV files are not beside it")

GROUPS = {
    "table_1": (*numbers.TABLE_1, *numbers.FLANGE_COEFFICIENTS),
    "table_2": numbers.TABLE_2,
    "table_3": numbers.TABLE_3,
    "table_4": numbers.TABLE_4,
    "section_3_cycles": numbers.SECTION_3_CYCLES,
}


@needs_csv
@pytest.mark.parametrize("name", GROUPS)
def test_records_equal_the_csv(name):
    csv = pd.read_csv(CSV / f"{name}.csv", keep_default_na=False, na_values=[""])
    ours = numbers.frame(GROUPS[name])[[*_ours(csv.columns)]]
    ours.columns = csv.columns
    pd.testing.assert_frame_equal(ours, csv, check_dtype=False)


def _ours(columns):
    return ["mileage" if column.startswith("mileage") else column for column in columns]


@needs_csv
def test_section_4_equals_the_csv():
    csv = pd.read_csv(CSV / "section_4.csv")
    points = [p for p in numbers.GENERALIZED_HOPF if p.section == 4]
    assert [(p.parameter, p.value) for p in points] == list(
        csv[csv.point == "GH"][["parameter", "value"]].itertuples(index=False, name=None)
    )
    assert [p.slc for p in points if p.slc] == list(csv.slc.dropna())
    default = csv.iloc[0]
    assert (numbers.SECTION_4_HOPF.hopf_speed, numbers.SECTION_4_HOPF.flc) == (
        default.hopf_speed,
        default.flc,
    )


@needs_csv
def test_single_panels_equal_the_csv():
    csv = pd.read_csv(CSV / "figure_axes.csv")
    for row in csv[~csv.figure.isin([5, 6])].itertuples():
        ours = panel(row.figure, row.panel if isinstance(row.panel, str) else "")
        assert (ours.x.low, ours.x.high) == (row.x_min, row.x_max), ours.label
        assert (ours.y.low, ours.y.high) == (row.y_min, row.y_max), ours.label
        assert (ours.x.label, ours.y.label) == (row.x, row.y)


def test_items_are_unique_and_have_a_rule():
    assert len({item.key for item in ITEMS}) == len(ITEMS)
    for item in ITEMS:
        assert 989 <= item.page <= 1005
        assert (item.published is None) == (item.quantity in ("figure", "sketch"))
        assert item.published is None or item.quantity in RULES


def test_every_row_of_every_table_is_there():
    assert len(items_of("Table 1")) == 17
    assert len(items_of("Table 2")) == 2 * 8
    assert len(items_of("Table 3")) == 2 * 12 + 2 * 10
    assert len(items_of("Table 4")) == 2 * 7
    assert len(items_of("Section 3")) == 12 + 6 + 1
    assert len([i for i in ITEMS if i.item.startswith("Fig. ")]) == len(PANELS) == 42
    assert items_of("Fig. 1") == (ITEMS[-len(PANELS)],)


def test_a_printed_number_has_the_printed_decimals():
    for item in ITEMS:
        if item.published is not None and item.decimals >= 0:
            assert round(item.published, item.decimals) == item.published, item.item


def test_frames():
    assert len(item_frame(ITEMS)) == len(ITEMS)
    assert numbers.frame(numbers.TABLE_3).lpc_speed.isna().sum() == 2


def test_panels():
    assert panel(7, "c").x.label == "c1"
    assert panel(11).label == "Fig. 11"
    assert len({p.label for p in PANELS}) == len(PANELS)
    with pytest.raises(KeyError, match=r"Fig\. 7"):
        panel(7, "z")
