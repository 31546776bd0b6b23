"""Speed and acceleration of sampled commands, as a device plays them.

A device holds each row until the next one is due: between rows farther apart than its set-point
period it stands, and then jumps within one period. So an interval of a trajectory counts as
``min(interval, period)``, and where rows are held the command is a staircase, no polyline.

Commands come rounded, by a file's digits or to a device's microsteps. A second difference divides
that rounding by the square of the interval: at 1 kHz, 0.1 µm poses as 0.4 m/s². Acceleration is
therefore taken over a window in which one resolution of rounding weighs at most
``ROUNDING_SHARE`` of the bound.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil, sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.trajectory.schedule import ON_TIME

ROUNDING_SHARE = 0.05
# What the limits take a device's set-point period to be where it does not tell its own.
SETPOINT_PERIOD_S = 1e-3
_BLOCK = 500_000  # points judged at once, where every row is held for long: bounds memory
# Intervals: a bound that asks for a longer window lets an axis hardly start, and it sees no more
# than a window over the whole command.
_MAX_WINDOW = 100_000


@dataclass(frozen=True, slots=True, eq=False)
class Accelerations:
    """Accelerations ``value`` (m,) about the times ``time_s`` (m,), each over a window (m,) s.

    ``window_s`` is the length of the shorter of the two intervals whose speeds are compared.
    """

    time_s: FloatArray
    value: FloatArray
    window_s: FloatArray


class _Path(NamedTuple):
    """Points (n,) that straight lines join."""

    time_s: FloatArray
    command: FloatArray


def held_rows(time_s: FloatArray, period_s: float) -> BoolArray:
    """Return for each of the (n - 1,) intervals whether a device rests in it, then jumps."""
    return np.asarray(np.diff(time_s) > period_s * (1.0 + ON_TIME))


def jump_times(time_s: FloatArray, period_s: float) -> FloatArray:
    """Return the (n - 1,) times that a device takes from each row to the next, s."""
    return np.minimum(np.diff(time_s), period_s)


def jump_speeds(time_s: FloatArray, command: FloatArray, period_s: float) -> FloatArray:
    """Return the (n - 1,) speeds with which a device goes from row to row, m/s or rad/s."""
    return np.asarray(np.diff(command) / jump_times(time_s, period_s))


def window_rows(interval_s: float, resolution: float, bound: float) -> int:
    """Return over how many intervals a speed is taken, so that rounding weighs little.

    ``w = sqrt(4·resolution/(0.05·bound))``, in intervals, at least 1.
    """
    return max(1, ceil(sqrt(4.0 * resolution / (ROUNDING_SHARE * bound)) / interval_s - 1e-9))


def accelerations(
    time_s: FloatArray,
    command: FloatArray,
    resolution: float,
    bound: float | None,
    period_s: float,
) -> Iterator[Accelerations]:
    """Yield the acceleration of a command (n,), n > 1, held before its first and after last row.

    ``resolution`` (m or rad) is what commands are rounded to, ``bound`` the greatest acceleration
    allowed; without one, speeds are taken from set-point to set-point. The pieces follow one
    another and overlap.
    """
    interval = min(float(np.median(np.diff(time_s))), period_s)
    rows = len(time_s)
    n = 1
    if bound is not None:
        n = min(window_rows(interval, resolution, bound), max(rows, _MAX_WINDOW))
    block = max(2 * n, _BLOCK // (4 * n))
    for begin in range(0, rows - 1, block):
        first, last = max(begin - 2 * n, 0), min(begin + block + 2 * n, rows)
        path = _staircase(time_s[first:last], command[first:last], period_s, 2 * n)
        before = 2 * n if first == 0 else 0
        after = 2 * n if last == rows else 0
        yield second_differences(*_at_rest(path, before, after, interval), n)


def _staircase(time_s: FloatArray, command: FloatArray, period_s: float, keep: int) -> _Path:
    """Add the points at which a device stands between rows, about a period apart.

    Less than half a period more than one is no stand but a row that comes late. Of a long stand
    the ``keep`` first and last are enough: what spans the rest sees no motion.
    """
    interval = np.diff(time_s)
    stands = np.maximum(np.rint(interval / period_s) - 1.0, 0.0)
    if not stands.any():
        return _Path(time_s, command)
    spacing = np.append((interval - period_s) / np.maximum(stands, 1.0), 0.0)
    stands = np.append(stands, 0.0)
    kept = np.minimum(stands, 2 * keep).astype(np.int64)
    row = np.repeat(np.arange(len(time_s)), kept + 1)
    number = np.arange(len(row)) - np.repeat(np.cumsum(kept + 1) - (kept + 1), kept + 1)
    late = number > keep
    number = np.where(late, stands[row] - kept[row] + number, number)
    return _Path(time_s[row] + number * spacing[row], command[row])


def _at_rest(path: _Path, before: int, after: int, interval_s: float) -> _Path:
    """Hold the first command for so many intervals before it, and the last one after it."""
    time_s, command = path
    return _Path(
        np.concatenate(
            [
                time_s[0] - np.arange(before, 0, -1) * interval_s,
                time_s,
                time_s[-1] + np.arange(1, after + 1) * interval_s,
            ]
        ),
        np.pad(command, (before, after), mode="edge"),
    )


def second_differences(time_s: FloatArray, command: FloatArray, n: int) -> Accelerations:
    """Return the accelerations of positions (m,), from speeds that are taken over ``n`` rows."""
    width = time_s[n:] - time_s[:-n]
    speed = (command[n:] - command[:-n]) / width
    value = (speed[n:] - speed[:-n]) / (0.5 * (width[n:] + width[:-n]))
    return Accelerations(time_s[n:-n], value, np.minimum(width[n:], width[:-n]))
