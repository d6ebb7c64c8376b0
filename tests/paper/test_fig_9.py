"""Fig. 9: simulated worn profiles against the paper's sentence, and against what they were."""

from __future__ import annotations

import numpy as np
import pytest

from tests.paper.arrays import regress
from tests.paper.judging import judged
from tests.paper.worn import P, sentences
from wheelset.published.figures import panel
from wheelset.published.items import items_of
from wheelset.studies import worn_profiles

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Fig. 9"), lambda _: P.vehicle))
def test_panel_is_as_the_paper_says(item, vehicle):
    assert len(sentences(item)) > 0
    assert sentences(item)["tolerated"].all()


@pytest.mark.parametrize("law", [P.law, P.law_second])
def test_profiles_lie_on_the_panels(law):
    """Worn surfaces lie below new ones, and all of them inside the window printed."""
    enlarged = panel(9, "b")
    profiles = worn_profiles.profile_frame(law, half=enlarged.x.high * 1e-3)
    assert (profiles["depth"] > -1e-9).all()
    assert profiles["z"].between(enlarged.y.low * 1e-3, enlarged.y.high * 1e-3).all()


def test_profiles_are_as_stored():
    profiles = worn_profiles.profile_frame(P.law, half=0.060, spacing=5e-3)
    regress("fig_9", profiles.round({"y": 12}), rtol=1e-6, atol=1e-10)
    assert np.isfinite(profiles["z"]).all()
