"""What can go wrong on the way to the book, each with the exit code of the command line."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import ClassVar


class BookError(Exception):
    """The book, or one of its notebooks, could not be made."""

    exit_code: ClassVar[int] = 1


class NotebookError(BookError):
    """A notebook stopped, or finished without what it promised; nothing of it is published."""


class StaleError(BookError):
    """A page would show a copy that is missing, or older than what it was computed from."""


class InputError(BookError):
    """What the reader asked for does not exist or is out of range."""

    exit_code: ClassVar[int] = 2


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean ...?` for the nearest known word, or nothing."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.6)
    return f"; did you mean `{near[0]}`?" if near else ""
