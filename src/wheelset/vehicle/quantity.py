"""A number with its unit and where it comes from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from numbers import Real
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from wheelset.vehicle.parameters import BY_NAME, Parameter
from wheelset.vehicle.problems import VehicleError, did_you_mean
from wheelset.vehicle.units import split_quantity, to_si

Status = Literal["printed", "inferred", "assumed", "user", "default"]

ENTRY_KEYS = ("value", "unit", "source", "inferred", "assumed")


class Quantity(BaseModel):
    """The value of one parameter, in the SI unit of the registry.

    status: ``printed`` in the source, ``inferred`` from what the source prints, ``assumed``,
    given by the ``user``, or the ``default`` of the model. A reason is required unless the
    number is printed or the user's.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    value: float
    unit: str
    source: str
    status: Status
    reason: str = ""

    @model_validator(mode="after")
    def _in_range_and_reasoned(self) -> Quantity:
        parameter = BY_NAME[self.name]
        check_range(parameter, self.value)
        if self.status in ("inferred", "assumed") and not self.reason.strip():
            raise VehicleError([f"{parameter.path}: {self.status} without a reason"])
        return self


def check_range(parameter: Parameter, value: float) -> None:
    """Raise VehicleError unless ``value`` [SI] is finite and within the parameter's bounds."""
    if parameter.bounds.contain(value):
        return
    kind = "is out of range" if math.isfinite(value) else "is not a finite number"
    unit = "" if parameter.unit == "1" else f" {parameter.unit}"
    raise VehicleError(
        [
            f"{parameter.path} = {value:g}{unit} {kind}; "
            f"allowed: {parameter.bounds.describe(parameter.name)}"
        ]
    )


def default_quantity(parameter: Parameter) -> Quantity:
    """The value that a parameter has when a vehicle leaves it out."""
    if parameter.default is None:
        raise VehicleError([f"{parameter.path} has no default"])
    return Quantity(
        name=parameter.name,
        value=parameter.default,
        unit=parameter.unit,
        source="default of the model",
        status="default",
        reason="left out: no such effect",
    )


def read_quantity(parameter: Parameter, entry: object, origin: str) -> Quantity:
    """The quantity that a vehicle file or an override states for ``parameter``.

    ``entry`` is a number in SI, a text with unit such as ``1.2 MN/m``, or a table with the keys
    of ``ENTRY_KEYS``. ``origin`` is the source where the entry names none. An entry with a source
    and neither ``inferred`` nor ``assumed`` is printed there. Raises VehicleError.
    """
    fields: dict[str, Any] = dict(entry) if isinstance(entry, Mapping) else {"value": entry}
    _check_keys(parameter, fields)
    value = _si_value(parameter, fields["value"], fields.get("unit", ""))
    status, reason = _status(fields)
    check_range(parameter, value)
    try:
        return Quantity(
            name=parameter.name,
            value=value,
            unit=parameter.unit,
            source=fields.get("source", origin),
            status=status,
            reason=reason,
        )
    except ValidationError as error:
        raise VehicleError([f"{parameter.path}: {_sentence(error)}"]) from error


def _check_keys(parameter: Parameter, fields: Mapping[str, Any]) -> None:
    problems = [
        f'{parameter.path}: unknown key "{key}"{did_you_mean(key, ENTRY_KEYS)}; '
        f"allowed: {', '.join(ENTRY_KEYS)}"
        for key in fields
        if key not in ENTRY_KEYS
    ]
    problems += [
        f"{parameter.path}: {key} must be a text in quotes, not {fields[key]!r}"
        for key in ENTRY_KEYS[1:]
        if not isinstance(fields.get(key, ""), str)
    ]
    if "value" not in fields:
        problems.append(f"{parameter.path}: the value is missing")
    if "inferred" in fields and "assumed" in fields:
        problems.append(f"{parameter.path}: inferred and assumed exclude each other")
    if problems:
        raise VehicleError(problems)


def _si_value(parameter: Parameter, value: object, unit: str) -> float:
    try:
        number, inner_unit = _number(value)
    except (VehicleError, OverflowError) as error:
        said = error.problems[0] if isinstance(error, VehicleError) else "the number is too large"
        raise VehicleError([f"{parameter.path}: {said}"]) from error
    if unit and inner_unit:
        raise VehicleError([f'{parameter.path}: two units, "{inner_unit}" and "{unit}"'])
    return to_si(number, unit or inner_unit, parameter)


def _number(value: object) -> tuple[float, str]:
    if isinstance(value, str):
        return split_quantity(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise VehicleError([f'{value!r} is not a number; write for example 0.3 or "1.2 MN/m"'])
    return float(value), ""


def _status(fields: Mapping[str, Any]) -> tuple[Status, str]:
    if "inferred" in fields:
        return "inferred", fields["inferred"]
    if "assumed" in fields:
        return "assumed", fields["assumed"]
    return ("printed" if "source" in fields else "user"), ""


def _sentence(error: ValidationError) -> str:
    return str(error.errors()[0]["msg"]).removeprefix("Value error, ")
