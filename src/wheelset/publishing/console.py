"""Progress for a reader's eyes: moving bars on a terminal, plain lines in a log."""

from __future__ import annotations

import threading
import time
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, TaskID, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bars

_SECONDS_BETWEEN_LINES = 10.0


class ConsoleProgress:
    """Tells a rich console what the publisher does; safe to call from several threads."""

    def __init__(self, console: Console) -> None:
        self.console = console
        self.bars = Bars(
            TextColumn("  {task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
        self._bars_by_name: dict[str, TaskID] = {}
        self._told: dict[str, float] = {}
        self._lock = threading.Lock()

    def __enter__(self) -> Self:
        """Show the bars."""
        self.bars.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Take the bars away."""
        self.bars.stop()

    def started(self, name: str, reason: str) -> None:
        """Say that work on `name` begins, and why."""
        with self._lock:
            self._bars_by_name[name] = self.bars.add_task(name, total=None)
            self._told[name] = time.monotonic()
        self._say(f"[bold]->[/] {escape(name)}  [dim]{escape(reason)}[/]")

    def advanced(self, name: str, done: int, total: int) -> None:
        """Move the bar of `name`; in a log, add a line now and then."""
        if name in self._bars_by_name:
            self.bars.update(self._bars_by_name[name], completed=done, total=total)
        now = time.monotonic()
        if (
            not self.console.is_terminal
            and now - self._told.get(name, now) > _SECONDS_BETWEEN_LINES
        ):
            self._told[name] = now
            self._say(f"   {escape(name)}  {done}/{total}")

    def finished(self, name: str, seconds: float) -> None:
        """Say that `name` is done."""
        self._hide(name)
        self._say(f"[green]ok[/] {escape(name)}  {seconds:.1f} s")

    def unchanged(self, name: str) -> None:
        """Say that `name` needs no work."""
        self._say(f"[dim]== {escape(name)}  unchanged[/]")

    def failed(self, name: str, message: str) -> None:
        """Say that `name` failed; the reasons come at the end, together."""
        self._hide(name)
        self._say(f"[red]no[/] {escape(name)}  [dim]{escape(message.splitlines()[0])}[/]")

    def _hide(self, name: str) -> None:
        with self._lock:
            bar = self._bars_by_name.pop(name, None)
        if bar is not None:
            self.bars.remove_task(bar)

    def _say(self, text: str) -> None:
        self.console.print(text, highlight=False, emoji=False, soft_wrap=True)
