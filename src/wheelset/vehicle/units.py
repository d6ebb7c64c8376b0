"""Numbers with units: reading "1.2 MN/m" and converting it to the registry's SI unit.

pint knows the units; it is imported only when a unit differs from the SI unit of its
parameter, because its registry takes longer to build than a vehicle takes to load.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from wheelset.vehicle.parameters import Parameter
from wheelset.vehicle.problems import VehicleError

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
_FACTOR = re.compile(r"\s*([*/·]?)\s*([A-Za-zµμ°%]+|1)(?:(?:\^|\*\*)?(-?[1-9]))?")
_SUPERSCRIPTS = str.maketrans({"²": "2", "³": "3", "⁴": "4", "⁵": "5"})

_EXAMPLES = {
    "kg": "t",
    "m": "mm",
    "N": "kN",
    "Pa": "GPa",
    "rad": "deg",
    "N/m": "MN/m",
    "N s/m": "kN s/m",
    "1/m": "1/mm",
    "1": "%",
}


def split_quantity(text: str) -> tuple[float, str]:
    """Number and unit of a text such as ``1.2 MN/m``; the unit may be empty.

    Raises VehicleError if the text does not begin with a number.
    """
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise VehicleError([f'"{text}" is not a number; write for example 0.3 or "1.2 MN/m"'])
    return float(match[1]), match[2]


def to_si(value: float, unit: str, parameter: Parameter) -> float:
    """``value`` in the SI unit of ``parameter``.

    Raises VehicleError, naming field, unit and expected unit, if ``unit`` cannot be read or
    measures something else.
    """
    unit = unit.strip()
    if unit in ("", parameter.unit):
        return value
    try:
        return float(_units().Quantity(value, _pint_unit(unit)).m_as(_pint_unit(parameter.unit)))
    except _unit_errors() as error:
        raise VehicleError([_wrong_unit(unit, parameter)]) from error


def _wrong_unit(unit: str, parameter: Parameter) -> str:
    example = _EXAMPLES.get(parameter.unit)
    also = f' or a unit convertible to it, such as "{example}"' if example else ""
    return (
        f'{parameter.path}: unit "{unit}" does not fit the {parameter.meaning}; '
        f'expected "{parameter.unit}"{also}'
    )


def _pint_unit(unit: str) -> Any:
    """The pint unit of a product such as ``kg m2`` or ``N s/m``; ValueError if unreadable."""
    text, position, factors = unit.translate(_SUPERSCRIPTS), 0, []
    while position < len(text):
        match = _FACTOR.match(text, position)
        if match is None:
            raise ValueError(f'unit "{unit}" cannot be read')
        sign = -1 if match[1] == "/" else 1
        factors.append((match[2], sign * int(match[3] or 1)))
        position = match.end()
    return _product(factors)


def _product(factors: list[tuple[str, int]]) -> Any:
    product = _units().Unit("dimensionless")
    for name, power in factors:
        product *= _units().Unit("dimensionless" if name == "1" else name) ** power
    return product


@cache
def _units() -> Any:
    from pint import UnitRegistry

    return UnitRegistry()


def _unit_errors() -> tuple[type[Exception], ...]:
    from pint.errors import PintError

    return (PintError, ValueError, AttributeError, TypeError, OverflowError)
