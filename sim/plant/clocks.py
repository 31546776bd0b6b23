"""Readings that are stamped by a clock which runs fast or slow."""

from collections.abc import Mapping

import numpy as np
from scipy.interpolate import CubicSpline

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot


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
    row and behind the last the motion is taken to stand still. ``rounded``: to the sensors'
    resolution.
    """
    skewed = reading.copy() if skews else reading
    for column, rate in skews.items():
        if len(clock_s) < 2:
            continue
        path = CubicSpline(clock_s, position[:, column])
        when = np.clip(clock_s * (1.0 - rate), clock_s[0], clock_s[-1])
        skewed[:, column] += path(when) - position[:, column]
        sensor = list(robot.axes.values())[column].sensor
        if rounded and sensor is not None and sensor.resolution > 0.0:
            skewed[:, column] = np.rint(skewed[:, column] / sensor.resolution) * sensor.resolution
    return skewed
