"""Machine that the boards control: plant, sensors, limit switches and counters."""

from collections.abc import Callable, Sequence

import numpy as np

from rotemina.drivers.mc68hc11.protocol import BoardAxis
from rotemina.drivers.virtual_board.lookahead import PlantRun
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import Plant
from rotemina.sim.robot import (
    AxisEffect,
    Robot,
    StepperAxis,
)

# Returns the expected next commands (ticks, axes of the board), whole steps, or None.
CommandPreview = Callable[[int], FloatArray | None]

# Distance from an end of the range to its limit switch, as a fraction of the range.
_OVERTRAVEL_RATIO = 0.01
# Number of ticks whose readings are kept for captures.
_MAX_KEPT_READINGS = 512


class BoardMachine:
    """Machine with the axes of all boards. It simulates many ticks at once when it is read.

    A stepper has a counter for its commands and one for its measuring system. Both start at
    arbitrary values. The origin of a counter is the machine position at which it is 0.

    Parameters
    ----------
    robot : Robot
    axes : sequence of BoardAxis
        All axes, those of the first board first.
    tick_s : float
    seed : int
        Seed of noise and random effects.
    position : (axes,)
        Position at the start, m or rad.
    """

    def __init__(
        self,
        robot: Robot,
        axes: Sequence[BoardAxis],
        *,
        tick_s: float,
        seed: int,
        position: FloatArray,
    ) -> None:
        plant = Plant.of(robot, closed_loop=True)
        self._plant_run = PlantRun(plant, tick_s, seed, position)
        robot_axes = [robot.axes[axis.name] for axis in axes]
        self.axis_names = tuple(axis.name for axis in axes)
        self.step_size = np.array([axis.step_size for axis in axes])
        self.is_stepper = np.array([isinstance(axis, StepperAxis) for axis in robot_axes])
        self.has_loop = tuple(loop is not None for loop in plant.loops)
        low, high = np.array([axis.range for axis in robot_axes], dtype=np.float64).T
        self.low_switch = np.where(self.is_stepper, low - _OVERTRAVEL_RATIO * (high - low), -np.inf)
        self.high_switch = np.where(
            self.is_stepper, high + _OVERTRAVEL_RATIO * (high - low), np.inf
        )
        self.command_origin = np.zeros(len(robot_axes))
        self.reading_origin = np.zeros(len(robot_axes))
        self.position = np.array(position, dtype=np.float64)
        self.command = self.position.copy()
        # One preview for each board, in the order of the axes.
        self.previews: list[CommandPreview] = []
        self._frozen_readings: dict[int, float] = {}
        self._pending_commands: list[FloatArray] = []
        self._readings = (self.position + [axis.offset for axis in robot_axes])[None]
        # Tick of the oldest reading that is kept.
        self._first_tick = 0

    @property
    def reading(self) -> FloatArray:
        """Latest readings (axes,) of the sensors, m or rad."""
        return np.asarray(self._readings[-1])

    def set_counters(self, index: int, command: int, reading: int) -> None:
        """Set the counters of an axis at its current position to a command and reading, steps."""
        self.simulate()
        step = self.step_size[index]
        self.command_origin[index] = self.command[index] - command * step
        self.reading_origin[index] = self.reading[index] - reading * step

    def lose_steps(self, index: int, steps: float) -> None:
        """Make an axis lose steps: from the next tick on, it lags behind its command by these."""
        self.command_origin[index] -= steps * self.step_size[index]

    def freeze_sensor(self, index: int) -> None:
        """Freeze the sensor of an axis at its current reading."""
        self.simulate()
        self._frozen_readings[index] = float(self.reading[index])

    def thaw_sensor(self, index: int) -> None:
        """Release the frozen sensor of an axis."""
        self._frozen_readings.pop(index, None)

    def set_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Continue with other effects, at the current positions and speeds of the axes."""
        self.simulate()
        self._plant_run.set_effects(effects)

    def add_commands(self, steps: FloatArray) -> None:
        """Add the commands (ticks, axes) of the next ticks, whole steps."""
        commands = self.command_origin + steps * self.step_size
        self._pending_commands.append(commands)
        self.command = commands[-1]

    def simulate(self) -> None:
        """Simulate up to the latest tick, and so update readings and positions.

        Raises
        ------
        PlantError
            If the motion exceeds the range of floating-point numbers.
        """
        if not self._pending_commands:
            return
        commands = (
            np.concatenate(self._pending_commands)
            if len(self._pending_commands) > 1
            else self._pending_commands[0]
        )
        self._pending_commands.clear()
        response = self._plant_run.advance(commands, self._predict_commands)
        self.position = response.position[-1]
        readings = np.array(response.reading)
        for index, value in self._frozen_readings.items():
            readings[:, index] = value
        all_readings = np.concatenate((self._readings, readings))
        dropped_count = max(len(all_readings) - max(_MAX_KEPT_READINGS, len(readings)), 0)
        self._first_tick += dropped_count
        self._readings = all_readings[dropped_count:]

    def _predict_commands(self, ticks: int) -> FloatArray | None:
        board_previews = [preview(ticks) for preview in self.previews]
        commands = [preview for preview in board_previews if preview is not None]
        count = min((len(board_commands) for board_commands in commands), default=0)
        if len(commands) < len(board_previews) or not count:
            return None
        commands = [board_commands[:count] for board_commands in commands]
        return np.asarray(self.command_origin + np.concatenate(commands, axis=1) * self.step_size)

    def find_readings(self, ticks: Sequence[int], indices: Sequence[int]) -> FloatArray:
        """Return the readings (ticks, indices) of recent ticks, rounded to steps."""
        rows = np.asarray(ticks) - self._first_tick
        counters = (self._readings - self.reading_origin) / self.step_size
        return np.asarray(np.rint(counters[np.ix_(rows, np.asarray(indices))]))

    def read_counters(self) -> FloatArray:
        """Return the latest readings (axes,), rounded to steps."""
        return np.asarray(np.rint((self.reading - self.reading_origin) / self.step_size))

    def read_switches(self, index: int) -> tuple[bool, bool]:
        """Return whether the low and the high limit switch of an axis are closed."""
        position = self.position[index]
        return bool(position <= self.low_switch[index]), bool(position >= self.high_switch[index])

    def is_near_switch(self, index: int, margin: float) -> bool:
        """Return whether an axis or its command is closer to a switch than a margin, m or rad."""
        for position in (self.position[index], self.command[index]):
            if (
                position - self.low_switch[index] < margin
                or self.high_switch[index] - position < margin
            ):
                return True
        return False
