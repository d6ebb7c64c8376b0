"""Run every benchmark, or those named: ``python -m benchmarks engine``."""

import sys

from benchmarks import engine, front_door, profiles

BENCHMARKS = {
    "front_door": front_door.main,
    "profiles": profiles.main,
    "engine": engine.main,
}

for name in sys.argv[1:] or BENCHMARKS:
    BENCHMARKS[name]()
