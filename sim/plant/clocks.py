"""Readings that are stamped by a clock which runs fast or slow.

Between samples the motion is interpolated by the polynomial through the few nearest ones. A
reading that lags is made of samples up to its own alone, so a run done in pieces is the same as
one done at once.
"""

from collections.abc import Mapping

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.robot.model import Robot

ROWS = 6  # samples through which the motion is interpolated
_BEHIND = 3  # of them that lie before the time that is asked for, where there are enough after it


def on_skewed_clocks(
    skews: Mapping[int, float],
    position: FloatArray,
    reading: FloatArray,
    clock_s: FloatArray,
    robot: Robot,
    *,
    rounded: bool,
) -> FloatArray:
    """Return readings (n, axes) whose motion is that of ``clock_s − rate·clock_s``.

    ``position`` (n, axes) is the motion at ``clock_s`` (n,), history included. Before the first
    row and behind the last (``rate`` < 0 asks for what is yet to come) the motion is taken to
    stand still. ``rounded``: to the sensors' resolution.
    """
    skewed = reading.copy() if skews else reading
    for column, rate in skews.items():
        path = position[:, column]
        when = np.clip(clock_s * (1.0 - rate), clock_s[0], clock_s[-1])
        skewed[:, column] += _at(when, clock_s, path) - path
        sensor = list(robot.axes.values())[column].sensor
        if rounded and sensor is not None and sensor.resolution > 0.0:
            skewed[:, column] = np.rint(skewed[:, column] / sensor.resolution) * sensor.resolution
    return skewed


def _at(when: FloatArray, time_s: FloatArray, path: FloatArray) -> FloatArray:
    """Return ``path`` (n,) at ``when`` (n,), row by row from samples up to that row or that time.

    Up to the later of both: a reading may be ahead.
    """
    after = np.searchsorted(time_s, when)
    last = np.maximum(np.arange(len(time_s)), np.minimum(after + ROWS - _BEHIND, len(time_s) - 1))
    last = np.where(when > time_s, last, np.arange(len(time_s)))
    rows = np.minimum(last + 1, ROWS)
    first = np.clip(after - _BEHIND, 0, last + 1 - rows)
    return _polynomials(when, time_s, np.ascontiguousarray(path), first, rows)


@numba.njit(cache=True, error_model="numpy")
def _polynomials(
    when: FloatArray, time_s: FloatArray, path: FloatArray, first: IntArray, rows: IntArray
) -> FloatArray:
    """Return at ``when`` (n,) Lagrange's polynomials through ``rows`` samples from ``first``."""
    value = np.zeros(len(when))
    for k in range(len(when)):
        for i in range(first[k], first[k] + rows[k]):
            weight = 1.0
            for j in range(first[k], first[k] + rows[k]):
                if j != i:
                    weight *= (when[k] - time_s[j]) / (time_s[i] - time_s[j])
            value[k] += weight * path[i]
    return value
