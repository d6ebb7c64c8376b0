"""Profiles, their contact and the fits of it as tables."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from wheelset.profiles import packaged
from wheelset.studies import contact_fits, profile_contact, profile_noise

QUICK = profile_contact.Parameters(resolution="quick")


@pytest.fixture(scope="module")
def contact():
    return profile_contact.contact_of(QUICK)


@pytest.fixture(scope="module")
def fits(contact):
    return contact_fits.fits(QUICK, contact)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wheel": "LMB11"}, 'did you mean "LMB10"'),
        ({"wheel": "CHN60"}, "CHN60 is a rail, a wheel is wanted here"),
        ({"rail": "nowhere.csv"}, "nowhere.csv"),
        ({"gauge": 3.0}, "less than or equal to 2"),
        ({"width": 1.0}, "less than or equal to 0.005"),
    ],
)
def test_what_cannot_be_used_is_refused_with_a_remedy(given, words):
    with pytest.raises(ValidationError, match=words):
        profile_contact.Parameters(**given)


@pytest.mark.slow
def test_a_file_is_a_profile_too(tmp_path):
    y, z = packaged("LMB10").points(1e-4)
    path = tmp_path / "mine.csv"
    np.savetxt(path, np.column_stack([y, z]) * 1e3, delimiter=",", header="y mm, z mm")
    p = profile_contact.Parameters(wheel=str(path), resolution="quick")
    ours, theirs = (profile_contact.conicities(profile_contact.contact_of(q)) for q in (p, QUICK))
    assert p.profiles[0].notes
    difference = ours.to_frame()["integration"] - theirs.to_frame()["integration"]
    assert abs(difference).max() < 1e-3


def test_the_standards_values_are_met():
    table = profile_contact.reference_conicities()
    assert (abs(table["integration"] - table["printed"]) < table["limit"] / 3).all()


def test_known_pairs():
    """Centre values of spec: LMB10 0.066 rad, conicity 0.104; LMA 0.025 rad."""
    table = profile_contact.pairs(QUICK).set_index(["wheel", "rail"])
    assert table.loc[("LMB10", "CHN60"), "c0"] == pytest.approx(0.066, abs=5e-4)
    assert table.loc[("LMB10", "CHN60"), "conicity"] == pytest.approx(0.104, abs=1e-3)
    assert table.loc[("LMA", "CHN60"), "c0"] == pytest.approx(0.025, abs=5e-4)


def test_the_jump_to_the_flange_is_in_the_table(contact):
    table = profile_contact.jumps(contact)
    assert sorted(table["side"]) == ["left", "right"]
    assert table["y"].abs().round(4).unique().tolist() == [0.01]


def test_fits_err_as_they_say(fits, contact):
    errors = contact_fits.fit_errors(fits).set_index("fit")
    functions = contact_fits.fit_functions(fits, contact)
    searched = functions["contacts"]
    for name in errors.index:
        fit = functions[name]
        off = np.interp(searched["y"], fit["y"], fit["rho"]) - searched["rho"]
        assert abs(off).max() == pytest.approx(errors.loc[name, "rho"], rel=0.02)


def test_fits_disagree_at_the_hopf_point_and_agree_on_cycles(fits):
    table = contact_fits.fit_speeds(fits).set_index("fit")
    assert np.ptp(table["v_lin"]) > 5.0
    assert np.ptp(table["v3"]) < 2.0


def test_a_fit_that_leads_nowhere_says_why(contact, monkeypatch):
    from wheelset.profiles import SineFit

    wild = {"spline, 0.5 mm": lambda contact, reach: SineFit.of(contact, reach, 16)}
    monkeypatch.setattr(contact_fits, "FITS", wild)
    monkeypatch.setattr(contact_fits, "QUICK", tuple(wild))
    (fit,) = contact_fits.fits(QUICK, contact)
    (row,) = contact_fits.fit_speeds((fit,)).to_dict("records")
    assert fit.run is None
    assert "Newton" in row["words"]


@pytest.mark.slow
def test_spacing_does_not_matter_and_noise_does():
    trips = profile_noise.round_trips(QUICK)
    scatter = profile_noise.scatter(trips)
    quiet, noisy = scatter[scatter["noise"] == 0], scatter[scatter["noise"] > 0]
    assert quiet["v_lin_most"].max() < 0.2
    assert quiet["v_non_most"].max() < 0.2
    assert 0.01 < noisy["v_lin_rms"].max() < 3.0


def test_the_same_seed_is_the_same_wheel():
    wheel = packaged("LMB10")
    one, two, other = (profile_noise.resampled(wheel, 2e-4, 5e-6, seed) for seed in (1, 1, 2))
    y = np.linspace(-0.02, 0.02, 9)
    assert (one.z(y) == two.z(y)).all()
    assert (one.z(y) != other.z(y)).any()
