"""The study as files for AUTO's own command line: ``auto-07p full.auto`` does it by hand."""

from __future__ import annotations

from pathlib import Path

from benchmarks.auto07p.cases import Case
from benchmarks.auto07p.files import constants_text
from benchmarks.auto07p.fortran import PERIOD, problem
from benchmarks.auto07p.settings import Settings

#: AUTO reads names of up to this many characters.
LONGEST_NAME = 13

_SCRIPT = """\
# Written for AUTO-07p; run as `auto-07p full.auto`.
equilibrium = run(e="full", c="full")
cycles = run(equilibrium("HB1"), IPS=2, STOP=[], UZSTOP={{1: {window}}})
start = run(cycles("LP1"), ISW=2, ICP=[1, 2, {period}])
if start("MX"):
    raise RuntimeError("no null vector: what follows would not be a fold curve")
back = run(start("EP1"), UZSTOP={{2: {curve}}}, DS="-")
forth = run(start("EP1"), UZSTOP={{2: {curve}}})
save(equilibrium + cycles + merge(back + forth), "full")
"""


def write_script(case: Case, folder: Path, settings: Settings) -> None:
    """Write full.f90, c.full and full.auto: Hopf point, cycles, fold curve both ways."""
    states = case.system.state_names
    constants = settings.constants(states, case.free) | {
        "unames": {i: name[:LONGEST_NAME] for i, name in enumerate(states, 1)},
        "parnames": {k: name[:LONGEST_NAME] for k, name in enumerate(case.free, 1)},
        "IPS": 1,
        "ICP": [1, PERIOD],
        "PAR": {1: case.start[0]},
        "STOP": ["HB1"],
        "UZSTOP": {1: list(case.start)},
    }
    script = _SCRIPT.format(window=list(case.window), curve=list(case.curve), period=PERIOD)
    (folder / "full.f90").write_text(problem(case.system, case.free), "ascii")
    (folder / "c.full").write_text(constants_text(constants), "ascii")
    (folder / "full.auto").write_text(script, "ascii")
