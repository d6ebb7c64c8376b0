"""What "a few terms are neglected" in section 3 may mean: readings as changes to the two cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from scipy.optimize import newton

from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.studies.flange_cycles import AS_FILED, Family, Parameters, families_of, hopf_of

#: The second reading: the terms of the sum of curvatures are neglected as well.
CONSTANT = "curvatures constant"

#: What section 3 neglects, as the packaged cases read it.
NEGLECTED = ("c1=0", "c3=0")

#: The terms of the sum of curvatures beyond its constant, left out.
CURVATURES = ("e1=0", "e3=0", "f1=0", "f3=0")

#: The physically consistent vehicle with what the packaged cases neglect, with the curvatures
#: constant as well, with nothing neglected.
PHYSICAL = "physical"
PHYSICAL_CONSTANT = "physical, curvatures constant"
PHYSICAL_IN_FULL = "physical, nothing neglected"

#: Without flange force: what the two cases are told apart by.
PLAIN = "flange_law=none"


def readings(p: Parameters) -> dict[str, dict[int, tuple[str, ...]]]:
    """Changes to the cases by reading and case."""
    return {
        AS_FILED: dict.fromkeys(p.cases, ()),
        CONSTANT: {case: chosen_again(p, case, CURVATURES) for case in p.cases},
    }


def chosen_again(p: Parameters, case: int, changes: Sequence[str]) -> tuple[str, ...]:
    """Changes to a case, with a1 and a3 chosen again so that Hopf speed and first Lyapunov
    coefficient without flange force stay the case's own.
    """
    own = p.load(p.cases[case], rows=[PLAIN])
    wanted = hopf_of(p, own)

    def apart(number: Callable[[HopfPoint], float], *rows: str) -> float:
        hopf = hopf_of(p, p.load(p.cases[case], rows=[*changes, *rows, PLAIN]))
        return number(hopf) - number(wanted)

    a1 = _root("a1", lambda x: apart(_speed, f"a1={x!r}"), own.values["a1"])
    a3 = _root("a3", lambda x: apart(_flc, f"a1={a1!r}", f"a3={x!r}"), own.values["a3"])
    return (*changes, f"a1={a1!r}", f"a3={a3!r}")


def _root(name: str, function: Callable[[float], float], guess: float) -> float:
    """The zero of a function of a coefficient, by the secant method."""
    try:
        return float(newton(lambda x: function(float(x)), guess, rtol=1e-10))
    except RuntimeError as cause:
        raise NoConvergence(f"{name} of a case in another reading: {cause}", ()) from cause


def _speed(hopf: HopfPoint) -> float:
    return hopf.value


def _flc(hopf: HopfPoint) -> float:
    if hopf.lyapunov is None:
        raise NoConvergence(f"the first Lyapunov coefficient: {hopf.reason}", ())
    return hopf.lyapunov


def physical_families(p: Parameters) -> tuple[Family, ...]:
    """Cycles of the physically consistent vehicle under the exponential law, with what the packaged
    cases neglect, with more neglected and with nothing; its own a3.
    """
    law = "exponential"
    readings = {
        PHYSICAL: NEGLECTED,
        PHYSICAL_CONSTANT: (*NEGLECTED, *CURVATURES),
        PHYSICAL_IN_FULL: (),
    }
    return tuple(
        family
        for reading, rows in readings.items()
        for family in families_of(
            p, p.load(p.vehicle_physical, rows=[*rows, f"flange_law={law}"]), (reading, 0, law)
        )
    )


def both_wheels(p: Parameters) -> tuple[Family, ...]:
    """Case 2's cycles with the flange law counted on both wheels."""
    name = "flange on both wheels"
    return tuple(
        family
        for law in ("quintic", "exponential", "reciprocal")
        for family in families_of(
            p,
            p.load(p.cases[2], rows=["flange_wheels=2", f"flange_law={law}"]),
            (name, 2, law),
        )
    )
