"""A vehicle: quantities with their sources, and the structural options of the model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from pydantic import BaseModel, ConfigDict, Field, model_validator

from wheelset.vehicle.completeness import consistency_problems, missing_problems
from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.parameters import BY_NAME, PARAMETERS
from wheelset.vehicle.problems import Problems, VehicleError, did_you_mean
from wheelset.vehicle.quantity import Quantity, default_quantity
from wheelset.vehicle.statements import (
    Overrides,
    Statements,
    parse_overrides,
    read_options,
    read_quantities,
)


class Heading(NamedTuple):
    """What a vehicle is called: short name, title, and a paragraph about it."""

    name: str
    title: str
    description: str = ""


class Row(NamedTuple):
    """One line of a vehicle's table; ``value`` in SI."""

    name: str
    value: float
    unit: str
    status: str
    source: str
    reason: str
    meaning: str


class Vehicle(BaseModel):
    """A wheelset on its track: immutable, and complete for the options it carries.

    Quantities are in the order of the registry. A parameter that the options do not need (the
    coefficients of a flange law not in use, mu under linear creep) is absent if nobody states
    it; one with a default is always there.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    title: str
    description: str = ""
    options: ModelOptions
    quantities: tuple[Quantity, ...] = Field(repr=False)

    @model_validator(mode="after")
    def _complete(self) -> Vehicle:
        problems = Problems()
        problems.add(*missing_problems(self.values, self.options))
        problems.add(*consistency_problems(self.values))
        problems.raise_any(self.name)
        return self

    @property
    def values(self) -> dict[str, float]:
        """Parameter values by name, SI units; a new dict at each call."""
        return {quantity.name: quantity.value for quantity in self.quantities}

    def quantity(self, name: str) -> Quantity:
        """The quantity of one parameter; VehicleError if this vehicle holds none of that name."""
        for quantity in self.quantities:
            if quantity.name == name:
                return quantity
        hint = did_you_mean(name, self.values)
        raise VehicleError([f'holds no parameter "{name}"{hint}'], self.name)

    def with_overrides(self, overrides: Overrides) -> Vehicle:
        """A new vehicle with some values or options replaced.

        ``overrides``: texts ``name=value[ unit]``, or a mapping of names to numbers (SI) or texts.
        Raises VehicleError if one of them is unknown, unreadable or out of range.
        """
        known = {quantity.name: quantity for quantity in self.quantities}
        parameters, options = parse_overrides(overrides)
        statements = Statements(parameters, {**self.options.model_dump(), **options})
        heading = Heading(self.name, self.title, self.description)
        return assemble(heading, statements, Problems(), known)

    def table(self) -> list[Row]:
        """Rows for printing, in the order of the registry."""
        return [
            Row(q.name, q.value, q.unit, q.status, q.source, q.reason, BY_NAME[q.name].meaning)
            for q in self.quantities
        ]


def assemble(
    heading: Heading,
    statements: Statements,
    problems: Problems,
    known: Mapping[str, Quantity] | None = None,
) -> Vehicle:
    """The vehicle of the ``known`` quantities and of the statements, which win over them.

    Raises VehicleError with everything wrong: what ``problems`` holds already, what cannot be
    read, what is missing, what contradicts itself.
    """
    options = read_options(statements.options, problems)
    stated = {**(known or {}), **read_quantities(statements.parameters, problems)}
    problems.add(*missing_problems({*stated, *statements.parameters}, options))
    problems.add(*consistency_problems({name: q.value for name, q in stated.items()}))
    problems.raise_any(heading.name)
    return Vehicle(**heading._asdict(), options=options, quantities=_in_order(stated))


def _in_order(stated: Mapping[str, Quantity]) -> tuple[Quantity, ...]:
    """Quantities in the order of the registry, defaults filled in."""
    return tuple(
        stated[parameter.name] if parameter.name in stated else default_quantity(parameter)
        for parameter in PARAMETERS
        if parameter.name in stated or parameter.default is not None
    )
