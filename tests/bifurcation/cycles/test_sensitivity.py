"""How Hopf points and folds move: against closed forms and against points computed anew."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.bifurcation.cycles.test_critical_curves import HALVES, fold_of
from tests.exact_systems import bautin, hopf, lorenz, lorenz_hopf
from tests.systems import TOY, closed_form_critical_speed, toy_wheelset
from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.fold_sensitivity import fold_sensitivity
from wheelset.bifurcation.equilibria.hopf import hopf_point, instabilities
from wheelset.bifurcation.equilibria.hopf_sensitivity import hopf_sensitivity

#: The toy's folds are found on the mesh they were left on, so that differences are smooth.
KEPT = Meshing(every=0, accuracy=None)


@pytest.mark.parametrize("name", ["m", "I", "Ky", "Kx", "r0", "b", "a1", "f11", "f22"])
def test_toy_hopf_speed_moves_as_the_closed_form_says(name):
    system = toy_wheelset().with_values(p1=1e-12)
    point = hopf_point(system, "v", 50.0)
    step = 1e-5 * TOY[name]
    above, below = (
        closed_form_critical_speed({**TOY, name: TOY[name] + s * step})[0] for s in (1, -1)
    )
    found = hopf_sensitivity(system, point, [name])[name]
    assert found == pytest.approx((above - below) / (2 * step), rel=1e-7)


def test_an_equilibrium_that_moves_with_the_parameter_is_taken_along():
    system = lorenz()
    r, sigma = lorenz_hopf()[0], 10.0
    guess = [((8 / 3) * (r - 1)) ** 0.5] * 2 + [r - 1]
    (point,) = (
        p for p in instabilities(system, "r", (20.0, 30.0), guess=guess) if p.kind[0] == "H"
    )
    step = 1e-5
    slope = (lorenz_hopf(sigma + step)[0] - lorenz_hopf(sigma - step)[0]) / (2 * step)
    assert hopf_sensitivity(system, point, ["sigma"])["sigma"] == pytest.approx(slope, rel=1e-8)


@HALVES
def test_bautins_fold_moves_along_its_parabola(half):
    system = bautin(b2=0.5).system
    fold = fold_of(system, "b1", 0.01, half, window={"b1": (-1.0, 0.5)})
    found = fold_sensitivity(system, fold.solution, "b1", ["b2", "w"])
    assert found["b2"] == pytest.approx(-0.25, abs=1e-9)  # b1 = -b2^2 / 4
    assert found["w"] == pytest.approx(0.0, abs=1e-9)


@HALVES
def test_the_toys_fold_moves_as_folds_computed_anew_say(half):
    system = toy_wheelset()
    fold = fold_of(system, "v", 50.0, half, width=10.0, window={"v": (45.0, 55.0)})

    def speed(name, value):
        start = lpc_from_cycle(
            system.with_values(**{name: value}), _at(fold.solution, name, value), ("v", name),
            (10.0, None), KEPT,
        )  # fmt: skip
        return float(start.problem.values(start.u)[0])

    found = fold_sensitivity(system, fold.solution, "v", ["a3", "a1", "m", "q"])
    for name, slope in found.items():
        value = system.values[name]
        step = 1e-4 * value
        central = (speed(name, value + step) - speed(name, value - step)) / (2 * step)
        assert slope == pytest.approx(central, rel=1e-5), name


def _at(cycle, name, value):
    return replace(cycle, parameters={**cycle.parameters, name: value})


def test_a_parameter_that_does_not_move_the_eigenvalues_across_the_axis_is_an_outcome():
    system = hopf().system
    point = replace(hopf_point(system, "b1", 0.01), parameter="w", value=2.0)
    with pytest.raises(SingularSystem, match="do not cross the axis with w"):
        hopf_sensitivity(system, point, ["b1"])
