"""A model that runs on the commands actually applied by a device."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Plant, PlantState
from rotemina.sim.robot import Robot

# Device times are rounded to multiples of this. Otherwise rounding errors would make all intervals
# different, and each different interval needs its own matrix exponential.
_TIME_RESOLUTION_S = 1e-11
# A run "after a fall" begins with this many rows down from the high end of the range, over this
# time, and then a long rest.
_FALL_ROW_COUNT = 200
_FALL_DURATION_S = 2.0
_REST_AFTER_FALL_S = 1000.0


class LiveModel:
    """A model that predicts readings sample by sample, starting from rest at the first command.

    Parameters
    ----------
    robot : Robot
        With its effects.
    offsets : mapping axis -> float
        Constant offsets of its readings, m or rad.
    starts_after_fall : bool
        Whether effects with memory begin as if the axes had long ago fallen from the high end of
        their range, instead of risen from the low end. The real past lies between these two.
    """

    def __init__(
        self,
        robot: Robot,
        offsets: Mapping[str, float] = MappingProxyType({}),
        *,
        starts_after_fall: bool = False,
    ) -> None:
        self._plant = Plant.of(robot, closed_loop=True)
        self._offset = np.array([offsets.get(name, 0.0) for name in robot.axes])
        self._high = np.array([axis.range[1] for axis in robot.axes.values()])
        self._is_after_fall = starts_after_fall
        self._state: PlantState | None = None
        self._time_s = 0.0

    @property
    def has_memory(self) -> bool:
        """Whether any of its effects has a memory."""
        return self._plant.assembly.memory_size > 0

    @property
    def time_s(self) -> float:
        """Device time of the latest command that the model has followed; −∞ before the first."""
        return self._time_s if self._state is not None else float("-inf")

    def prepare(self) -> None:
        """Run the model once, so that no device has to wait while compiled code is loaded."""
        mid_position = np.array([[sum(axis.range) / 2 for axis in self._plant.robot.axes.values()]])
        resting_commands = np.repeat(mid_position, 2, axis=0)
        self.predict(np.array([0.0, 1e-3]), resting_commands)
        self.restart()

    def restart(self) -> None:
        """Start again from rest at the next command."""
        self._state = None

    def predict(self, time_s: FloatArray, command: FloatArray) -> FloatArray:
        """Return the model's readings (n, axes) for the next commands (n, axes), m or rad.

        The readings are not rounded. If the model diverges they are NaN, and the model starts
        again. ``time_s`` (n,) are device times.
        """
        if len(time_s) == 0:
            return np.empty(command.shape)
        if self._state is None:
            self._state = self._make_initial_state(command[0])
            self._time_s = float(time_s[0])
        elapsed_s = np.rint((time_s - self._time_s) / _TIME_RESOLUTION_S) * _TIME_RESOLUTION_S
        try:
            motion, state = self._plant.advance(self._state, elapsed_s, command)
        except PlantError:
            self.restart()
            return np.full(command.shape, np.nan)
        # Times start at 0 again, so that they never grow so large that they lose precision.
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        self._time_s = float(time_s[-1])
        return np.asarray(motion.reading + self._offset)

    def _make_initial_state(self, command: FloatArray) -> PlantState:
        if not self._is_after_fall:
            return self._plant.find_rest_state(0.0, command)
        fractions = np.linspace(1.0, 0.0, _FALL_ROW_COUNT)[:, None]
        path = command + fractions * (self._high - command)
        time_s = np.append(
            np.linspace(0.0, _FALL_DURATION_S, _FALL_ROW_COUNT),
            _FALL_DURATION_S + _REST_AFTER_FALL_S,
        )
        state = self._plant.find_rest_state(0.0, self._high)
        _, state = self._plant.advance(state, time_s, np.vstack([path, command[None]]))
        return replace(state, time_s=state.time_s - state.time_s[-1])
