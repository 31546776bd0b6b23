"""A machine of the second generator: its axes, their linear mechanics, and its effects."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple
from zlib import crc32

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind_second import effects
from rotemina.sim.blind_second.dynamics import simulate_motion
from rotemina.sim.blind_second.effects import AddedEffect
from rotemina.sim.blind_second.machine_axis import FineTimeGrid, SecondAxis

# Approximate step of the fine grid on which the machine is simulated.
_FINE_STEP_S = 1e-4
# Time before the record, in which the axes rise to the first command and settle.
_LEAD_S = 1.0


class SecondMotion(NamedTuple):
    """Requested positions ``values`` (n, m), SI, one row every ``step_s``, held until the next."""

    step_s: float
    values: FloatArray


class SampledTaps(NamedTuple):
    """Amplifier output, true motion and reading at the samples, each (n, m), positions in SI."""

    drive: FloatArray
    motion: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class SecondMachine:
    """Axes that move together, with their effects.

    ``mass``, ``damping`` and ``stiffness`` also include the passive axes that are coupled to these.
    """

    axes: tuple[SecondAxis, ...]
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    added: tuple[AddedEffect, ...] = ()

    def with_effects(self, added: Sequence[AddedEffect]) -> "SecondMachine":
        """Return a copy of the machine with other effects."""
        return replace(self, added=tuple(added))

    def run(self, requested: SecondMotion, seed: int) -> SampledTaps:
        """Simulate the machine over a motion and return its taps.

        Before the record, the axes rise to the first row and settle.
        """
        substeps = max(round(requested.step_s / _FINE_STEP_S), 1)
        grid = FineTimeGrid(
            round(_LEAD_S / requested.step_s) * substeps, substeps, requested.step_s / substeps
        )
        values = np.repeat(requested.values, substeps, axis=0)
        rise_lengths = np.array([0.1 * axis.travel for axis in self.axes])
        progress = np.minimum(np.arange(grid.lead_rows) / (0.6 * grid.lead_rows), 1.0)
        rise = values[0] - rise_lengths * (1.0 - progress**2 * (3.0 - 2.0 * progress))[:, None]
        values = np.concatenate([rise, values])
        drive = self._apply_effects(effects.DRIVE, values, values, grid, seed)
        targets = self._apply_effects(effects.ACTUATOR, drive, drive, grid, seed)
        motion = self._simulate_motion(targets, grid, seed)
        motion = self._apply_effects(effects.MOTION, motion, motion, grid, seed)
        rows = slice(grid.lead_rows, None, substeps)
        reading = self._apply_effects(effects.SENSOR, motion, motion, grid, seed)[rows]
        reading = self._apply_effects(effects.SAMPLED, reading, motion, grid, seed)
        return SampledTaps(drive[rows], motion[rows], reading)

    def _apply_effects(
        self, place: int, values: FloatArray, motion: FloatArray, grid: FineTimeGrid, seed: int
    ) -> FloatArray:
        out = values.copy()
        for effect in self.added:
            if effect.place == place:
                rng = np.random.default_rng((seed, crc32(effect.effect.encode())))
                i = effect.axis.index
                out[:, i] = effect.act(out[:, i].copy(), motion, grid, rng, effect.size)
        return out

    def _simulate_motion(self, targets: FloatArray, grid: FineTimeGrid, seed: int) -> FloatArray:
        stiffness, table = self.stiffness.copy(), np.zeros((len(self.axes), 6))
        empty = np.zeros(0)
        for effect in self.added:
            rng = np.random.default_rng((seed, crc32(effect.effect.encode())))
            if effect.place == effects.FORCE:
                table[effect.axis.index] = effect.act(empty, targets, grid, rng, effect.size)
            elif effect.place == effects.SPRING:
                i = effect.axis.index
                stiffness[i, i] *= float(effect.act(empty, targets, grid, rng, effect.size)[0])
        return simulate_motion(self.mass, self.damping, stiffness, targets, grid.step_s, table)
