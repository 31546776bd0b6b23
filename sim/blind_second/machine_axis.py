"""An axis in this generator, and the time course of one record."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import PiezoAxis, Robot, StepperAxis


@dataclass(frozen=True, slots=True)
class AxisFacts:
    """Figures of one axis, SI; ``index`` in the case, ``low`` and ``way`` of its motion."""

    name: str
    index: int
    kind: str
    low: float
    way: float
    floor: float
    noise: float
    resolution: float
    mass: float
    damping: float
    stiffness: float
    full_step: float
    pitch: float
    volt: float  # position per volt; 1 of a stepper


class Grid(NamedTuple):
    """A fine time grid: rows before the record begins, rows a sample, seconds a row."""

    lead: int
    every: int
    step_s: float

    def time_s(self, rows: int) -> FloatArray:
        """Return the time since the record began (rows,)."""
        return np.asarray((np.arange(rows) - self.lead) * self.step_s)


def facts_of(robot: Robot, name: str, index: int, commands: FloatArray) -> AxisFacts:
    """Gather the figures of an axis that goes where ``commands`` (n,) say.

    Raises
    ------
    ValueError
        If it is no piezo or stepper with sensor and mass.
    """
    axis = robot.axes[name]
    if not isinstance(axis, PiezoAxis | StepperAxis) or axis.sensor is None or axis.inertia is None:
        raise ValueError(f"axis {name}: it needs a sensor, a mass and a spring")
    pitch = (axis.pitch or 1e-3) if isinstance(axis, StepperAxis) else 1e-3
    steps = (axis.steps_per_rev or 200) if isinstance(axis, StepperAxis) else 200
    return AxisFacts(
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
