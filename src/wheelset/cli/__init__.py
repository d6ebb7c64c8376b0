"""The command line: every command is a thin door; what is heavy is imported behind it.

Exit codes: 0 done, 1 the computation or the book failed, 2 the input was wrong.
"""

from __future__ import annotations

from typing import Annotated

import typer

from wheelset.cli.hunting import hopf, simulate, vehicles
from wheelset.cli.profiles import conicity, profiles
from wheelset.cli.publishing import book, run
from wheelset.cli.report import report
from wheelset.cli.wear import wear

app = typer.Typer(
    name="wheelset",
    help="Hunting of a railway wheelset: its bifurcations, and the book that computes itself.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
for command in (vehicles, hopf, simulate, profiles, conicity, report, wear, run, book):
    app.command()(command)


def _print_version(wanted: bool) -> None:
    if wanted:
        from wheelset import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print it.")
    ] = False,
) -> None:
    """Hold the options that stand before any command."""
