"""Number regression of plotted arrays: what was computed before, stored, beside what is now."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pandas as pd

FOLDER = Path(__file__).parent / "arrays"


def regress(name: str, frame: pd.DataFrame, rtol: float = 1e-6, atol: float = 1e-9) -> None:
    """The frame equals the stored one, numbers to rtol and atol; texts and gaps exactly.

    With the environment variable WHEELSET_STORE_ARRAYS set the frame is stored instead.
    """
    path = FOLDER / f"{name}.csv"
    if os.environ.get("WHEELSET_STORE_ARRAYS"):
        FOLDER.mkdir(exist_ok=True)
        frame.to_csv(path, index=False, float_format="%.12g")
    stored = pd.read_csv(path)
    assert list(stored.columns) == list(frame.columns)
    assert len(stored) == len(frame)
    for column in frame:
        one, other = stored[column].to_numpy(), frame[column].to_numpy()
        if frame[column].dtype == float:
            np.testing.assert_allclose(
                other, one, rtol=rtol, atol=atol, err_msg=f"{name}, {column}"
            )
        else:
            assert one.tolist() == other.tolist(), f"{name}, {column}"
