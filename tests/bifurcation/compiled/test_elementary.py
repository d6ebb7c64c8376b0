"""Elementary functions of the machine code: against mpmath, and at the ends of the doubles."""

from __future__ import annotations

from functools import lru_cache

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from wheelset.bifurcation.outcomes import NotFinite
from wheelset.bifurcation.system import System

FUNCTIONS = {
    "exp": (sp.exp, mp.exp),
    "log": (sp.log, mp.log),
    "sin": (sp.sin, mp.sin),
    "cos": (sp.cos, mp.cos),
    "root": (sp.sqrt, mp.sqrt),
    "63/100": (lambda x: x ** sp.Float(0.63), lambda x: x ** mp.mpf(0.63)),
    "-2/3": (lambda x: x ** sp.Float(-2 / 3), lambda x: x ** mp.mpf(-2 / 3)),
    "-5/2": (lambda x: x ** sp.Rational(-5, 2), lambda x: x ** mp.mpf(-2.5)),
    "23": (lambda x: x**23, lambda x: x**23),
}
POSITIVE = np.concatenate(
    [np.logspace(-300, 300, 601), np.linspace(0.6, 1.6, 201), 1 + np.array([-1, 0, 2]) * 2.0**-53]
)
MODERATE = np.concatenate([np.logspace(-12, 12, 301), np.linspace(0.6, 1.6, 51)])
ANY = np.concatenate([-np.logspace(-300, 2.84, 301), [0.0], np.logspace(-300, 2.84, 301)])
CIRCLE = np.concatenate(
    [np.linspace(-10, 10, 401), np.arange(-99, 99) * np.pi / 4, np.logspace(2, 15, 201)]
)
ARGUMENTS = {
    "exp": ANY, "sin": CIRCLE, "cos": CIRCLE, "-5/2": MODERATE, "23": MODERATE,
}  # fmt: skip
#: Units in the last place, 1.5 unless said: products hand on the roundings of their factors.
PLACES = {"-5/2": 4.0, "23": 22.0}


@lru_cache
def kernel(name):
    def field(x, p):
        return [FUNCTIONS[name][0](x[0])]

    return System.from_function(field, ("x",), {"c": 0.0}).field_kernel()


def evaluate(name, x):
    F = np.empty((len(x), 1))
    kernel(name)(np.array(x)[:, None], np.zeros(1), F)
    return F[:, 0]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_right_to_the_last_places(name):
    x = ARGUMENTS.get(name, POSITIVE)
    computed = evaluate(name, x)
    with mp.workdps(40):
        exact = [FUNCTIONS[name][1](mp.mpf(xi)) for xi in x]
        off = [abs(mp.mpf(c) - e) for c, e in zip(computed, exact, strict=True)]
    spacing = np.spacing(np.abs(np.array(exact, dtype=float)))
    assert np.max(np.array(off, dtype=float) / spacing) < PLACES.get(name, 1.5)


ENDS = [
    ("exp", -800.0, 0.0), ("exp", -745.0, 5e-324), ("exp", 709.7, np.exp(709.7)),
    ("log", 5e-324, np.log(5e-324)), ("log", 1.7e308, np.log(1.7e308)), ("root", 0.0, 0.0),
    ("63/100", 0.0, 0.0), ("63/100", 5e-324, 5e-324**0.63), ("23", -2.0, -(2.0**23)),
    ("sin", 0.0, 0.0), ("cos", 1e-300, 1.0),
]  # fmt: skip


@pytest.mark.parametrize(("name", "x", "expected"), ENDS)
def test_at_the_ends_of_the_doubles(name, x, expected):
    assert evaluate(name, [x]) == pytest.approx([expected], rel=2e-16, abs=0.0)


UNDEFINED = [
    ("exp", 709.9), ("log", 0.0), ("log", -1.0), ("root", -1e-300), ("63/100", -1.0),
    ("-2/3", 0.0), ("-5/2", 0.0), ("sin", 2.0**51), ("cos", 1e300), ("23", 1e20),
]  # fmt: skip


@pytest.mark.parametrize(("name", "x"), UNDEFINED)
def test_what_is_not_a_number_is_an_outcome(name, x):
    with pytest.raises(NotFinite):
        evaluate(name, [x])


@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("x", [np.nan, np.inf, -np.inf])
def test_infinite_states_give_limits_or_outcomes(name, x):
    if (name, x) in {("exp", -np.inf), ("-2/3", np.inf)}:
        assert evaluate(name, [x]) == [0.0]
        return
    with pytest.raises(NotFinite):
        evaluate(name, [x])
