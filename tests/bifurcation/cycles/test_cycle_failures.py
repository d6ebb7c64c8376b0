"""What goes wrong on branches of cycles ends with a name, and nothing that was computed is lost."""

import numpy as np
import pytest
import sympy as sp

from tests.exact_systems import bautin, hopf
from wheelset.bifurcation.curves.continuation import extend, follow, resume
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    cycle_from_guess,
    cycle_from_hopf,
    cycle_from_orbit,
)
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System


def started(system=None, parameter="b1"):
    system = system or hopf(0.2).system
    return cycle_from_hopf(system, hopf_point(system, parameter, 0.01), 1.0)


def bounded_oscillator(limit: float) -> System:
    """The Hopf normal form with a term that is not defined beyond a radius."""

    def f(x, p):
        (u, v), (mu,) = x, p
        r2 = u**2 + v**2
        edge = 0.01 * sp.log(limit - r2)
        return [(mu - r2) * u - v + u * edge, u + (mu - r2) * v + v * edge]

    return System.from_function(f, ("u", "v"), {"mu": 0.0})


def test_a_branch_that_leaves_the_domain_of_the_field_ends_with_its_words():
    system = bounded_oscillator(0.3)
    start = cycle_from_hopf(system, hopf_point(system, "mu", 0.0), 1.0)
    branch = follow(start.problem, start.u, direction=start.tangent, windows={"mu": (-1, 1)})
    assert branch.ended.kind in ("not finite", "least step", "problem")
    assert "mu" in str(branch.ended) or "u = " in str(branch.ended) or "cycle" in str(branch.ended)
    assert np.isfinite(branch.values).all()
    assert branch.points[-1].solution.measure("amplitude u") < np.sqrt(0.3)


def test_a_window_already_left_at_the_start_is_said():
    start = started()
    branch = follow(start.problem, start.u, direction=start.tangent, windows={"b1": (0.5, 1.0)})
    assert len(branch) == 1
    assert branch.ended.kind == "window" and "already at the start" in branch.ended.words


def test_no_cycle_near_a_guess_is_said_with_the_residuals():
    system = hopf(-0.3).system  # the origin attracts everything: there is no cycle
    with pytest.raises(NoConvergence, match="last residual norms"):
        cycle_from_guess(system, "b1", lambda s: np.column_stack([np.cos(9 * s), s**2]), 1.0)


def test_an_orbit_without_two_turns_is_refused():
    run = integrate(hopf(0.2).system, [0.3, 0.0], 1.0)
    with pytest.raises(ValueError, match="no two periods"):
        cycle_from_orbit(hopf(0.2).system, "b1", run)


@pytest.mark.parametrize("intervals", [0, 1])
def test_too_few_intervals_are_refused(intervals):
    with pytest.raises(ValueError, match="at least 2"):
        Discretisation(intervals)


@pytest.mark.parametrize("accuracy", [0.0, 1e-20, 2.0])
def test_an_accuracy_out_of_reach_is_refused(accuracy):
    with pytest.raises(ValueError, match="accuracy"):
        Meshing(accuracy=accuracy)


def test_a_measure_that_does_not_exist_is_named_with_those_that_do():
    start = started()
    branch = follow(start.problem, start.u, direction=start.tangent, steps=2)
    with pytest.raises(ValueError, match="amplitude"):
        branch.points[0].solution.measure("heat")


def test_a_branch_interrupted_and_resumed_is_the_same_bit_by_bit(tmp_path):
    start = started(bautin(b2=0.5).system)

    def walk(steps, **more):
        return follow(start.problem, start.u, direction=start.tangent, steps=steps, **more)

    whole, part = walk(40), walk(13)
    resumed = extend(part, 27)
    assert len(whole) == len(resumed)
    assert all(np.array_equal(a.u, b.u) for a, b in zip(whole.points, resumed.points, strict=True))
    assert [p.kind for p in whole.special] == [p.kind for p in resumed.special]


def test_a_killed_branch_goes_on_from_its_checkpoint(tmp_path, monkeypatch):
    monkeypatch.setattr("wheelset.bifurcation.curves.continuation.CHECKPOINT_EVERY", 0.0)
    start, file = started(bautin(b2=0.5).system), tmp_path / "branch.pickle"
    seen = []

    def killer(point):
        seen.append(point)
        if len(seen) == 12:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        follow(start.problem, start.u, direction=start.tangent, steps=30, progress=killer,
               checkpoint=file)  # fmt: skip
    again = resume(file)
    whole = follow(start.problem, start.u, direction=start.tangent, steps=30)
    assert len(again) == len(whole)
    assert np.array_equal(again.points[-1].u, whole.points[-1].u)
