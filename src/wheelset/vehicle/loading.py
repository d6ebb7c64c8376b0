"""From a name or a file to a vehicle."""

from __future__ import annotations

from pathlib import Path

from wheelset.vehicle.documents import Document, check_fields, document_chain, statements_of
from wheelset.vehicle.problems import Problems
from wheelset.vehicle.statements import Overrides
from wheelset.vehicle.vehicle import Heading, Vehicle, assemble


def load_vehicle(name_or_path: str | Path, overrides: Overrides = ()) -> Vehicle:
    """The packaged vehicle of that name, or the one a TOML file describes.

    ``overrides``: see ``Vehicle.with_overrides``; they are applied last. Raises VehicleError with
    all problems of the file: unknown fields, units that do not fit, values out of range (with the
    range), what is missing (with a remedy), options that do not exist.
    """
    chain = document_chain(name_or_path)
    problems = Problems()
    for document in chain:
        check_fields(document, problems)
    vehicle = assemble(_heading(chain), statements_of(chain), problems)
    return vehicle.with_overrides(overrides) if overrides else vehicle


def _heading(chain: tuple[Document, ...]) -> Heading:
    """The last document's name; the last title there is; its own description on one line."""
    name = chain[-1].name
    texts = [{k: v for k, v in d.content.items() if isinstance(v, str)} for d in chain]
    titles = [text["title"] for text in texts if "title" in text]
    description = " ".join(texts[-1].get("description", "").split())
    return Heading(name, titles[-1] if titles else name, description)
