"""numba source for f and its exact first derivatives, written from a tape.

One function a (tape, list of variables to differentiate by). It loops over points, so one call
serves a single state, a whole collocation mesh or a figure; what depends on parameters only is
computed once a call. Sources are cached on disk by their hash, beside numba's own cache of the
machine code, and never committed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from types import ModuleType

import numba
import platformdirs

from wheelset.bifurcation.tape import Kind, Operation, Tape

logger = logging.getLogger(__name__)

Derivative = dict[int, str]  # variable slot -> source of the derivative, zeros left out

_HEADER = '''"""Generated from a tape; do not edit."""
from math import cos, exp, log, sin, isfinite
from numba import njit


@njit(cache=True, error_model="numpy", fastmath={"contract", "nsz"})
def evaluate(X, p, sampled, F, J, status):
'''


@dataclass
class _Source:
    """Collects lines; ``once`` before the loop over points, ``each`` inside it."""

    tape: Tape
    variables: tuple[int, ...]
    once: list[str] = field(default_factory=list)
    each: list[str] = field(default_factory=list)
    value: dict[int, str] = field(default_factory=dict)
    slope: dict[int, Derivative] = field(default_factory=dict)
    fixed: set[int] = field(default_factory=set)

    def write(self, slot: int, suffix: str, expression: str) -> str:
        """Assign an expression to a fresh name, before the loop if nothing in it varies."""
        name = f"s{slot}{suffix}"
        (self.once if slot in self.fixed else self.each).append(f"{name} = {expression}")
        return name


def source(tape: Tape, variables: tuple[int, ...]) -> str:
    """Source of ``evaluate(X, p, sampled, F, J, status)``.

    X (points, n); p (m,); sampled (points, functions, 2) values and slopes; F (points, n);
    J (points, n, len(variables)); status (points,): 0, or 1 + index of the first condition
    violated, or -1 where f is not finite. ``variables`` are slots below n + m.
    """
    s = _Source(tape, variables)
    _inputs(s)
    for i, operation in enumerate(tape.operations):
        _operation(s, tape.n + tape.m + i, operation)
    _outputs(s)
    once = "".join(f"    {line}\n" for line in s.once)
    each = "".join(f"        {line}\n" for line in s.each)
    return f"{_HEADER}{once}    for i in range(X.shape[0]):\n{each}"


def _inputs(s: _Source) -> None:
    for slot in range(s.tape.n + s.tape.m):
        if slot >= s.tape.n:
            s.fixed.add(slot)
        origin = f"X[i, {slot}]" if slot < s.tape.n else f"p[{slot - s.tape.n}]"
        s.value[slot] = s.write(slot, "", origin)
        s.slope[slot] = {slot: "1.0"} if slot in s.variables else {}


def _operation(s: _Source, slot: int, o: Operation) -> None:
    arguments = _arguments(o)
    if o.kind != Kind.SAMPLED and all(a in s.fixed for a in arguments):
        s.fixed.add(slot)
    s.value[slot] = s.write(slot, "", _value(s, o))
    if o.kind == Kind.SELECT:
        s.slope[slot] = _select(s, slot, o)
        return
    chain = _chain(s, slot, o)
    used = sorted({v for a, _ in chain for v in s.slope[a]})
    s.slope[slot] = {v: s.write(slot, f"_{v}", _sum(s, chain, v)) for v in used}


def _select(s: _Source, slot: int, o: Operation) -> Derivative:
    """Slopes of the chosen side only: the other one may be infinite."""
    b, c = s.slope[o.b], s.slope[o.c]
    choice = f"if {s.value[o.a]} > 0.0 else"
    return {
        v: s.write(slot, f"_{v}", f"{b.get(v, '0.0')} {choice} {c.get(v, '0.0')}")
        for v in sorted({*b, *c})
    }


def _arguments(o: Operation) -> tuple[int, ...]:
    if o.kind == Kind.CONSTANT:
        return ()
    if o.kind in (Kind.ADD, Kind.MUL):
        return (o.a, o.b)
    return (o.a, o.b, o.c) if o.kind == Kind.SELECT else (o.a,)


def _value(s: _Source, o: Operation) -> str:
    a, b, c = (s.value.get(slot, "") for slot in (o.a, o.b, o.c))
    rules = {
        Kind.CONSTANT: f"{o.k!r}",
        Kind.ADD: f"{a} + {b}",
        Kind.MUL: f"{a} * {b}",
        Kind.SHIFT: f"{a} + {o.k!r}",
        Kind.SCALE: f"{o.k!r} * {a}",
        Kind.POWER: f"1.0 / {a}" if o.k == -1 else f"{a} ** {o.k!r}",
        Kind.EXP: f"exp({a})",
        Kind.LOG: f"log({a})",
        Kind.SIN: f"sin({a})",
        Kind.COS: f"cos({a})",
        Kind.SAMPLED: f"sampled[i, {o.b}, 0]",
        Kind.SELECT: f"{b} if {a} > 0.0 else {c}",
    }
    return rules[o.kind]


def _chain(s: _Source, slot: int, o: Operation) -> list[tuple[int, str]]:
    """(argument, partial derivative by it); only where the argument varies."""
    if o.kind == Kind.CONSTANT or not any(s.slope[a] for a in _arguments(o)):
        return []
    a, b, here = s.value[o.a], s.value.get(o.b, ""), s.value[slot]
    if o.kind == Kind.ADD:
        return [(o.a, ""), (o.b, "")]
    if o.kind == Kind.MUL:
        return [(o.a, b), (o.b, a)]
    rules = {
        Kind.SHIFT: lambda: "",
        Kind.SCALE: lambda: repr(o.k),
        Kind.POWER: lambda: s.write(
            slot, "_p", f"-{here} * {here}" if o.k == -1 else f"{o.k!r} * {here} / {a}"
        ),
        Kind.EXP: lambda: here,
        Kind.LOG: lambda: s.write(slot, "_p", f"1.0 / {a}"),
        Kind.SIN: lambda: s.write(slot, "_p", f"cos({a})"),
        Kind.COS: lambda: s.write(slot, "_p", f"-sin({a})"),
        Kind.SAMPLED: lambda: f"sampled[i, {o.b}, 1]",
    }
    return [(o.a, rules[o.kind]())]


def _sum(s: _Source, chain: list[tuple[int, str]], variable: int) -> str:
    terms = [_product(p, s.slope[a][variable]) for a, p in chain if variable in s.slope[a]]
    return " + ".join(terms)


def _product(factor: str, slope: str) -> str:
    if slope == "1.0":
        return factor or "1.0"
    return f"{factor} * {slope}" if factor else slope


def _outputs(s: _Source) -> None:
    for row, slot in enumerate(s.tape.outputs):
        s.each.append(f"F[i, {row}] = {s.value[slot]}")
        for column, v in enumerate(s.variables):
            s.each.append(f"J[i, {row}, {column}] = {s.slope[slot].get(v, '0.0')}")
    results = [f"F[i, {row}]" for row in range(s.tape.n)]
    results += [f"J[i, {row}, {c}]" for row in range(s.tape.n) for c in range(len(s.variables))]
    s.each.append(f"status[i] = 0 if isfinite({' + '.join(results)}) else -1")
    for number, (slot, condition) in reversed(list(enumerate(s.tape.conditions, start=1))):
        if condition.order == 0:
            s.each.append(f"if not {s.value[slot]} > {condition.least!r}: status[i] = {number}")


def cache_folder() -> Path:
    """Where generated code lives: ``$WHEELSET_CACHE_DIR`` or the user's cache folder."""
    chosen = os.environ.get("WHEELSET_CACHE_DIR")
    return Path(chosen) if chosen else Path(platformdirs.user_cache_dir("wheelset"))


@lru_cache(maxsize=256)
def kernel(tape: Tape, variables: tuple[int, ...]) -> Callable[..., None]:
    """The compiled ``evaluate`` of a tape, differentiated by the given slots."""
    return compiled(source(tape, variables))


def compiled(text: str) -> Callable[..., None]:
    """The compiled ``evaluate`` of a source, from the cache on disk where it is there."""
    digest = hashlib.sha256(f"{numba.__version__}\n{text}".encode()).hexdigest()[:24]
    path = cache_folder() / f"kernel_{digest}.py"
    if not path.exists():
        logger.info("writing kernel %s", path)
        _write_atomically(path, text)
    return _load(path).evaluate


def _write_atomically(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile("w", dir=path.parent, suffix=".part", delete=False) as f:
        f.write(text)
    Path(f.name).replace(path)


def _load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # numba looks the module up by name to reload machine code
    spec.loader.exec_module(module)
    return module
