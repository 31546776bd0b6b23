"""A plant simulated ahead of the present, in far fewer, longer runs.

A run of the plant costs the same for one tick as for a hundred. Boards look at it at every sample
of telemetry; so the machine is simulated beyond the present over the commands that will come if
nobody interferes, and taken back to it when other ones come. What comes out is the same, noise
included, as without it.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.effect_switch import taken_over
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.state import PlantState
from rotemina.sim.robot.model import AxisEffect

_AHEAD = 100  # ticks

Expected = Callable[[int], FloatArray | None]  # the next so many commands, if anybody knows them


class Response(NamedTuple):
    """Positions and readings (ticks, axes), m or rad."""

    position: FloatArray
    reading: FloatArray


class _Chance(Chance):
    """Chance that can be taken back by so many rows."""

    def __init__(self, generator: np.random.Generator) -> None:
        super().__init__(generator)
        self._rows: FloatArray | None = None
        self._back = 0

    def take_back(self, rows: int) -> None:
        """Draw the last rows again."""
        self._back += rows

    def draw(self, rows: int, axes: int, effects: int) -> FloatArray:
        """Return (rows, effects + axes) variates."""
        own = np.zeros((0, effects + axes)) if self._rows is None else self._rows
        missing = rows - self._back
        if missing > 0:
            own = np.concatenate((own, super().draw(missing, axes, effects)))
        begin = len(own) - max(self._back, rows)
        self._back = max(-missing, 0)
        drawn = own[begin : begin + rows]
        self._rows = own[-(2 * _AHEAD + rows) :]
        return drawn


@dataclass(frozen=True, slots=True, eq=False)
class _Prediction:
    """What follows expected commands: the state before and after, and how many have come."""

    before: PlantState
    commands: FloatArray
    response: Response
    after: PlantState
    used: int

    def predicted(self, commands: FloatArray) -> bool:
        """Return whether these come next, as far as was looked."""
        seen = self.commands[self.used : self.used + len(commands)]
        return np.array_equal(commands[: len(seen)], seen)


class PlantRun:
    """A plant under way, tick by tick."""

    def __init__(self, plant: Plant, tick_s: float, seed: int, position: FloatArray) -> None:
        self._plant = plant
        self._tick_s = tick_s
        self._chance = _Chance(np.random.default_rng(seed))
        self._state = plant.at_rest(0.0, position)
        self._prediction: _Prediction | None = None

    def advance(self, commands: FloatArray, expected: Expected) -> Response:
        """Return the response to commands (ticks, axes), at least one; others are expected then.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        parts = []
        if self._prediction is not None and self._prediction.predicted(commands):
            parts.append(self._use(self._prediction, len(commands)))
            commands = commands[len(parts[0].position) :]
        if len(commands):
            self._settle()
            ahead = expected(_AHEAD) if len(commands) < _AHEAD else None
            parts.append(self._run(commands) if ahead is None else self._look(commands, ahead))
        if len(parts) == 1:
            return parts[0]
        return Response(*(np.concatenate(both) for both in zip(*parts, strict=True)))

    def go_on_with(self, effects: tuple[AxisEffect, ...]) -> None:
        """Continue with other effects, from where the axes are and as fast as they are."""
        self._settle()
        robot = replace(self._plant.robot, effects=effects)
        plant = Plant.of(robot, closed_loop=True)
        self._plant, self._state = plant, taken_over(plant, self._plant, self._state)

    def _use(self, beyond: _Prediction, ticks: int) -> Response:
        """Return what was found ahead of the next ticks, as far as it goes."""
        end = min(beyond.used + ticks, len(beyond.response.position))
        found = Response(*(part[beyond.used : end] for part in beyond.response))
        if end == len(beyond.response.position):
            self._state, self._prediction = beyond.after, None
        else:
            self._prediction = replace(beyond, used=end)
        return found

    def _settle(self) -> None:
        """Come back from beyond the present."""
        beyond, self._prediction = self._prediction, None
        if beyond is None:
            return
        self._chance.take_back(len(beyond.response.position))
        self._state = beyond.before
        self._run(beyond.commands[: beyond.used])

    def _look(self, commands: FloatArray, ahead: FloatArray) -> Response:
        """Return the response to commands, and keep the one to those that are expected."""
        before, ticks = self._state, len(commands)
        both = np.concatenate((commands, ahead))
        found = self._run(both)
        self._prediction = _Prediction(before, both, found, self._state, ticks)
        return Response(*(part[:ticks] for part in found))

    def _run(self, commands: FloatArray) -> Response:
        # The plant counts from the latest tick: its steps stay exact however long it runs.
        since_s = np.arange(1, len(commands) + 1, dtype=np.float64) * self._tick_s
        motion, state = self._plant.advance(self._state, since_s, commands, chance=self._chance)
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        return Response(motion.position, motion.reading)
