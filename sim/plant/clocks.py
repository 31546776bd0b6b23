"""Readings that are stamped by a clock which runs fast or slow.

Between samples the motion is interpolated by the polynomial through the nearest samples. A
reading that lags uses only samples up to its own, so a run simulated in pieces equals one simulated
as a whole.
"""

from collections.abc import Mapping

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.robot import Robot

# Samples through which the motion is interpolated.
INTERPOLATION_ROWS = 6
# How many of them lie before the requested time, if there are enough after it.
_ROWS_BEFORE = 3


def skew_readings(
    skews: Mapping[int, float],
    position: FloatArray,
    reading: FloatArray,
    clock_s: FloatArray,
    robot: Robot,
    *,
    rounded: bool,
) -> FloatArray:
    """Return readings (n, axes) of the motion at ``clock_s − rate·clock_s``.

    ``position`` (n, axes) is the motion at ``clock_s`` (n,), history included. Before the first
    row, and after the last row (which ``rate`` < 0 needs), the motion is assumed to stand still.
    With ``rounded`` the readings are rounded to the sensors' resolution.
    """
    skewed = reading.copy() if skews else reading
    for column, rate in skews.items():
        path = position[:, column]
        motion_s = np.clip(clock_s * (1.0 - rate), clock_s[0], clock_s[-1])
        # Only the motion is shifted in time; noise and offset of the reading stay with their row.
        skewed[:, column] += _interpolate_path(motion_s, clock_s, path) - path
        sensor = list(robot.axes.values())[column].sensor
        if rounded and sensor is not None and sensor.resolution > 0.0:
            skewed[:, column] = np.rint(skewed[:, column] / sensor.resolution) * sensor.resolution
    return skewed


def _interpolate_path(query_s: FloatArray, time_s: FloatArray, path: FloatArray) -> FloatArray:
    """Return ``path`` (n,) interpolated at ``query_s`` (n,).

    Each row uses samples up to that row or up to its time, whichever is later, because the clock of
    a reading may be ahead of its row.
    """
    next_row = np.searchsorted(time_s, query_s)
    last_row = np.maximum(
        np.arange(len(time_s)),
        np.minimum(next_row + INTERPOLATION_ROWS - _ROWS_BEFORE, len(time_s) - 1),
    )
    last_row = np.where(query_s > time_s, last_row, np.arange(len(time_s)))
    row_count = np.minimum(last_row + 1, INTERPOLATION_ROWS)
    first_row = np.clip(next_row - _ROWS_BEFORE, 0, last_row + 1 - row_count)
    return _evaluate_polynomials(query_s, time_s, np.ascontiguousarray(path), first_row, row_count)


@numba.njit(cache=True, error_model="numpy")
def _evaluate_polynomials(
    query_s: FloatArray,
    time_s: FloatArray,
    path: FloatArray,
    first_row: IntArray,
    row_count: IntArray,
) -> FloatArray:
    """Evaluate at ``query_s`` the Lagrange polynomials through ``row_count`` samples; all (n,)."""
    value = np.zeros(len(query_s))
    for k in range(len(query_s)):
        for i in range(first_row[k], first_row[k] + row_count[k]):
            weight = 1.0
            for j in range(first_row[k], first_row[k] + row_count[k]):
                if j != i:
                    weight *= (query_s[k] - time_s[j]) / (time_s[i] - time_s[j])
            value[k] += weight * path[i]
    return value
