"""Bounds that a device keeps the set-points of each axis in, also where a robot declares none."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import reachable

# What an axis without declared bounds is given: its range in a second, that speed in a tenth.
_CROSSING_S = 1.0
_STARTING_S = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class SetpointLimits:
    """Bounds of each axis, (axes,) each: m or rad, per s, per s².

    ``low`` and ``high`` are ends of the range, or nearer where the amplifier's voltage ends.
    """

    low: FloatArray
    high: FloatArray
    speed: FloatArray
    acceleration: FloatArray

    @classmethod
    def of(cls, robot: Robot) -> Self:
        """Return the limits of a robot; an axis that declares none crosses its range in 1 s."""
        axes = robot.axes.values()
        speed = np.array([axis.max_speed or axis.span / _CROSSING_S for axis in axes])
        acceleration = [
            axis.max_acceleration or fastest / _STARTING_S
            for axis, fastest in zip(axes, speed, strict=True)
        ]
        low, high = np.array([reachable(axis) for axis in axes], dtype=np.float64).T
        return cls(low.copy(), high.copy(), speed, np.array(acceleration, dtype=np.float64))
