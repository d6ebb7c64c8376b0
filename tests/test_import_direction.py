"""The doors of the house: who may import whom, read from the source itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import wheelset

PACKAGE = Path(wheelset.__file__).parent

# room: the rooms it may import. The house grows by adding a line here, not by opening a door.
DOORS: dict[str, set[str]] = {
    "vehicle": {"vehicle", "data"},
    "data": set(),
    "profiles": {"profiles", "data"},
    "wear": {"wear", "profiles"},
    "bifurcation": {"bifurcation"},
    "hunting": {"vehicle", "bifurcation"},
    "studies": {"studies", "hunting", "vehicle", "bifurcation", "profiles", "wear", "data"},
    "published": {"published", "data"},
    "plotting": {"plotting", "bifurcation", "published"},
    "publishing": {"publishing"},
    "cli": {
        "cli",
        "publishing",
        "published",
        "plotting",
        "studies",
        "hunting",
        "vehicle",
        "profiles",
        "wear",
        "bifurcation",
    },
    "__main__": {"cli"},
    "__init__": set(),
}

# A third party that belongs to certain rooms only: physics never plots, the library never prints.
FOREIGN: dict[str, set[str]] = {
    "matplotlib": {"plotting"},
    "typer": {"cli"},
    "rich": {"cli", "publishing"},
    "papermill": {"publishing"},
    "doit": {"publishing"},
    "nbformat": {"publishing"},
}


def room_of(path: Path, package: Path) -> str:
    return path.relative_to(package).parts[0].removesuffix(".py")


def imported(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the line and dotted name of every import, wherever in the file it stands."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = "." * node.level + (node.module or "")
            yield from ((node.lineno, f"{base}.{alias.name}") for alias in node.names)


def complaint(room: str, name: str) -> str | None:
    if name.startswith("."):
        return "relative import"
    top, *rest = name.split(".")
    if top == "wheelset":
        target = rest[0] if rest else ""
        known = target in DOORS and target not in {"__main__", "__init__"}
        return f"{room} may not import {target}" if known and target not in DOORS[room] else None
    for foreign, rooms in FOREIGN.items():
        if f"{name}.".startswith(f"{foreign}.") and room not in rooms:
            return f"{foreign} belongs to {', '.join(sorted(rooms))}"
    return None


def illegal_imports(package: Path) -> list[str]:
    found = []
    for path in sorted(package.rglob("*.py")):
        room = room_of(path, package)
        if room not in DOORS:
            found.append(f"{path.relative_to(package)}: the room `{room}` has no line in DOORS")
            continue
        for line, name in imported(path):
            if reason := complaint(room, name):
                found.append(f"{path.relative_to(package)}:{line}: {name}: {reason}")
    return found


def test_every_import_goes_along_an_arrow():
    assert illegal_imports(PACKAGE) == []


def test_the_two_wings_are_apart():
    assert "bifurcation" not in DOORS["vehicle"]
    assert "vehicle" not in DOORS["bifurcation"]


@pytest.mark.parametrize(
    ("file", "source"),
    [
        ("vehicle/model.py", "from wheelset.bifurcation import hopf"),
        ("bifurcation/hopf.py", "def f():\n    import wheelset.vehicle.model"),
        ("bifurcation/hopf.py", "from wheelset import vehicle"),
        ("hunting.py", "from wheelset.studies.section import table"),
        ("plotting/curves.py", "from wheelset.vehicle import load_vehicle"),
        ("publishing/book.py", "from wheelset.studies import flange_models"),
        ("vehicle/model.py", "from .. import bifurcation"),
        ("studies/section.py", "import matplotlib.pyplot as plt"),
        ("bifurcation/report.py", "from rich.console import Console"),
        ("attic/old.py", "x = 1"),
    ],
)
def test_a_door_that_is_shut_is_noticed(tmp_path, file, source):
    path = tmp_path / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(source, "utf-8")
    assert len(illegal_imports(tmp_path)) == 1


def test_an_open_door_is_not_noticed(tmp_path):
    path = tmp_path / "hunting.py"
    path.write_text(
        "import numpy\nfrom wheelset import __version__\nimport wheelset.vehicle", "utf-8"
    )
    assert illegal_imports(tmp_path) == []
