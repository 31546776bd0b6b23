"""Simulation of a plant ahead of time, in fewer and longer runs.

Simulating one tick of the plant takes as long as simulating a hundred. Boards read the plant at
every sample of telemetry. So the plant is simulated ahead with the expected commands. If other
commands arrive, it is rewound to the current tick and simulated with those. The result, including
the noise, is the same as without looking ahead.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import Plant, PlantState, RandomStreams, transfer_state
from rotemina.sim.robot import AxisEffect

_AHEAD_TICKS = 100

# Returns the expected commands (ticks, axes) of a number of ticks, or None if they are unknown.
ExpectedCommands = Callable[[int], FloatArray | None]


class AxisResponse(NamedTuple):
    """Response of the axes: positions and readings (ticks, axes), m or rad."""

    position: FloatArray
    reading: FloatArray


class _RewindableStreams(RandomStreams):
    def __init__(self, generator: np.random.Generator) -> None:
        super().__init__(generator)
        self._rows: FloatArray | None = None
        self._rewound_rows = 0

    def rewind(self, rows: int) -> None:
        """Make the next calls draw the last rows again."""
        self._rewound_rows += rows

    def draw(self, rows: int, axes: int, effects: int) -> FloatArray:
        """Return (rows, effects + axes) random numbers."""
        stored_rows = np.zeros((0, effects + axes)) if self._rows is None else self._rows
        new_count = rows - self._rewound_rows
        if new_count > 0:
            stored_rows = np.concatenate((stored_rows, super().draw(new_count, axes, effects)))
        begin = len(stored_rows) - max(self._rewound_rows, rows)
        self._rewound_rows = max(-new_count, 0)
        result = stored_rows[begin : begin + rows]
        self._rows = stored_rows[-(2 * _AHEAD_TICKS + rows) :]
        return result


@dataclass(frozen=True, slots=True, eq=False)
class _Prediction:
    """Response to expected commands, with the plant's state before and after it.

    ``used_count`` is the number of ticks that have been used so far.
    """

    state_before: PlantState
    commands: FloatArray
    response: AxisResponse
    state_after: PlantState
    used_count: int

    def is_next(self, commands: FloatArray) -> bool:
        """Return whether these commands match the prediction, as long as it lasts."""
        expected = self.commands[self.used_count : self.used_count + len(commands)]
        return np.array_equal(commands[: len(expected)], expected)


class PlantRun:
    """Simulation of a plant, tick by tick, that looks ahead."""

    def __init__(self, plant: Plant, tick_s: float, seed: int, position: FloatArray) -> None:
        self._plant = plant
        self._tick_s = tick_s
        self._random_streams = _RewindableStreams(np.random.default_rng(seed))
        self._state = plant.find_rest_state(0.0, position)
        self._prediction: _Prediction | None = None

    def advance(self, commands: FloatArray, expected: ExpectedCommands) -> AxisResponse:
        """Return the response to commands (ticks, axes).

        Parameters
        ----------
        commands : (ticks, axes)
            Commands of at least one tick, m or rad.
        expected : callable
            Returns the commands that are expected to follow.

        Raises
        ------
        PlantError
            If the motion exceeds the range of floating-point numbers.
        """
        parts = []
        if self._prediction is not None and self._prediction.is_next(commands):
            parts.append(self._use_prediction(self._prediction, len(commands)))
            commands = commands[len(parts[0].position) :]
        if len(commands):
            self._rewind()
            expected_commands = expected(_AHEAD_TICKS) if len(commands) < _AHEAD_TICKS else None
            parts.append(
                self._run_plant(commands)
                if expected_commands is None
                else self._run_ahead(commands, expected_commands)
            )
        if len(parts) == 1:
            return parts[0]
        return AxisResponse(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))

    def set_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Continue with other effects, at the current positions and speeds of the axes."""
        self._rewind()
        robot = replace(self._plant.robot, effects=effects)
        plant = Plant.of(robot, closed_loop=True)
        self._plant, self._state = plant, transfer_state(plant, self._plant, self._state)

    def _use_prediction(self, prediction: _Prediction, ticks: int) -> AxisResponse:
        end = min(prediction.used_count + ticks, len(prediction.response.position))
        response = AxisResponse(
            *(part[prediction.used_count : end] for part in prediction.response)
        )
        if end == len(prediction.response.position):
            self._state, self._prediction = prediction.state_after, None
        else:
            self._prediction = replace(prediction, used_count=end)
        return response

    def _rewind(self) -> None:
        prediction, self._prediction = self._prediction, None
        if prediction is None:
            return
        self._random_streams.rewind(len(prediction.response.position))
        self._state = prediction.state_before
        self._run_plant(prediction.commands[: prediction.used_count])

    def _run_ahead(self, commands: FloatArray, expected_commands: FloatArray) -> AxisResponse:
        """Return the response to commands, and store a prediction for the expected commands."""
        state_before, ticks = self._state, len(commands)
        all_commands = np.concatenate((commands, expected_commands))
        response = self._run_plant(all_commands)
        self._prediction = _Prediction(state_before, all_commands, response, self._state, ticks)
        return AxisResponse(*(part[:ticks] for part in response))

    def _run_plant(self, commands: FloatArray) -> AxisResponse:
        # The time of the plant restarts at 0 in each run, so that rounding errors do not grow.
        time_s = np.arange(1, len(commands) + 1, dtype=np.float64) * self._tick_s
        motion, state = self._plant.advance(
            self._state, time_s, commands, random_streams=self._random_streams
        )
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        return AxisResponse(motion.position, motion.reading)
