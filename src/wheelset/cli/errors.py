"""Errors as a reader should see them: one message on stderr and an exit code, no traceback."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import typer
from rich.console import Console
from rich.markup import escape


def error_console() -> Console:
    """The console of messages and progress; results go to stdout."""
    return Console(stderr=True)


@contextmanager
def clear_errors(*kinds: type[Exception], exit_code: int = 2) -> Iterator[None]:
    """Print an error of these kinds without its traceback; leave with its ``exit_code``, if it
    has one, or with the given one: 1 for a computation that failed, 2 for wrong input.
    """
    try:
        yield
    except kinds as error:
        message = f"[bold red]error:[/] {escape(str(error))}"
        error_console().print(message, highlight=False, soft_wrap=True, emoji=False)
        raise typer.Exit(getattr(error, "exit_code", exit_code)) from error
