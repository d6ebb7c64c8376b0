"""Wear laws: numbers by hand, limits, and what must hold for every law of the registry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from wheelset.wear.laws import USFD, WEAR_LAWS, ArchardKTH, Zobory, coefficients, wear_law

V = 80.0


@pytest.mark.parametrize(
    ("p", "sliding", "k"),
    [(1e9, 0.1, 5e-4), (1e9, 0.3, 35e-4), (1e9, 0.9, 5e-4), (2.2e9, 0.1, 350e-4)],
)
def test_archard_by_hand(p, sliding, k):
    # 0.8 H = 2.16 GPa; a metre rolled slides s metres
    s = sliding / V
    rate = ArchardKTH().rate(np.array(p), np.array(0.0), np.array(s), V)
    assert rate == pytest.approx(k * p * s / 2.7e9, rel=1e-12)


def test_archards_coefficients_lie_in_the_published_bands():
    law = ArchardKTH()
    assert 1e-4 <= law.mild <= 10e-4
    assert 1e-4 <= law.fast <= 10e-4
    assert 30e-4 <= law.severe <= 40e-4
    assert 300e-4 <= law.seizure <= 400e-4


def test_usfd_by_hand():
    # 300 MPa sliding 0.1 %: 0.3 N/mm2, 1.59 ug/m/mm2 = 1.59e-3 kg/m3 over 7850 kg/m3
    rate = USFD().rate(np.array(1e9), np.array(300e6), np.array(1e-3), V)
    assert rate == pytest.approx(1.59e-3 / 7850, rel=1e-12)
    assert USFD().K(np.array([5.0, 40.0, 100.0])) == pytest.approx(
        [26.5, 55.12, 55.12 + 61.9 * 22.8]
    )


@pytest.mark.parametrize("limit", [10.4, 77.2])
def test_usfd_is_continuous(limit):
    below, above = USFD().K(np.array([limit - 1e-9, limit + 1e-9]))
    assert above == pytest.approx(below, abs=1e-6)


def test_usfd_as_printed_would_fall_to_nothing():
    # why the constant is not 4778.7
    assert abs(61.9 * 77.2 - 4778.7) < 0.03
    assert USFD().K(np.array(77.2)) == pytest.approx(55, abs=0.2)


def test_zobory_by_hand():
    # 200 MPa, 0.02 %: 40 kPa a metre; times 80 m/s 3.2e6 W/m2, mild; at 0.04 % severe
    law = Zobory()
    rates = law.rate(np.array(1e9), np.array(200e6), np.array([2e-4, 4e-4]), V)
    assert rates == pytest.approx([7e-10 * 4e4 / 7850, 21e-10 * 8e4 / 7850], rel=1e-12)


@pytest.mark.parametrize("name", WEAR_LAWS)
def test_every_law(name):
    law = wear_law(name)
    assert law.name == name
    assert law.__doc__ and "k" in law.__doc__.lower()
    p, tau = np.full(200, 8e8), np.full(200, 2e8)
    s = np.linspace(0.0, 0.15 / V, 200)
    rates = law.rate(p, tau, s, V)
    assert rates[0] == 0
    assert np.all(np.diff(rates) >= 0)  # within the first regime of the map by speed
    assert np.isfinite(rates).all()
    assert law.rate(p[:1] * 0.5, tau[:1], s[-1:], V) <= rates[-1]


@pytest.mark.parametrize("name", WEAR_LAWS)
def test_coefficients_are_told_and_can_be_changed(name):
    law = WEAR_LAWS[name]
    numbers = coefficients(law)
    first = next(iter(numbers))
    doubled = replace(law, **{first: 2 * numbers[first]})
    arguments = np.array(1e9), np.array(1e8), np.array(1e-5), V
    assert doubled.rate(*arguments) == pytest.approx(2 * law.rate(*arguments))


def test_an_unknown_law_names_those_there_are():
    with pytest.raises(ValueError, match='"archard" is unknown; choose one of archard_kth'):
        wear_law("archard")
