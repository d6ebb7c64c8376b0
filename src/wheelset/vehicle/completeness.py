"""What a vehicle must hold before anything can be computed with it."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from wheelset.vehicle.options import ModelOptions
from wheelset.vehicle.parameters import PARAMETERS, Parameter

REMEDY = 'give a value, or take the inferred ones of a packaged vehicle with extends = "guo2021"'


def required(parameter: Parameter, options: ModelOptions) -> bool:
    """Whether the chosen options cannot do without a stated value of ``parameter``."""
    if parameter.needed_by is not None:
        option, value = parameter.needed_by
        return bool(getattr(options, option) == value)
    return parameter.default is None


def missing_problems(names: Collection[str], options: ModelOptions) -> list[str]:
    """A sentence for each kind of required parameter that is not among ``names``."""
    missing = [q for q in PARAMETERS if required(q, options) and q.name not in names]
    return [*_plain(missing), *_hidden(missing), *_optional(missing)]


def consistency_problems(values: Mapping[str, float]) -> list[str]:
    """Sentences on values (SI) that exclude each other: both wheels must touch at y = 0."""
    problems = []
    if {"e0", "f0"} <= values.keys():
        curvature, difference = values["e0"] + values["f0"], values.get("dh0", 0.0)
        if curvature <= abs(difference):
            problems.append(
                f"geometry.e0 + geometry.f0 = {curvature:g} 1/m (asymmetry.dh0 = {difference:g} "
                "1/m): the curvature sum of both wheels at y = 0 must be positive; "
                "allowed: e0 + f0 > |dh0|"
            )
    if "r0" in values and values["r0"] <= abs(values.get("da0", 0.0)):
        problems.append("asymmetry.da0: larger than the wheel radius; allowed: |da0| < r0")
    return problems


def _plain(missing: list[Parameter]) -> Iterator[str]:
    fields = _listed(q for q in missing if not q.hidden and q.needed_by is None)
    if fields:
        yield f"missing: {fields}; {REMEDY}"


def _hidden(missing: list[Parameter]) -> Iterator[str]:
    fields = _listed(q for q in missing if q.hidden and q.needed_by is None)
    if fields:
        yield (
            f"missing: {fields}. The paper prints none of its values of p0, E, nu, c0 and "
            f"e0 + f0; {REMEDY}"
        )


def _optional(missing: list[Parameter]) -> Iterator[str]:
    for choice in dict.fromkeys(q.needed_by for q in missing if q.needed_by is not None):
        option, value = choice
        fields = _listed(q for q in missing if q.needed_by == choice)
        yield f'missing: {fields}, which model.{option} = "{value}" needs; {REMEDY}'


def _listed(parameters: Iterator[Parameter]) -> str:
    return ", ".join(f"{q.path} ({q.meaning}, {q.unit})" for q in parameters)
