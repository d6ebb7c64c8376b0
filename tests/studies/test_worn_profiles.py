"""Section 6's measures on shapes whose answers are known."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from pydantic import ValidationError

from wheelset.profiles import Setup, contact_geometry, packaged
from wheelset.studies import worn_claims, worn_profiles
from wheelset.studies.worn_profiles import FIGURE_MILEAGES


def rows(mileage, slope, bow=0.0):
    """A radius that is a line, or a parabola that leaves its line by ``bow`` at the ends."""
    low, high = worn_claims.LINEAR
    y = np.linspace(low, high, 401)
    part = (y - low) / (high - low)
    return pd.DataFrame(
        {"mileage": mileage, "y": y, "r": 0.46 + slope * y + bow * (2 * part - 1) ** 2}
    )


@pytest.fixture(scope="module")
def contacts():
    y = np.linspace(-0.007, 0.007, 281)
    new = contact_geometry(packaged("LMB10"), packaged("CHN60"), Setup(), y)
    return {0.2: new}


def test_parameters_name_what_is_wrong():
    with pytest.raises(ValidationError, match="law"):
        worn_profiles.Parameters(law="none")
    with pytest.raises(ValidationError, match="rail"):
        worn_profiles.Parameters(rail="LMB10")
    with pytest.raises(ValidationError, match="width"):
        worn_profiles.Parameters(width=0.1)


def test_a_quick_look_has_some_of_the_figures_mileages():
    quick = worn_profiles.Parameters(resolution="quick").mileages
    assert set(quick) < set(FIGURE_MILEAGES) < set(worn_profiles.Parameters().mileages)


def test_profiles_are_the_new_wheel_less_its_wear():
    frame = worn_profiles.profile_frame("usfd", half=0.01, spacing=1e-3)
    new = frame[frame["mileage"] == 0.0]
    last = frame[frame["mileage"] == 18.5]
    assert (new["depth"] == 0.0).all()
    assert np.allclose(
        last["z"].to_numpy() + last["depth"].to_numpy(), new["z"], rtol=0, atol=1e-15
    )
    assert abs(frame["y"]).max() <= 0.01 + 1e-12


def test_the_radius_at_the_centre_is_the_nominal_one(contacts):
    frame = worn_profiles.contact_frame(contacts)
    assert np.interp(0.0, frame["y"], frame["r"]) == pytest.approx(0.46, abs=1e-15)


def test_conicity_has_no_row_where_there_is_no_wave(contacts):
    """Searched to 7 mm, so that waves of 7 mm and more are not known."""
    frame = worn_profiles.conicity_frame(contacts)
    assert frame["amplitude"].max() < 0.0075
    assert worn_profiles.conicity_at(frame)[0.2] == pytest.approx(
        0.104, abs=0.001
    )  # the geometry notes'


def test_a_wheel_without_jumps_has_none(contacts):
    row = worn_profiles.jump_frame(contacts).iloc[0]
    assert row["jumps"] == 0
    assert pd.isna(row["first"])


def test_share_of_a_block_of_wear():
    y = np.linspace(-30e-3, 30e-3, 6001)
    block = pd.DataFrame({"y": y, "depth": np.where(abs(y) <= 20e-3, 1e-3, 0.0)})
    assert worn_claims.share_of_wear(block) == pytest.approx(0.75, abs=1e-3)


def test_a_line_is_straight_and_a_parabola_is_not():
    """A parabola of height h over a line leaves its best line by 2/3 h."""
    slope, bow = 0.2, 1e-4
    lines = worn_claims.straight_lines(pd.concat([rows(1.0, slope), rows(2.0, slope, bow)]))
    low, high = worn_claims.LINEAR
    assert lines["slope"].tolist() == pytest.approx([slope, slope], rel=1e-3)
    assert lines["bent"][0] < 1e-9
    assert lines["bent"][1] == pytest.approx(2 / 3 * bow / (slope * (high - low)), rel=0.01)


def test_roughness_is_the_way_up_and_down():
    y = np.linspace(-8e-3, 8e-3, 1601)
    frame = pd.DataFrame({"mileage": 1.0, "y": y, "curvature": 3 * np.cos(y * 2 * np.pi / 8e-3)})
    assert worn_claims.roughness(frame)[1.0] == pytest.approx(4 * 2 * 3, rel=1e-4)


def test_the_linear_term_is_that_of_the_contact_angle(contacts):
    """Between the arcs R350 and R300 the contact angle's slope is that of the two circles: the gap
    of the centres turns it by 1 / (350 - 300) mm less the roll, near the middle.
    """
    assert 0 < worn_claims.linear_term(contacts[0.2]) < 1 / 0.05
