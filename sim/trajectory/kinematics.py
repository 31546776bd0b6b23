"""Speed and acceleration of sampled commands, judged so that rounding does not count.

Commands come rounded, by a file's digits or to a device's microsteps. A second difference divides
that rounding by the square of the interval: at 1 kHz, 0.1 µm poses as 0.4 m/s². Acceleration is
therefore taken over a window in which one resolution of rounding weighs at most
``ROUNDING_SHARE`` of the bound.
"""

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray

ROUNDING_SHARE = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Accelerations:
    """Accelerations ``value`` (m,) about the times ``time_s`` (m,), each over a window (m,) s.

    ``window_s`` is the length of the shorter of the two intervals whose speeds are compared.
    """

    time_s: FloatArray
    value: FloatArray
    window_s: FloatArray


def jump_speeds(time_s: FloatArray, command: FloatArray) -> FloatArray:
    """Return the (n - 1,) speeds from each row to the next, m/s or rad/s."""
    return np.asarray(np.diff(command) / np.diff(time_s))


def window_rows(time_s: FloatArray, resolution: float, bound: float) -> int:
    """Return over how many rows a speed is taken, so that rounding weighs little.

    ``w = sqrt(4·resolution/(0.05·bound))``, in rows of the median interval, at least 1.
    """
    window = sqrt(4.0 * resolution / (ROUNDING_SHARE * bound))
    return max(1, ceil(window / float(np.median(np.diff(time_s))) - 1e-9))


def accelerations(
    time_s: FloatArray, command: FloatArray, resolution: float, bound: float | None
) -> Accelerations:
    """Return the acceleration of a command (n,), n > 1, held before its first and after last row.

    ``resolution`` (m or rad) is what commands are rounded to, ``bound`` the greatest acceleration
    allowed; without one, speeds are taken from row to row.
    """
    n = 1 if bound is None else window_rows(time_s, resolution, bound)
    interval = float(np.median(np.diff(time_s)))
    held = np.arange(1, 2 * n + 1) * interval
    time = np.concatenate([time_s[0] - held[::-1], time_s, time_s[-1] + held])
    position = np.pad(command, 2 * n, mode="edge")
    width = time[n:] - time[:-n]
    speed = (position[n:] - position[:-n]) / width
    value = (speed[n:] - speed[:-n]) / (0.5 * (width[n:] + width[:-n]))
    return Accelerations(time[n:-n], value, np.minimum(width[n:], width[:-n]))
