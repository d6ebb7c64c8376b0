"""The paper's study in a process of its own: ``python -m benchmarks.engine.child`` prints how long
it took, and the greatest memory the process had, as JSON.
"""

from __future__ import annotations

import json
import resource
import sys

from benchmarks.auto07p import paper
from benchmarks.engine.study import HALF_20, ours, timed


def main() -> None:
    study, seconds = timed(lambda: ours(paper(), HALF_20))
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    figures = {"study_s": seconds, "peak_mb": kilobytes / 1024, "fold": study.fold[0]}
    sys.stdout.write(json.dumps(figures))


if __name__ == "__main__":
    main()
