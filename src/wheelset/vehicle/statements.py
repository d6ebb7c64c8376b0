"""Statements about a vehicle, before it is known whether they can be believed.

A statement is what a file or an override says of one parameter: a number, a text with a unit,
or a table with source and reason, together with where it was said.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from wheelset.vehicle.options import ModelOptions, allowed_values, option_names
from wheelset.vehicle.parameters import BY_NAME
from wheelset.vehicle.problems import Problems, VehicleError, did_you_mean
from wheelset.vehicle.quantity import Quantity, read_quantity

OVERRIDE = "override"

Overrides = Iterable[str] | Mapping[str, float | int | str]


class Statement(NamedTuple):
    """``entry`` as it stands in the file ``origin``."""

    entry: object
    origin: str


class Statements(NamedTuple):
    """Statements on parameters and choices of options, by name."""

    parameters: dict[str, Statement]
    options: dict[str, object]


def parse_overrides(overrides: Overrides) -> Statements:
    """Statements of texts ``name=value[ unit]`` or of a mapping of names to values.

    Raises VehicleError with every unknown or repeated name and every text without ``=``.
    """
    problems = Problems()
    stated: dict[str, object] = {}
    for name, value in _pairs(overrides, problems):
        if name in stated:
            problems.add(f"{name} is given twice: {stated[name]} and {value}")
        stated[name] = value
    problems.add(*(_unknown(name) for name in stated if not _is_known(name)))
    problems.raise_any()
    return Statements(
        {name: Statement(value, OVERRIDE) for name, value in stated.items() if name in BY_NAME},
        {name: value for name, value in stated.items() if name not in BY_NAME},
    )


def _pairs(overrides: Overrides, problems: Problems) -> list[tuple[str, object]]:
    if isinstance(overrides, Mapping):
        return [(str(name), value) for name, value in overrides.items()]
    texts = [overrides] if isinstance(overrides, str) else [str(text) for text in overrides]
    pairs: list[tuple[str, object]] = []
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if equals and name:
            pairs.append((name, value))
        else:
            problems.add(f'override "{text}" is not of the form name=value, such as a1=0.3')
    return pairs


def _is_known(name: str) -> bool:
    return name in BY_NAME or name in ModelOptions.model_fields


def _unknown(name: str) -> str:
    hint = did_you_mean(name, [*BY_NAME, *option_names()])
    return f'unknown parameter or option "{name}"{hint}'


def read_quantities(statements: Mapping[str, Statement], problems: Problems) -> dict[str, Quantity]:
    """The quantities that could be read; the rest is noted in ``problems``."""
    quantities = {}
    for name, statement in statements.items():
        with problems.noted():
            quantities[name] = read_quantity(BY_NAME[name], statement.entry, statement.origin)
    return quantities


def read_options(choices: Mapping[str, object], problems: Problems) -> ModelOptions:
    """The options that could be read, defaults for the rest, which is noted in ``problems``."""
    chosen: dict[str, Any] = {}
    for option, value in choices.items():
        with problems.noted():
            chosen[option] = _choice(option, value)
    return ModelOptions(**chosen)


def _choice(option: str, value: object) -> str | int:
    allowed = {str(one): one for one in allowed_values(option)}
    if str(value) in allowed:
        return allowed[str(value)]
    raise VehicleError(
        [
            f"model.{option} = {value!r} is not a choice{did_you_mean(str(value), allowed)}; "
            f"allowed: {', '.join(allowed)}"
        ]
    )
