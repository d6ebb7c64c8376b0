"""What a report computes: left and right exchanged, widths, and what cannot be computed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from wheelset.hunting import hunting_system
from wheelset.profiles import Setup, contact_geometry, packaged
from wheelset.studies.on_profiles import on_profiles, on_track, searched
from wheelset.studies.profile_report import (
    critical_speeds,
    equilibria,
    profile_report,
    speeds_table,
)
from wheelset.studies.profile_report_words import conclusion
from wheelset.vehicle import load_vehicle

VEHICLE, RAIL, WINDOW = load_vehicle("guo2021_physical"), packaged("CHN60"), (10.0, 200.0)
Y = np.linspace(-0.01, 0.01, 401)


def of(left, right, setup=None):
    wheels = {"wheel": packaged(left), "wheel_right": packaged(right)}
    setup = on_track(VEHICLE, setup)
    return contact_geometry(rail=RAIL, setup=setup, y=Y, trim=True, **wheels)


def test_left_and_right_exchanged_are_mirrored():
    one, other = (
        critical_speeds(VEHICLE, of(*wheels), WINDOW, 1e-3)
        for wheels in (("LMB10", "LMA"), ("LMA", "LMB10"))
    )
    # rounding of the contact search, enlarged by derivatives of its average
    assert abs(one.rest) > 1e-3
    assert one.rest == pytest.approx(-other.rest, rel=1e-6)
    assert one.run.hopf.value == pytest.approx(other.run.hopf.value, rel=1e-5)
    assert one.run.hopf.frequency == pytest.approx(other.run.hopf.frequency, rel=1e-5)


def test_wheels_alike_are_as_without_a_rest_to_look_for():
    contact = searched(packaged("LMB10"), RAIL, VEHICLE)
    found, known = (
        critical_speeds(VEHICLE, contact, WINDOW, 5e-4),
        on_profiles(VEHICLE, contact, WINDOW),
    )
    assert abs(found.rest) < 1e-9
    assert found.run.hopf.value == pytest.approx(known.hopf.value, rel=1e-9)
    assert [f.values[0] for f in found.run.folds] == pytest.approx(
        [f.values[0] for f in known.folds], rel=1e-6
    )
    assert found.stable == (True, False)


def test_every_equilibrium_is_one_and_the_middle_comes_first():
    system = hunting_system(VEHICLE.with_overrides({"Kpy": 1e-3, "c1": 0.0}))
    rests = equilibria(system, 20.0, 0.001)
    for state in rests:
        assert abs(system.rhs(state, system.p(v=20.0))).max() < 1e-6
    assert abs(rests[0, 0]) < 1e-9


def test_too_little_contact_is_told_in_words():
    contact = of("LMB10", "LMB10", Setup(back_to_back=1.2))
    report = profile_report(VEHICLE, contact, [0.003], WINDOW, 5e-4)
    assert all(s.run is None for s in report.speeds)
    assert speeds_table(report)["words"].str.contains("known up to 0.00 mm").all()
    texts = conclusion(report)
    assert texts[0].startswith("No critical speeds")
    assert any(text.startswith("No equivalent conicity") for text in texts)


def test_a_window_without_a_hopf_point_says_whether_it_is_stable():
    contact = searched(packaged("LMB10"), RAIL, VEHICLE)
    report = profile_report(VEHICLE, contact, [0.003], (10.0, 40.0), 5e-4)
    assert "stable at both ends" in conclusion(report)[0]
    fast = replace(report, window=(100.0, 140.0))
    above = critical_speeds(VEHICLE, contact, fast.window, 5e-4)
    assert "unstable at both ends" in conclusion(replace(fast, speeds=(above,)))[0]
