"""A model that runs on the commands actually applied by a device."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import PlantState
from rotemina.sim.robot.model import Robot

# Device times are told apart to this, s: their rounding would make every interval a different one,
# each with a matrix exponential of its own.
_ATOM_S = 1e-11
_FALL = 200  # rows on the way down from the high end of the range
_FALL_S = 2.0
_LONG_AGO_S = 1000.0


class LiveModel:
    """The predicted readings of a model, sample by sample, from rest at the first command.

    Parameters
    ----------
    robot : Robot
        With its effects.
    offsets : mapping axis -> float
        Constants of its readings, m or rad.
    fallen : bool
        Whether effects with memory begin as after a fall from the high end of the range rather
        than a rise from the low one, long ago: whatever happened, the truth lies between the two.
    """

    def __init__(
        self,
        robot: Robot,
        offsets: Mapping[str, float] = MappingProxyType({}),
        *,
        fallen: bool = False,
    ) -> None:
        self._plant = Plant.of(robot, closed_loop=True)
        self._offset = np.array([offsets.get(name, 0.0) for name in robot.axes])
        self._high = np.array([axis.range[1] for axis in robot.axes.values()])
        self._fallen = fallen
        self._state: PlantState | None = None
        self._time_s = 0.0

    @property
    def remembers(self) -> bool:
        """Whether any of its effects has a memory."""
        return self._plant.assembly.memory > 0

    @property
    def time_s(self) -> float:
        """Device time up to which it has followed; −∞ before the first sample."""
        return self._time_s if self._state is not None else float("-inf")

    def prepare(self) -> None:
        """Compute once to load compiled code, so that no device has to wait for it."""
        middle = np.array([[sum(axis.range) / 2 for axis in self._plant.robot.axes.values()]])
        still = np.repeat(middle, 2, axis=0)
        self.answer(np.array([0.0, 1e-3]), still)
        self.restart()

    def restart(self) -> None:
        """Rest again at the next command."""
        self._state = None

    def answer(self, time_s: FloatArray, command: FloatArray) -> FloatArray:
        """Return the model's readings (n, axes) for the next commands (n, axes), m or rad.

        They are not rounded, and NaN where the model diverges; it then starts again. Times (n,) are
        the device's.
        """
        if len(time_s) == 0:
            return np.empty(command.shape)
        if self._state is None:
            self._state = self._begin(command[0])
            self._time_s = float(time_s[0])
        elapsed_s = np.rint((time_s - self._time_s) / _ATOM_S) * _ATOM_S
        try:
            motion, state = self._plant.advance(self._state, elapsed_s, command)
        except PlantError:
            self.restart()
            return np.full(command.shape, np.nan)
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        self._time_s = float(time_s[-1])
        return np.asarray(motion.reading + self._offset)

    def _begin(self, command: FloatArray) -> PlantState:
        if not self._fallen:
            return self._plant.at_rest(0.0, command)
        share = np.linspace(1.0, 0.0, _FALL)[:, None]
        way = command + share * (self._high - command)
        time_s = np.append(np.linspace(0.0, _FALL_S, _FALL), _FALL_S + _LONG_AGO_S)
        state = self._plant.at_rest(0.0, self._high)
        _, state = self._plant.advance(state, time_s, np.vstack([way, command[None]]))
        return replace(state, time_s=state.time_s - state.time_s[-1])
