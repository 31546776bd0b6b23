"""A machine: its axes, their linear mechanics, and its additions."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple
from zlib import crc32

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second import effects
from rotemina.sim.blind_second.dynamics import moved
from rotemina.sim.blind_second.effects import Added
from rotemina.sim.blind_second.machine_axis import AxisFacts, Grid

_FINE_S = 1e-4
_LEAD_S = 1.0  # for the way to the first command


class Motion(NamedTuple):
    """What is requested: ``values`` (n, m), SI, one row every ``step_s``, held until the next."""

    step_s: float
    values: FloatArray


class Taps(NamedTuple):
    """What shows at the samples (n, m): output of the amplifiers, motion, reading; SI positions."""

    drive: FloatArray
    motion: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Machine:
    """Axes that move together; ``mass``, ``damping``, ``stiffness`` with those that ride along."""

    axes: tuple[AxisFacts, ...]
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    added: tuple[Added, ...] = ()

    def having(self, added: Sequence[Added]) -> "Machine":
        """Return the machine with this added to it."""
        return replace(self, added=tuple(added))

    def run(self, asked: Motion, chance: int) -> Taps:
        """Run over a motion, after a rise to its first row, and return what shows."""
        every = max(round(asked.step_s / _FINE_S), 1)
        grid = Grid(round(_LEAD_S / asked.step_s) * every, every, asked.step_s / every)
        values = np.repeat(asked.values, every, axis=0)
        ways = np.array([0.1 * axis.way for axis in self.axes])
        share = np.minimum(np.arange(grid.lead) / (0.6 * grid.lead), 1.0)
        rise = values[0] - ways * (1.0 - share**2 * (3.0 - 2.0 * share))[:, None]
        values = np.concatenate([rise, values])
        drive = self._through(effects.DRIVE, values, values, grid, chance)
        targets = self._through(effects.ACTUATOR, drive, drive, grid, chance)
        motion = self._moved(targets, grid, chance)
        motion = self._through(effects.MOTION, motion, motion, grid, chance)
        rows = slice(grid.lead, None, every)
        reading = self._through(effects.SENSOR, motion, motion, grid, chance)[rows]
        reading = self._through(effects.SAMPLED, reading, motion, grid, chance)
        return Taps(drive[rows], motion[rows], reading)

    def _through(
        self, place: int, values: FloatArray, motion: FloatArray, grid: Grid, chance: int
    ) -> FloatArray:
        out = values.copy()
        for one in self.added:
            if one.place == place:
                rng = np.random.default_rng((chance, crc32(one.effect.encode())))
                i = one.axis.index
                out[:, i] = one.act(out[:, i].copy(), motion, grid, rng, one.size)
        return out

    def _moved(self, targets: FloatArray, grid: Grid, chance: int) -> FloatArray:
        stiffness, table = self.stiffness.copy(), np.zeros((len(self.axes), 6))
        none = np.zeros(0)
        for one in self.added:
            rng = np.random.default_rng((chance, crc32(one.effect.encode())))
            if one.place == effects.FORCE:
                table[one.axis.index] = one.act(none, targets, grid, rng, one.size)
            elif one.place == effects.SPRING:
                i = one.axis.index
                stiffness[i, i] *= float(one.act(none, targets, grid, rng, one.size)[0])
        return moved(self.mass, self.damping, stiffness, targets, grid.step_s, table)
