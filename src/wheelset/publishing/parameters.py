"""A reader's parameters, checked before anything runs.

papermill accepts a misspelt parameter and reports success; here every notebook with parameters
names a study, and the study's pydantic model `Parameters` is asked first.
"""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from wheelset.publishing.errors import InputError, did_you_mean
from wheelset.publishing.notebooks import Source

_SIGNS = {"gt": ">", "ge": ">=", "lt": "<", "le": "<="}


def parameters_model(source: Source) -> type[BaseModel] | None:
    """Return the model `Parameters` of the notebook's study, or None where it has no study.

    Raises:
        InputError: the study does not exist, or has no `Parameters`.
    """
    if source.study is None:
        return None
    name = f"wheelset.studies.{source.study}"
    try:
        model: type[BaseModel] = importlib.import_module(name).Parameters
    except (ModuleNotFoundError, AttributeError) as error:
        raise InputError(f"{source.stem} names the study {name}: {error}") from error
    return model


def parse_assignments(texts: Iterable[str]) -> dict[str, Any]:
    """Return the values of `name=value` texts: JSON where it is JSON, otherwise the text itself.

    Raises:
        InputError: a text without `=`.
    """
    values: dict[str, Any] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals:
            raise InputError(f"`{text}` is no assignment: write -p name=value.")
        values[name.strip()] = _literal(value.strip())
    return values


def _literal(text: str) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return text


def check_parameters(source: Source, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return `values` as the notebook's study understands them: its types, only those given.

    Raises:
        InputError: an unknown name, a wrong type or a value out of range.
    """
    model = parameters_model(source)
    if model is None:
        if values:
            raise InputError(f"{source.stem} takes no parameters; given: {', '.join(values)}.")
        return {}
    try:
        checked = model.model_validate(dict(values))
    except ValidationError as error:
        raise InputError(_complaint(source, model, error)) from error
    return checked.model_dump(mode="json", exclude_unset=True)


def all_parameters(source: Source, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return every parameter the notebook runs with: the defaults and the checked `values`.

    They are not checked again: a file among them is named as the run will find it, not as here.
    """
    model = parameters_model(source)
    return {} if model is None else model.model_construct(**values).model_dump(mode="json")


def _complaint(source: Source, model: type[BaseModel], error: ValidationError) -> str:
    lines = [_one_complaint(model, detail) for detail in error.errors()]
    allowed = [f"  {line}" for line in describe(model)]
    return "\n".join([f"{source.stem}:", *lines, "It takes:", *allowed])


def _one_complaint(model: type[BaseModel], detail: ErrorDetails) -> str:
    name = ".".join(str(part) for part in detail["loc"]) or "parameters"
    if detail["type"] == "extra_forbidden":
        return f"  unknown parameter `{name}`{did_you_mean(name, model.model_fields)}"
    return f"  `{name}` = {detail['input']!r}: {detail['msg']}"


def describe(model: type[BaseModel]) -> list[str]:
    """Return one line a parameter: name, default, bounds, and what it is."""
    return [
        f"{name} = {field.get_default()!r}"
        + "".join(_bound(mark) for mark in field.metadata)
        + (f"  ({field.description})" if field.description else "")
        for name, field in model.model_fields.items()
    ]


def _bound(mark: object) -> str:
    """Return `, > 0` for a mark such as `Gt(gt=0)`, and nothing for a mark that is no bound."""
    found = [(sign, getattr(mark, name, None)) for name, sign in _SIGNS.items()]
    return "".join(f", {sign} {limit:g}" for sign, limit in found if limit is not None)
