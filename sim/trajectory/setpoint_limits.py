"""Bounds of the set-points of each axis, with defaults for bounds that a robot does not declare."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory.axis_limits import compute_reachable_range

# An axis without a declared speed limit may cross its range in this time.
_DEFAULT_CROSSING_TIME_S = 1.0
# An axis without a declared acceleration limit may reach its maximum speed in this time.
_DEFAULT_STARTING_TIME_S = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class SetpointLimits:
    """Bounds of the axes, (axes,) each: m or rad, per s, per s².

    ``low`` and ``high`` are the ends of the range that the amplifier's voltage can reach.
    """

    low: FloatArray
    high: FloatArray
    speed: FloatArray
    acceleration: FloatArray

    @classmethod
    def of(cls, robot: Robot) -> Self:
        """Return the limits of a robot, with defaults for limits that it does not declare."""
        axes = robot.axes.values()
        speed = np.array([axis.max_speed or axis.span / _DEFAULT_CROSSING_TIME_S for axis in axes])
        acceleration = [
            axis.max_acceleration or max_speed / _DEFAULT_STARTING_TIME_S
            for axis, max_speed in zip(axes, speed, strict=True)
        ]
        low, high = np.array([compute_reachable_range(axis) for axis in axes], dtype=np.float64).T
        return cls(low.copy(), high.copy(), speed, np.array(acceleration, dtype=np.float64))
