"""Run every benchmark: ``python -m benchmarks``."""

from benchmarks import front_door

front_door.main()
