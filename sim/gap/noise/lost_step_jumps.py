"""Lost steps: a position that is suddenly off, for good, by a multiple of four full steps."""

import numpy as np

from rotemina.sim.arrays import FloatArray

_WINDOW_S = 0.1  # on either side of a jump, over which the position is taken
_ABRUPT_S = 0.03  # within which a jump is over
_APART_S = 0.2
_MOST = 12  # jumps in a record
_NEAR = 0.2  # of a quantum, within which a jump is a multiple of it
_CLOSES = 0.75  # of the gap's power, that jumps must close


def jumps(time_s: FloatArray, gap: FloatArray, quantum: float) -> list[tuple[int, float]]:
    """Return rows and sizes of the jumps in a gap (n,); ``quantum`` in its unit.

    None, unless they close most of it.
    """
    period_s = float(np.median(np.diff(time_s)))
    window = max(int(_WINDOW_S / period_s), 2)
    left = gap.copy()
    found: list[tuple[int, float]] = []
    while len(found) < _MOST:
        row, change = _largest(left, window)
        size = quantum * np.rint(change / quantum)
        if size == 0.0 or abs(change - size) > _NEAR * quantum:
            break
        if not _is_abrupt(left, row, size, max(int(_ABRUPT_S / period_s), 1)):
            break
        if any(abs(row - other) * period_s < _APART_S for other, _ in found):
            break
        left[row:] -= size
        found.append((row, float(size)))
    return found if np.var(left) < (1.0 - _CLOSES) * np.var(gap) else []


def _is_abrupt(gap: FloatArray, row: int, size: float, rows: int) -> bool:
    """Tell whether most of a jump happens at once, and no slow way leads there."""
    around = gap[max(row - 2 * rows, 0) : row + 2 * rows]
    if len(around) <= rows:
        return False
    return float(np.abs(around[rows:] - around[:-rows]).max()) > 0.7 * abs(size)


def _largest(gap: FloatArray, window: int) -> tuple[int, float]:
    """Return where the means of two neighbouring windows differ most, and by how much."""
    if len(gap) <= 2 * window:
        return 0, 0.0
    total = np.concatenate([[0.0], np.cumsum(gap)])
    mean = (total[window:] - total[:-window]) / window
    change = mean[window:] - mean[:-window]
    best = int(np.argmax(np.abs(change)))
    row = best + window
    # A jump passes through the mechanics: what counts is where it has come to rest.
    before = float(np.median(gap[best : row - window // 4]))
    after = float(np.median(gap[row + window // 4 : row + window]))
    return row, after - before
