"""Who is told how far the work has come."""

from __future__ import annotations

from typing import Protocol


class Progress(Protocol):
    """A listener; every method takes the name of a notebook or of the site first."""

    def started(self, name: str, reason: str) -> None:
        """Work on `name` begins, for this reason."""

    def advanced(self, name: str, done: int, total: int) -> None:
        """`done` of `total` cells (or per cent of the pages) are finished."""

    def finished(self, name: str, seconds: float) -> None:
        """Work on `name` ended well after this many seconds."""

    def unchanged(self, name: str) -> None:
        """`name` is as it should be; nothing to do."""

    def failed(self, name: str, message: str) -> None:
        """Work on `name` ended badly, or could not begin."""
