"""Commands of a run, and its state with the latest samples, whose inputs may still act later."""

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import kernel


class ChainPoint(IntEnum):
    """Point of the signal chain after which the inputs of a run enter."""

    COMMAND = kernel.WHOLE_CHAIN
    AMPLIFIER = kernel.AFTER_AMPLIFIER
    ACTUATOR = kernel.AFTER_ACTUATOR


class PlantMotion(NamedTuple):
    """Response at n samples of all axes of a plant, each (n, axes), in the plant's order.

    ``position``: m or rad, at the output of the axis, so after effects such as backlash.
    ``velocity``: of the axis before these effects, m/s or rad/s (zero for static axes). ``inputs``:
    V at the output of the amplifier, or the commanded position of a stepper. ``reading``: of the
    sensors, including their offset.
    """

    position: FloatArray
    velocity: FloatArray
    inputs: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PlantState:
    """State of a run, with the latest samples, whose inputs may still act after a delay.

    ``time_s`` (h,), and ``inputs`` (as requested), ``position``, ``velocity``, ``reading`` (h,
    axes) are those of the last h samples, up to and including the current one. ``elapsed_s`` is the
    time since the run began. ``perturbation`` (axes,) is the present acceleration Q of the base
    (:mod:`rotemina.sim.plant.perturbation`). ``x`` holds the states of the axes, ``memory`` those
    of the effects, and ``called_s`` the time of the last call of each effect
    (:class:`rotemina.sim.plant.KernelState`).
    """

    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray
    elapsed_s: float
    perturbation: FloatArray
    x: FloatArray
    memory: FloatArray
    called_s: FloatArray


class SampleRows(NamedTuple):
    """Sample rows of one call of ``Plant.advance``: the history, then the new samples.

    ``first_new_row`` is the number of rows of the history.
    """

    first_new_row: int
    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray

    @classmethod
    def of(
        cls, state: PlantState, history_count: int, time_s: FloatArray, inputs: FloatArray
    ) -> Self:
        """Copy ``inputs`` into new rows after the first ``history_count`` samples of a state."""
        history_rows = slice(0, history_count)
        return cls(
            history_count,
            np.concatenate([state.time_s[history_rows], time_s]) if history_count else time_s,
            np.concatenate([state.inputs[history_rows], inputs]) if history_count else inputs,
            _extend_rows(state.position[history_rows], len(time_s)),
            _extend_rows(state.velocity[history_rows], len(time_s)),
            _extend_rows(state.reading[history_rows], len(time_s)),
        )

    def to_kernel_samples(self, effort: FloatArray) -> kernel.KernelSamples:
        """Return the rows as the arrays that the compiled loop fills.

        ``effort`` receives the inputs after the effects of the electronics.
        """
        return kernel.KernelSamples(self.inputs, effort, self.position, self.velocity, self.reading)


def _extend_rows(history: FloatArray, rows: int) -> FloatArray:
    extended = np.empty((len(history) + rows, history.shape[1]))
    extended[: len(history)] = history
    return extended


class RunCommands(NamedTuple):
    """Commands of a run at the sample times ``time_s`` (n,).

    Each (n, axes): set-points ``command``, voltages ``add`` that are added to the outputs of the
    controllers, and ``inputs`` of the axes without a closed loop.
    """

    time_s: FloatArray
    command: FloatArray
    add: FloatArray
    inputs: FloatArray
