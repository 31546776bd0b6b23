"""The nominal model, kept running on the commands that a device really applied."""

from dataclasses import replace

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import PlantState
from rotemina.sim.robot.model import Robot

# Device times are told apart to this, s: their rounding would make every interval a different one,
# each with a matrix exponential of its own.
_ATOM_S = 1e-11


class LiveModel:
    """What the nominal model would measure, sample by sample, from rest at the first command."""

    def __init__(self, robot: Robot) -> None:
        self._plant = Plant.of(robot, closed_loop=True)
        self._offset = np.array([axis.offset for axis in robot.axes.values()])
        self._state: PlantState | None = None
        self._time_s = 0.0

    def prepare(self) -> None:
        """Compute once, which loads what is compiled: no device is to wait for that."""
        middle = np.array([[sum(axis.range) / 2 for axis in self._plant.robot.axes.values()]])
        still = np.repeat(middle, 2, axis=0)
        times, rows = np.array([0.0, 1e-3]), np.full(2, -1)
        self.follow(Samples(times, still, still, np.full(still.shape, np.nan), rows))
        self.restart()

    def restart(self) -> None:
        """Rest again at the next command."""
        self._state = None

    def follow(self, samples: Samples) -> FloatArray:
        """Return the model's readings (n, axes) for the next samples, m or rad, not rounded.

        Where the model leaves what a number can hold they are NaN, and it starts anew.
        """
        if len(samples) == 0:
            return np.empty(samples.command.shape)
        if self._state is None:
            self._state = self._plant.at_rest(0.0, samples.command[0])
            self._time_s = float(samples.device_time_s[0])
        elapsed_s = np.rint((samples.device_time_s - self._time_s) / _ATOM_S) * _ATOM_S
        try:
            motion, state = self._plant.advance(self._state, elapsed_s, samples.command)
        except PlantError:
            self.restart()
            return np.full(samples.command.shape, np.nan)
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        self._time_s = float(samples.device_time_s[-1])
        return np.asarray(motion.position + self._offset)
