"""Normal-form coefficients of cycles against closed forms, on circles and on sheared ones."""

import numpy as np
import pytest

from tests.exact_systems import (
    ExactCycle,
    OddPitchfork,
    TorusBirth,
    TwistedBand,
    bautin,
    cusp_of_cycles,
    sheared,
)
from wheelset.bifurcation.cycles.collocation import Collocation
from wheelset.bifurcation.cycles.cycle_curve import Anchor
from wheelset.bifurcation.cycles.cycle_normal_forms import (
    CycleForms,
    flip_coefficients,
    fold_coefficients,
    torus_coefficient,
)
from wheelset.bifurcation.cycles.cycle_start import stage_phases

SHAPES = pytest.mark.parametrize("shape", [lambda c: c, sheared], ids=["circle", "sheared"])
HALVES = pytest.mark.parametrize("half", [False, True], ids=["full", "half"])


def forms_of(cycle: ExactCycle, half: bool, intervals: int = 40) -> CycleForms:
    """Derivatives along functions on the exact cycle: no solver comes in."""
    n = cycle.system.n
    signs = np.array(cycle.signs, dtype=float) if half else np.ones(n)
    space = Collocation(
        cycle.system, cycle.system.p(), (), np.full(intervals, 1 / intervals), signs, half,
        np.ones(n),
    )  # fmt: skip
    ends = cycle.state(space.kappa * space.mesh)
    stages = cycle.state(space.kappa * stage_phases(space).ravel()).reshape(space.shape)
    u = space.join(ends, stages, cycle.period, np.zeros(0))
    return CycleForms(space, space.split(u), Anchor.at(space, u).row, cycle.period)


@SHAPES
@HALVES
@pytest.mark.parametrize("squared", [0.2, 0.6])
def test_b_of_a_fold_is_the_closed_form(squared, half, shape):
    fold = bautin().at_fold(squared)
    forms = forms_of(shape(fold.cycle(squared)), half)
    found = fold_coefficients(forms, forms.mode(flip=False))
    assert found.b == pytest.approx(fold.lpc_coefficient(squared), rel=1e-9)


@HALVES
def test_b_vanishes_at_a_cusp_of_cycles(half):
    cusp = cusp_of_cycles()
    forms = forms_of(cusp.cycle(cusp.cusp), half)
    assert abs(fold_coefficients(forms, forms.mode(flip=False)).b) < 1e-9


@SHAPES
@pytest.mark.parametrize("c", [-0.8, 0.5])
def test_c_of_a_period_doubling_is_the_closed_form(c, shape):
    cycle = shape(TwistedBand(half_twists=1, c=c).cycle())
    forms = forms_of(cycle, half=False)
    found = flip_coefficients(forms, forms.mode(flip=True))
    assert found.c == pytest.approx(cycle.coefficient.real, rel=1e-9)
    assert np.sign(found.matcont) == np.sign(c)


@SHAPES
@pytest.mark.parametrize(
    "system", [TwistedBand(half_twists=2), OddPitchfork(winding=2)], ids=["band", "odd"]
)
def test_c_of_broken_symmetry_is_the_closed_form(system, shape):
    cycle = shape(system.cycle())
    forms = forms_of(cycle, half=True)
    found = flip_coefficients(forms, forms.mode(flip=True))
    assert found.c == pytest.approx(cycle.coefficient.real, rel=1e-9)


@SHAPES
def test_d_of_a_torus_is_the_closed_form(shape):
    exact = TorusBirth()
    cycle = shape(exact.cycle())
    found = torus_coefficient(forms_of(cycle, half=False), exact.theta * cycle.period)
    assert found.d == pytest.approx(cycle.coefficient, rel=1e-9)


def test_d_of_a_torus_on_half_a_period_has_the_same_real_part():
    # Im d belongs to one choice of the angle modulo 2 pi; half a period makes another one.
    exact = TorusBirth()
    cycle = sheared(exact.cycle())
    forms = forms_of(cycle, half=True)
    angle = float(np.angle(cycle.half_multipliers[1]))
    found = torus_coefficient(forms, abs(angle))
    assert found.d.real == pytest.approx(cycle.coefficient.real, rel=1e-9)


def test_coefficients_do_not_depend_on_the_mesh():
    cycle = sheared(TwistedBand(half_twists=1).cycle())
    coarse, fine = (forms_of(cycle, half=False, intervals=N) for N in (20, 80))
    values = [flip_coefficients(f, f.mode(flip=True)).c for f in (coarse, fine)]
    assert values[0] == pytest.approx(values[1], rel=1e-8)
