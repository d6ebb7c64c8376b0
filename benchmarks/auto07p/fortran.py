"""A system's symbolic field as a Fortran problem for AUTO-07p.

Only the free parameters live in PAR; the others become named constants that the compiler can
fold, as somebody writing the problem by hand would declare them. Fortran does not tell a from A,
so symbols get plain names (x state, q parameter, s assignment) with their own in a comment.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import sympy as sp
from sympy.printing.fortran import FCodePrinter

from wheelset.bifurcation.fields.field import Assignment, VectorField
from wheelset.bifurcation.system import System

#: AUTO keeps PAR(11) for the period and PAR(10) for time; free parameters take the slots below.
PERIOD = 11
MOST_FREE = 9
WIDTH = 96

Slopes = dict[int, sp.Expr]  # place of a variable -> derivative, zeros left out

_PROBLEM = Path(__file__).with_name("problem.f90.txt").read_text("ascii")


class _Printer(FCodePrinter):
    """Free-form double precision. Roots are printed apart from whole powers, so that x**0.63 and
    the x**(-0.37) of its derivative cost one call.
    """

    def __init__(self) -> None:
        super().__init__({"source_format": "free", "standard": 95, "precision": 17})

    def _wrap_fortran(self, lines: list[str]) -> list[str]:
        return lines  # statements are broken once they are whole

    def _print_Pow(self, expr: sp.Pow) -> str:
        base, exponent = expr.as_base_exp()
        if not exponent.is_number or exponent.is_Integer:
            return super()._print_Pow(expr)
        power = int(sp.floor(exponent))
        whole = super()._print_Pow(sp.Pow(base, power, evaluate=False)) if power else "1d0"
        if exponent == power:
            return whole
        root = super()._print_Pow(sp.Pow(base, exponent - power, evaluate=False))
        return f"({root}*({whole}))" if power else root


def problem(system: System, free: Sequence[str], half: bool = False) -> str:
    """Fortran source of FUNC with both Jacobians, STPNT, BCND and ICND.

    free: names of the parameters for PAR(1), PAR(2), ...; the others keep the system's values.
    half: f is multiplied by PAR(11)/2, so that an odd cycle of period PAR(11) obeys
    u(0) + u(1) = 0; STPNT sets PAR(11) = 2, with which equilibria are those of f.
    Raises ValueError for a field that is not one closed formula, or too many free parameters.
    """
    model = _model(system, free)
    by_state, state_rows = _slopes(model.field, model.field.state, "d")
    by_parameter, parameter_rows = _slopes(model.field, model.free, "e")
    lone = [f"dfdp(:, {PERIOD}) = f/par({PERIOD})"] if half else []
    return _PROBLEM.format(
        form="half" if half else "full",
        period=PERIOD,
        free=len(free),
        declarations=_lines(_declarations(model, half, [*by_state, *by_parameter])),
        values=_lines(_values(model, half)),
        by_state=_lines([*_steps(by_state), *_matrix("dfdu", state_rows)]),
        by_parameter=_lines([*_steps(by_parameter), *_matrix("dfdp", parameter_rows), *lone]),
        start=_lines(_start(model, half)),
    )


@dataclass(frozen=True)
class _Model:
    """A field in plain symbols, what they were ``called``, and the parameters' values."""

    field: VectorField
    free: tuple[sp.Symbol, ...]
    values: dict[sp.Symbol, float]
    called: dict[sp.Symbol, str]


def _model(system: System, free: Sequence[str]) -> _Model:
    if not 1 <= len(free) <= MOST_FREE:
        raise ValueError(f"{len(free)} free parameters; there are slots for 1 to {MOST_FREE}")
    if system.field.switch or system.functions:
        raise ValueError("the field has a switch or a sampled function; give a closed formula")
    new = _plain_symbols(system.field)
    field = _renamed(system.field, new)
    values = dict(zip(field.parameters, system.p(), strict=True))
    chosen = tuple(field.parameters[system.index(name)] for name in free)
    return _Model(field, chosen, values, {symbol: old.name for old, symbol in new.items()})


def _plain_symbols(field: VectorField) -> dict[sp.Symbol, sp.Symbol]:
    groups = {"x": field.state, "q": field.parameters, "s": [s for s, _ in field.assignments]}
    return {
        symbol: sp.Symbol(f"{letter}{i}", real=True)
        for letter, group in groups.items()
        for i, symbol in enumerate(group, 1)
    }


