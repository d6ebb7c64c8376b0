"""Commands over the notebooks: ``book``, ``run``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from wheelset.cli.errors import clear_errors, error_console


def book(
    quick: Annotated[
        bool, typer.Option("--quick", help="Coarse preview in minutes, kept apart from the book.")
    ] = False,
    jobs: Annotated[
        int, typer.Option("--jobs", "-j", min=1, help="How many notebooks run at once.")
    ] = 2,
) -> None:
    """Execute the notebooks that are stale and build the HTML book.

    The last line printed is the path of its front page.
    """
    from wheelset.publishing.book import make_book
    from wheelset.publishing.console import ConsoleProgress
    from wheelset.publishing.errors import BookError
    from wheelset.publishing.layout import find_root

    with clear_errors(BookError), ConsoleProgress(error_console()) as progress:
        page = make_book(find_root(Path.cwd()), progress, quick=quick, processes=jobs)
    typer.echo(page)


def run(
    notebook: Annotated[str, typer.Argument(help="Its name or the start of it: 3_flange_models.")],
    parameters: Annotated[
        list[str] | None,
        typer.Option("--parameter", "-p", help="name=value; may be given several times."),
    ] = None,
    overrides: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="Change of the vehicle, name=value; may be given several times."
        ),
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="Folder of the run; default runs/NOTEBOOK-<hash>.")
    ] = None,
    html: Annotated[bool, typer.Option("--html/--no-html", help="Build a page of it.")] = True,
) -> None:
    """Run one notebook of the book with parameters of your own, in a folder of its own.

    Unknown names and values out of range are refused before anything runs. A value that names a
    file, such as vehicle=my.toml, is copied into the folder of the run.
    """
    from wheelset.publishing.book import run_notebook
    from wheelset.publishing.console import ConsoleProgress
    from wheelset.publishing.errors import BookError
    from wheelset.publishing.layout import find_root

    here = Path.cwd()
    with clear_errors(BookError), ConsoleProgress(error_console()) as progress:
        page = run_notebook(
            find_root(here),
            notebook,
            [*(parameters or []), *_changes(overrides or [])],
            progress,
            here=here,
            output=output and output.resolve(),
            html=html,
        )
    typer.echo(page)


def _changes(overrides: list[str]) -> list[str]:
    """Changes of the vehicle as the parameter of that name, which every study has."""
    return [f"changes={', '.join(overrides)}"] if overrides else []
