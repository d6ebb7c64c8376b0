"""The console transcripts printed in the book are what the commands print today."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "book" / "your_own_vehicle.md"
BLOCKS = re.findall(r"```console\n(.*?)\n```", PAGE.read_text("utf-8"), re.S)
#: Commands that need no file of the reader's; as wide as the page shows them.
TRANSCRIPTS = [
    tuple(block.removeprefix("$ wheelset ").split("\n", 1))
    for block in BLOCKS
    if block.startswith("$ wheelset ") and "toml" not in block.split("\n")[0]
]
TERMINAL = {"COLUMNS": "74", "NO_COLOR": "1", "TERM": "dumb", "PYTHONUTF8": "1"}


@pytest.mark.parametrize(("command", "printed"), TRANSCRIPTS, ids=[c for c, _ in TRANSCRIPTS])
def test_the_book_shows_what_is_printed(command, printed):
    done = subprocess.run(
        [sys.executable, "-m", "wheelset", *shlex.split(command)],
        env={**os.environ, **TERMINAL},
        capture_output=True,
        text=True,
        encoding="utf-8",
    )
    lines = (done.stdout + done.stderr).strip("\n").split("\n")
    assert "\n".join(line.rstrip() for line in lines) == printed


def test_there_are_transcripts_of_every_command_over_the_physics():
    assert {c.split()[0] for c, _ in TRANSCRIPTS} == {
        "vehicles",
        "hopf",
        "simulate",
        "conicity",
    }
