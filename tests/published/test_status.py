"""The status table holds every item of the paper exactly once."""

from __future__ import annotations

import pandas as pd
import pytest

from wheelset.published.claims import judge
from wheelset.published.comparison import compare
from wheelset.published.fits import FITS, is_fitted, with_fits
from wheelset.published.items import ITEMS, items_of
from wheelset.published.status import counts, status
from wheelset.vehicle import load_vehicle

ONE = {("Table 2: case 1, none", "hopf_speed"): 52.29}


def test_nothing_computed_is_everything_not_yet():
    table = status({})
    assert [(r.item, r.quantity) for r in table.itertuples()] == [item.key for item in ITEMS]
    assert set(table["verdict"]) == {"not yet"}


def test_counts_add_up():
    table = status({"3_flange_models": compare(items_of("Table 2"), ONE)})
    total = counts(table).iloc[-1]
    verdicts = total[["agrees", "within tolerance", "differs", "not yet"]].sum()
    assert total["items"] == verdicts == len(ITEMS)
    assert total["agrees"] == 1


def test_an_item_on_two_pages_or_on_none_of_the_papers_is_refused():
    page = compare(items_of("Table 2"), ONE)
    with pytest.raises(ValueError, match="b: Table 2: case 1, none, hopf_speed is also on a"):
        status({"a": page, "b": page})
    with pytest.raises(ValueError, match="is not in the paper"):
        status({"a": page.assign(item="Table 9")})


def test_fitted_rows_say_so():
    table = with_fits(compare(items_of("Table 2"), ONE, "guo2021_case1"), "guo2021_case1")
    laws = ("none", "exponential", "polynomial")
    assert set(table[is_fitted(table)]["item"]) == {f"Table 2: case 1, {law}" for law in laws}
    assert not is_fitted(with_fits(table.assign(reason=""), "guo2021_physical")).any()


def test_fits_are_of_known_vehicles_and_items():
    for fit in FITS:
        assert load_vehicle(fit.vehicle).name == fit.vehicle
        assert any(item.item.startswith(fit.place) for item in ITEMS)


def test_a_figure_agrees_if_every_sentence_about_it_holds():
    cases = {"agrees": (True, True), "within tolerance": (False, True), "differs": (False, False)}
    rows = [("Fig. 4: exponential", "near", 2e3, "N", *case) for case in cases.values()]
    columns = ["item", "claim", "measured", "unit", "holds", "tolerated"]
    claims = pd.DataFrame(rows, columns=columns)
    key = ("Fig. 4: exponential", "figure")
    for count, expected in enumerate(cases, start=1):
        judged = judge(claims[:count], {})[key]
        assert judged.verdict == expected
        assert "near: 2.00 kN" in judged.reason
