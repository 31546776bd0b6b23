"""An axis of the second generator, and the time grid of one record."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot import (
    PiezoAxis,
    Robot,
    StepperAxis,
)


@dataclass(frozen=True, slots=True)
class SecondAxis:
    """Properties of one axis, in SI units.

    Attributes
    ----------
    index : column of the axis in the case.
    low, travel : lowest command, and distance to the highest command.
    floor : noise floor of the sensor.
    position_per_volt : gain of the amplifier; 1 for a stepper.
    """

    name: str
    index: int
    kind: str
    low: float
    travel: float
    floor: float
    noise: float
    resolution: float
    mass: float
    damping: float
    stiffness: float
    full_step: float
    pitch: float
    position_per_volt: float


class FineTimeGrid(NamedTuple):
    """A fine time grid: rows before the record, rows per sample, and seconds per row."""

    lead_rows: int
    rows_per_sample: int
    step_s: float

    def compute_time_s(self, rows: int) -> FloatArray:
        """Return the time (rows,) since the record began."""
        return np.asarray((np.arange(rows) - self.lead_rows) * self.step_s)


def describe_axis(robot: Robot, name: str, index: int, commands: FloatArray) -> SecondAxis:
    """Collect the properties of an axis that follows ``commands`` (n,).

    Raises
    ------
    ValueError
        If the axis is not a piezo or stepper axis, or has no sensor or mass.
    """
    axis = robot.axes[name]
    if not isinstance(axis, PiezoAxis | StepperAxis) or axis.sensor is None or axis.inertia is None:
        raise ValueError(f"axis {name}: it needs a sensor, a mass and a spring")
    pitch = (axis.pitch or 1e-3) if isinstance(axis, StepperAxis) else 1e-3
    steps = (axis.steps_per_rev or 200) if isinstance(axis, StepperAxis) else 200
    return SecondAxis(
        name,
        index,
        axis.kind,
        float(commands.min()),
        float(np.ptp(commands)),
        axis.sensor.noise_floor,
        axis.sensor.noise_rms,
        axis.sensor.resolution,
        *axis.inertia,
        pitch / steps,
        pitch,
        axis.gain,
    )
