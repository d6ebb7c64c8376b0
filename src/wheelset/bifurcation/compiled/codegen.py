"""Compiled programs: small numba modules, kept on disk.

A module holds the listing of one program and the function that runs it. Its name is the hash of
what it is made from, so that numba's cache of the machine code beside it is never out of date.
Modules are never committed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import os
import sys
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from types import ModuleType

import numba
import platformdirs

from wheelset.bifurcation.compiled import elementary, lanes, lowering
from wheelset.bifurcation.compiled.program import Argument, Program

logger = logging.getLogger(__name__)

_MODULE = '''"""Generated from a field; do not edit."""

from numba import njit

from wheelset.bifurcation.compiled.lowering import runner
from wheelset.bifurcation.compiled.program import Argument

run = runner(
    ({arguments},),
    """
{listing}
""",
)


@njit("int64({types})", cache=True, no_cfunc_wrapper=True)
def evaluate({names}):
    return run(({names},))
'''


def source(program: Program) -> str:
    """The module of a program: ``evaluate`` of its arrays, C-contiguous and of doubles.

    It returns 0, 1 + the number of a point that was refused, or -1 where shapes do not fit.
    """
    return _MODULE.format(
        arguments=",\n     ".join(map(repr, program.arguments)),
        listing=program.listing(),
        types=", ".join(map(_type, program.arguments)),
        names=", ".join(a.name for a in program.arguments),
    )


def _type(a: Argument) -> str:
    return f"Array(float64, {len(a.shape) + a.each}, 'C', readonly={not a.written})"


def cache_folder() -> Path:
    """Where generated code lives: ``$WHEELSET_CACHE_DIR`` or the user's cache folder."""
    chosen = os.environ.get("WHEELSET_CACHE_DIR")
    return Path(chosen) if chosen else Path(platformdirs.user_cache_dir("wheelset"))


def compiled(program: Program) -> Callable[..., int]:
    """The machine code of a program, from the cache on disk where it is there."""
    text = source(program)
    digest = hashlib.sha256(f"{numba.__version__}\n{_compiler()}\n{text}".encode()).hexdigest()
    path = cache_folder() / f"kernel_{digest[:24]}.py"
    if not path.exists():
        logger.info("writing kernel %s", path)
        _write_atomically(path, text)
    return _load(path).evaluate


@lru_cache(maxsize=1)
def _compiler() -> str:
    """Hash of what turns listings into machine code."""
    digest = hashlib.sha256()
    for module in (lanes, elementary, lowering):
        digest.update(Path(str(module.__file__)).read_bytes())
    return digest.hexdigest()


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
