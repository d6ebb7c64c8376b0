"""Fig. 5: what section 3 says about the simulated motions."""

from __future__ import annotations

from functools import cache

import pytest

from tests.paper.judging import judged
from wheelset.published.items import items_of
from wheelset.studies import flange_claims, flange_models, hunting_motion

pytestmark = pytest.mark.slow

P = flange_models.Parameters()


@cache
def outcomes(laws=hunting_motion.FIGURE_5_LAWS):
    return hunting_motion.outcome_frame(hunting_motion.hunting_motions(P, laws))


@pytest.mark.parametrize(
    ("item", "vehicle"),
    judged(items_of("Fig. 5"), lambda item: P.cases[2 if "case 2" in item.item else 1]),
)
def test_motion_is_as_the_paper_says(item, vehicle):
    claims = flange_claims.figure_5_claims(outcomes()).set_index("item")
    assert claims.loc[item.item, "holds"]


@pytest.mark.parametrize("case", P.cases)
def test_without_flange_and_with_a_real_one_it_returns_to_the_centre(case):
    quiet = outcomes(("none", "piecewise_linear", "exponential"))
    assert set(quiet[quiet["case"] == case]["motion"]) == {"returns to the centre"}


def test_every_motion_was_followed_to_its_end():
    assert outcomes()["ended_at"].isna().all()


def test_the_polynomial_keeps_the_wheelset_away_from_the_centre():
    held = outcomes()[outcomes()["law"] == "quintic"]
    assert (held["amplitude"] + held["offset"].abs() > 0.008).all()