def _renamed(field: VectorField, new: dict[sp.Symbol, sp.Symbol]) -> VectorField:
    return VectorField(
        tuple(new[s] for s in field.state),
        tuple(new[s] for s in field.parameters),
        tuple(e.xreplace(new) for e in field.derivative),
        tuple((new[s], e.xreplace(new)) for s, e in field.assignments),
    )


def _slopes(
    field: VectorField, variables: Sequence[sp.Symbol], letter: str
) -> tuple[list[Assignment], list[Slopes]]:
    """Assignments that carry derivatives by the variables forward, and the rows of f's own."""
    known: dict[sp.Symbol, Slopes] = {v: {k: sp.Integer(1)} for k, v in enumerate(variables, 1)}
    steps: list[Assignment] = []
    for symbol, expression in field.assignments:
        known[symbol] = _chain(expression, known)
        for k, slope in known[symbol].items():
            if not slope.is_Atom:
                known[symbol][k] = sp.Symbol(f"{letter}{symbol}_{k}", real=True)
                steps.append((known[symbol][k], slope))
    return steps, [_chain(expression, known) for expression in field.derivative]


def _chain(expression: sp.Expr, known: dict[sp.Symbol, Slopes]) -> Slopes:
    total: Slopes = {}
    for symbol in sorted(expression.free_symbols & known.keys(), key=str):
        partial = expression.diff(symbol)
        for k, slope in known[symbol].items():
            total[k] = total.get(k, sp.Integer(0)) + partial * slope
    return {k: slope for k, slope in total.items() if slope != 0}


def _declarations(model: _Model, half: bool, slopes: Iterable[Assignment]) -> list[str]:
    fixed = [s for s in model.field.parameters if s not in model.free]
    assigned = (s for s, _ in (*model.field.assignments, *slopes))
    names = [str(s) for s in (*model.field.state, *model.free, *assigned)]
    kind = "double precision"
    return [
        f"{kind} :: scale" if half else f"{kind}, parameter :: scale = 1",
        *(f"{kind}, parameter :: {s} = {_number(model, s)}  ! {model.called[s]}" for s in fixed),
        *(f"{kind} :: {', '.join(names[i : i + 8])}" for i in range(0, len(names), 8)),
    ]


def _values(model: _Model, half: bool) -> list[str]:
    return [
        *([f"scale = par({PERIOD})/2"] if half else []),
        *(f"{s} = u({i})  ! {model.called[s]}" for i, s in enumerate(model.field.state, 1)),
        *(f"{s} = par({k})  ! {model.called[s]}" for k, s in enumerate(model.free, 1)),
        *_steps(model.field.assignments, model.called),
        *(f"f({i}) = scale*({_text(e)})" for i, e in enumerate(model.field.derivative, 1)),
    ]


def _start(model: _Model, half: bool) -> list[str]:
    values = [f"par({k}) = {_number(model, s)}" for k, s in enumerate(model.free, 1)]
    return ["u = 0", *values, *([f"par({PERIOD}) = 2"] if half else [])]


def _steps(
    assignments: Iterable[Assignment], called: dict[sp.Symbol, str] | None = None
) -> list[str]:
    comment = {s: f"  ! {name}" for s, name in (called or {}).items()}
    return [f"{s} = {_text(e)}{comment.get(s, '')}" for s, e in assignments]


def _matrix(name: str, rows: Sequence[Slopes]) -> list[str]:
    return [
        f"{name}({i}, {k}) = scale*({_text(slope)})"
        for i, row in enumerate(rows, 1)
        for k, slope in row.items()
    ]


def _number(model: _Model, parameter: sp.Symbol) -> str:
    """The shortest decimal that is the value, in double precision: 0.46d0, 1.6d+15."""
    digits = repr(float(model.values[parameter]))
    return digits.replace("e", "d") if "e" in digits else f"{digits}d0"


def _text(expression: sp.Expr) -> str:
    return _Printer().doprint(expression)


def _lines(statements: Iterable[str]) -> str:
    """Statements on lines short enough for free form, broken anywhere as it allows."""
    return "\n".join(_wrapped(statement) for statement in statements)


def _wrapped(statement: str) -> str:
    code, mark, comment = statement.partition("  ! ")
    pieces = [code[i : i + WIDTH] for i in range(0, len(code), WIDTH)]
    return "  " + "&\n    &".join(pieces) + mark + comment
