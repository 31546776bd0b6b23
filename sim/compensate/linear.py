"""The inverse without memory: a straight line from position to command."""

import numpy as np

from rotemina.sim.arrays import FloatArray


def fit_line(position: FloatArray, command: FloatArray) -> FloatArray:
    """Return the consequent (1, 2) of the line from positions (n,) to commands (n,), shares."""
    rows = np.column_stack([np.ones_like(position), position])
    return np.asarray(np.linalg.lstsq(rows, command)[0][None], dtype=np.float64)
