"""What is to be integrated and how, checked before anything runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import BDF, DOP853, LSODA, RK45, OdeSolver, Radau
from scipy.linalg import expm

from wheelset.bifurcation.integration.events import EventSpec
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

METHODS: dict[str, type[OdeSolver]] = {
    "DOP853": DOP853,
    "RK45": RK45,
    "Radau": Radau,
    "BDF": BDF,
    "LSODA": LSODA,
}
#: Absolute over relative tolerance, times the typical size of each state.
ATOL_SHARE = 1e-3


@dataclass(frozen=True, eq=False)
class Plan:
    """A system with parameters p (m,), a method, its tolerances and what to look out for.

    atol: (n,), in the states' units. section: index of the state whose maxima are the returns by
    which a cycle is recognised.
    """

    system: System
    p: Array
    method: str
    rtol: float
    atol: Array
    max_step: float
    max_steps: int
    events: tuple[EventSpec, ...]
    stop_when_settled: bool
    settle_tol: float
    section: int


def checked_state(system: System, x0: ArrayLike) -> Array:
    """The initial state (n,), or a ValueError that says what is wrong with it."""
    x = np.array(x0, dtype=np.float64)
    if x.shape != (system.n,):
        names = ", ".join(system.state_names)
        raise ValueError(f"x0 has shape {x.shape}: has to be ({system.n},); give {names}")
    for name, value in zip(system.state_names, x, strict=True):
        _require(np.isfinite(value), f"x0 of {name}", value, "finite", "give a number in SI units")
    return x


def checked_parameters(system: System, p: ArrayLike | None) -> Array:
    """The parameter vector (m,), or a ValueError that says what is wrong with it."""
    vector = system.p() if p is None else np.array(p, dtype=np.float64)
    m = len(system.parameter_names)
    if vector.shape != (m,):
        raise ValueError(f"p has shape {vector.shape}: has to be ({m},); make it with system.p()")
    for name, value in zip(system.parameter_names, vector, strict=True):
        _require(np.isfinite(value), f"p of {name}", value, "finite", "give a number in SI units")
    return vector


def checked_span(t_start: float, t_end: float) -> None:
    """ValueError unless t_start < t_end, both finite."""
    _require(np.isfinite(t_start), "t_start", t_start, "finite", "give seconds")
    good = np.isfinite(t_end) and t_end > t_start
    _require(good, "t_end", t_end, f"finite and after t_start = {t_start:g}", "give a later time")


def checked_options(plan_method: str, rtol: float, max_step: float, settle_tol: float) -> None:
    """ValueError for an unknown method or a tolerance or step out of range."""
    if plan_method not in METHODS:
        raise ValueError(
            f"method = {plan_method!r}: allowed are {', '.join(METHODS)}; "
            "choose DOP853, or Radau where the problem is stiff"
        )
    _require(1e-13 <= rtol <= 0.1, "rtol", rtol, "within 1e-13 .. 0.1", "1e-9 is the default")
    _require(max_step > 0, "max_step", max_step, "positive", "give seconds, or leave it out")
    _require(0 < settle_tol < 1, "settle_tol", settle_tol, "within 0 .. 1", "1e-6 is the default")


def checked_atol(system: System, p: Array, x0: Array, rtol: float, atol: ArrayLike | None) -> Array:
    """atol as (n,): as given, or ``rtol`` times 1e-3 of each state's typical size."""
    if atol is None:
        return ATOL_SHARE * rtol * typical_size(system, p, x0)
    given = np.asarray(atol, dtype=np.float64)
    good = given.shape in ((), (system.n,)) and bool(np.all(given > 0) and np.isfinite(given).all())
    allowed = f"a positive number or {system.n} of them"
    _require(good, "atol", atol, allowed, "leave it out for a default scaled by state")
    return np.broadcast_to(given, (system.n,)).copy()


def checked_section(system: System, section: str | None) -> int:
    """Index of the section state, the first one by default."""
    if section is None:
        return 0
    names = ", ".join(system.state_names)
    _require(section in system.state_names, "section", section, f"one of {names}", "name a state")
    return system.state_names.index(section)


def _require(good: object, field: str, value: object, allowed: str, remedy: str) -> None:
    if not good:
        raise ValueError(f"{field} = {value!r}: has to be {allowed}; {remedy}")


def typical_size(system: System, p: Array, x0: Array) -> Array:
    """How large each state gets, (n,), judged by the linearised motion that starts at x0.

    The states differ by orders of magnitude and most start at zero, so that |x0| will not do.
    The linear motion is looked at after the time 1/|lambda| of each eigenvalue; couplings that
    cancel are kept from giving a size below the rounding of their terms.
    """
    f, jacobian = system.evaluate(x0, p)
    size = np.abs(x0)
    augmented = np.zeros((system.n + 1, system.n + 1))
    augmented[:-1, :-1], augmented[:-1, -1] = jacobian, f
    for t in _characteristic_times(jacobian):
        size = np.maximum(size, np.abs(expm(augmented * t)[:-1, -1]))
    fastest = np.abs(np.linalg.eigvals(jacobian)).max(initial=0.0)
    if fastest > 0:
        size = np.maximum(size, 1e-3 * np.abs(jacobian) @ size / fastest)
    known = size[size > 0]
    return np.where(size > 0, size, known.min() if len(known) else 1.0)


def _characteristic_times(jacobian: Array) -> list[float]:
    """1/|lambda|, cut short where an unstable mode would grow by more than e."""
    eigenvalues = np.linalg.eigvals(jacobian)
    growth = max(float(eigenvalues.real.max()), 0.0)
    times = [1 / abs(z) for z in eigenvalues if abs(z) > 0] or [1.0]
    return [min(t, 1 / growth) if growth > 0 else t for t in times]
