"""Speed and acceleration of sampled commands, as a device plays them.

A device holds each row until the next one is due. If two rows are farther apart than its set-point
period, it stands still in between and then jumps within one period. So the duration of a motion
from row to row is ``min(interval, period)``, and a command with held rows is a staircase rather
than a polyline.

Commands are rounded, to the digits of a file or to the microsteps of a device. A second difference
divides this rounding by the square of the interval: at 1 kHz, 0.1 µm looks like 0.4 m/s². Therefore
the acceleration is computed over a window in which rounding by one resolution contributes at most
``MAX_ROUNDING_RATIO`` of the bound.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.trajectory.schedule import TICK_TOLERANCE_RATIO

MAX_ROUNDING_RATIO = 0.05
# Set-point period that the checks assume for a device that does not state its own.
DEFAULT_SETPOINT_PERIOD_S = 1e-3
# Points that are processed at once if every row is held for long. This bounds the memory.
_BLOCK_POINTS = 500_000
# Longest window, in intervals, unless the command has more rows. A bound that needs a longer window
# hardly lets an axis start, and a window longer than the command shows nothing more.
_MAX_WINDOW_INTERVALS = 100_000


@dataclass(frozen=True, slots=True, eq=False)
class AccelerationSamples:
    """Accelerations ``value`` (m,) at times ``time_s`` (m,), each over a window ``window_s`` (m,).

    The window is the shorter one of the two intervals whose speeds are compared, s.
    """

    time_s: FloatArray
    value: FloatArray
    window_s: FloatArray


class _CommandPath(NamedTuple):
    """Commands over time, (n,) each, joined by straight lines."""

    time_s: FloatArray
    command: FloatArray


def find_held_intervals(time_s: FloatArray, period_s: float) -> BoolArray:
    """Return whether a device holds the row and then jumps, for each interval (n - 1,)."""
    return np.asarray(np.diff(time_s) > period_s * (1.0 + TICK_TOLERANCE_RATIO))


def compute_jump_times(time_s: FloatArray, period_s: float) -> FloatArray:
    """Return the times (n - 1,) that a device takes to move from each row to the next, s."""
    return np.minimum(np.diff(time_s), period_s)


def compute_jump_speeds(time_s: FloatArray, command: FloatArray, period_s: float) -> FloatArray:
    """Return the speeds (n - 1,) at which a device moves from row to row, m/s or rad/s."""
    return np.asarray(np.diff(command) / compute_jump_times(time_s, period_s))


def count_window_intervals(interval_s: float, resolution: float, bound: float) -> int:
    """Return the number of intervals over which a speed is computed, so that rounding is small.

    The window is ``w = sqrt(4·resolution/(0.05·bound))``, converted to intervals, at least 1.
    """
    return max(1, ceil(sqrt(4.0 * resolution / (MAX_ROUNDING_RATIO * bound)) / interval_s - 1e-9))


def compute_accelerations(
    time_s: FloatArray,
    command: FloatArray,
    resolution: float,
    bound: float | None,
    period_s: float,
) -> Iterator[AccelerationSamples]:
    """Yield the acceleration of a command (n,), n > 1, in consecutive pieces that overlap.

    The command is held before its first and after its last row. ``resolution`` (m or rad) is the
    step to which commands are rounded, ``bound`` is the acceleration limit. Without a limit, the
    speeds are computed from set-point to set-point.
    """
    interval_s = min(float(np.median(np.diff(time_s))), period_s)
    row_count = len(time_s)
    window_rows = 1
    if bound is not None:
        window_rows = min(
            count_window_intervals(interval_s, resolution, bound),
            max(row_count, _MAX_WINDOW_INTERVALS),
        )
    block_rows = max(2 * window_rows, _BLOCK_POINTS // (4 * window_rows))
    for begin in range(0, row_count - 1, block_rows):
        first, last = (
            max(begin - 2 * window_rows, 0),
            min(begin + block_rows + 2 * window_rows, row_count),
        )
        path = _insert_holds(time_s[first:last], command[first:last], period_s, 2 * window_rows)
        holds_before = 2 * window_rows if first == 0 else 0
        holds_after = 2 * window_rows if last == row_count else 0
        yield compute_second_differences(
            *_pad_with_rest(path, holds_before, holds_after, interval_s), window_rows
        )


def _insert_holds(
    time_s: FloatArray, command: FloatArray, period_s: float, kept_per_side: int
) -> _CommandPath:
    """Add points where a device stands still between rows, about a period apart.

    If an interval exceeds a period by less than half a period, the row is only delayed and nothing
    is added. Of a long hold, the first and the last ``kept_per_side`` points are enough, because
    windows over the other points contain no motion.
    """
    interval = np.diff(time_s)
    hold_count = np.maximum(np.rint(interval / period_s) - 1.0, 0.0)
    if not hold_count.any():
        return _CommandPath(time_s, command)
    spacing = np.append((interval - period_s) / np.maximum(hold_count, 1.0), 0.0)
    hold_count = np.append(hold_count, 0.0)
    kept_count = np.minimum(hold_count, 2 * kept_per_side).astype(np.int64)
    row = np.repeat(np.arange(len(time_s)), kept_count + 1)
    hold_number = np.arange(len(row)) - np.repeat(
        np.cumsum(kept_count + 1) - (kept_count + 1), kept_count + 1
    )
    is_in_second_half = hold_number > kept_per_side
    hold_number = np.where(
        is_in_second_half, hold_count[row] - kept_count[row] + hold_number, hold_number
    )
    return _CommandPath(time_s[row] + hold_number * spacing[row], command[row])


def _pad_with_rest(path: _CommandPath, before: int, after: int, interval_s: float) -> _CommandPath:
    time_s, command = path
    return _CommandPath(
        np.concatenate(
            [
                time_s[0] - np.arange(before, 0, -1) * interval_s,
                time_s,
                time_s[-1] + np.arange(1, after + 1) * interval_s,
            ]
        ),
        np.pad(command, (before, after), mode="edge"),
    )


def compute_second_differences(
    time_s: FloatArray, command: FloatArray, n: int
) -> AccelerationSamples:
    """Return the accelerations of positions (m,) from speeds that are computed over ``n`` rows."""
    window_s = time_s[n:] - time_s[:-n]
    speed = (command[n:] - command[:-n]) / window_s
    value = (speed[n:] - speed[:-n]) / (0.5 * (window_s[n:] + window_s[:-n]))
    return AccelerationSamples(time_s[n:-n], value, np.minimum(window_s[n:], window_s[:-n]))
