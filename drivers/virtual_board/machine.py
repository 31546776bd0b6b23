"""The machine behind the boards: plant, sensors, limit switches, and counters."""

from collections.abc import Callable, Sequence

import numpy as np

from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.virtual_board.lookahead import PlantRun
from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.model import AxisEffect, Robot, StepperAxis

Preview = Callable[[int], FloatArray | None]  # whole steps (ticks, own axes) that will come next

_OVERTRAVEL = 0.01  # of the range: how far beyond its ends the limit switches are
_KEPT = 512  # readings that are kept for captures, ticks


class Machine:
    """The plant behind both boards. It is simulated when someone looks, many ticks at once.

    A stepper's counters, of its commands and of its measuring system, begin somewhere: their
    origins lead from steps to the position of the machine.

    Parameters
    ----------
    robot : Robot
    axes : sequence of BoardAxis
        All axes, those of the first board first.
    tick_s : float
    seed : int
        Of noise and random effects.
    position : (axes,)
        Where the machine stands at first, m or rad.
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
        self._run = PlantRun(plant, tick_s, seed, position)
        own = [robot.axes[axis.name] for axis in axes]
        self.names = tuple(axis.name for axis in axes)
        self.step = np.array([axis.step for axis in axes])
        self.stepper = np.array([isinstance(axis, StepperAxis) for axis in own])
        self.looped = tuple(loop is not None for loop in plant.loops)
        low, high = np.array([axis.range for axis in own], dtype=np.float64).T
        self.low_switch = np.where(self.stepper, low - _OVERTRAVEL * (high - low), -np.inf)
        self.high_switch = np.where(self.stepper, high + _OVERTRAVEL * (high - low), np.inf)
        self.command_origin = np.zeros(len(own))
        self.reading_origin = np.zeros(len(own))
        self.position = np.array(position, dtype=np.float64)
        self.command = self.position.copy()
        self.previews: list[Preview] = []  # of each board, in the order of the axes
        self._frozen: dict[int, float] = {}
        self._pending: list[FloatArray] = []
        self._readings = (self.position + [axis.offset for axis in own])[None]
        self._first = 0  # the tick of the first of the readings

    @property
    def reading(self) -> FloatArray:
        """The latest readings (axes,), m or rad, as the sensors have them."""
        return np.asarray(self._readings[-1])

    def count_from_here(self, index: int, command: int, reading: int) -> None:
        """Call an axis' present command and reading so, in steps."""
        self.simulate()
        step = self.step[index]
        self.command_origin[index] = self.command[index] - command * step
        self.reading_origin[index] = self.reading[index] - reading * step

    def lose(self, index: int, steps: float) -> None:
        """Let an axis stay behind its command by so many steps, from the next tick on."""
        self.command_origin[index] -= steps * self.step[index]

    def freeze(self, index: int) -> None:
        """Freeze a sensor."""
        self.simulate()
        self._frozen[index] = float(self.reading[index])

    def thaw(self, index: int) -> None:
        """Release a frozen sensor."""
        self._frozen.pop(index, None)

    def set_effects(self, effects: tuple[AxisEffect, ...]) -> None:
        """Continue with other effects, from where the axes are and as fast as they are."""
        self.simulate()
        self._run.go_on_with(effects)

    def add(self, steps: FloatArray) -> None:
        """Let commands (ticks, axes), whole steps, act at the next ticks."""
        commands = self.command_origin + steps * self.step
        self._pending.append(commands)
        self.command = commands[-1]

    def simulate(self) -> None:
        """Bring readings and positions up to the latest tick.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        if not self._pending:
            return
        commands = np.concatenate(self._pending) if len(self._pending) > 1 else self._pending[0]
        self._pending.clear()
        response = self._run.advance(commands, self._expected)
        self.position = response.position[-1]
        readings = np.array(response.reading)
        for index, value in self._frozen.items():
            readings[:, index] = value
        kept = np.concatenate((self._readings, readings))
        left_out = max(len(kept) - max(_KEPT, len(readings)), 0)
        self._first += left_out
        self._readings = kept[left_out:]

    def _expected(self, ticks: int) -> FloatArray | None:
        parts = [preview(ticks) for preview in self.previews]
        known = [part for part in parts if part is not None]
        count = min((len(part) for part in known), default=0)
        if len(known) < len(parts) or not count:
            return None
        known = [part[:count] for part in known]
        return np.asarray(self.command_origin + np.concatenate(known, axis=1) * self.step)

    def readings(self, ticks: Sequence[int], indices: Sequence[int]) -> FloatArray:
        """Return the readings (ticks, indices) of late ticks, steps, rounded."""
        rows = np.asarray(ticks) - self._first
        counted = (self._readings - self.reading_origin) / self.step
        return np.asarray(np.rint(counted[np.ix_(rows, np.asarray(indices))]))

    def counted(self) -> FloatArray:
        """Return the latest readings (axes,), steps, rounded."""
        return np.asarray(np.rint((self.reading - self.reading_origin) / self.step))

    def closed(self, index: int) -> tuple[bool, bool]:
        """Return whether an axis is at its low and at its high limit switch."""
        at = self.position[index]
        return bool(at <= self.low_switch[index]), bool(at >= self.high_switch[index])

    def near_switch(self, index: int, margin: float) -> bool:
        """Return whether an axis, or where it is sent, is this near a switch; m or rad."""
        for at in (self.position[index], self.command[index]):
            if at - self.low_switch[index] < margin or self.high_switch[index] - at < margin:
                return True
        return False
