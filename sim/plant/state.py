"""The state of a run, with the samples whose inputs still act or will act."""

from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant import kernel


class Behind(IntEnum):
    """What the inputs of a run have passed already."""

    COMMAND = kernel.WHOLE
    AMPLIFIER = kernel.BEHIND_AMPLIFIER
    ACTUATOR = kernel.BEHIND_ACTUATOR


class Motion(NamedTuple):
    """Response at n samples of all axes of a plant, each (n, axes), in the plant's order.

    ``position`` m or rad as seen from outside, ``velocity`` of the axis itself, m/s or rad/s (zero
    for static axes), ``inputs`` V as the amplifier gives them, or the commanded position of a
    stepper, ``reading`` what the sensors say, offset included.
    """

    position: FloatArray
    velocity: FloatArray
    inputs: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PlantState:
    """The state of a run, with the samples whose inputs still act or will act.

    ``time_s`` (h,), and ``inputs`` (as asked for), ``position``, ``velocity``, ``reading``
    (h, axes) of the last h samples; the very last is the present. ``elapsed_s`` is the time since
    the run began; ``perturbation`` (axes,) is the Q that acts. ``x``, ``memory`` and ``seen`` are
    the states of the axes and of their effects.
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
    seen: FloatArray


class Stack(NamedTuple):
    """The rows of one call, those of the history first."""

    first: int
    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray

    @classmethod
    def of(cls, state: PlantState, history: int, time_s: FloatArray, inputs: FloatArray) -> Self:
        """Make room for the rows to come behind those of the history; take ``inputs`` over."""
        old = slice(0, history)
        return cls(
            history,
            np.concatenate([state.time_s[old], time_s]) if history else time_s,
            np.concatenate([state.inputs[old], inputs]) if history else inputs,
            _extended(state.position[old], len(time_s)),
            _extended(state.velocity[old], len(time_s)),
            _extended(state.reading[old], len(time_s)),
        )

    def taken(self, effort: FloatArray) -> kernel.Taken:
        """Return what the compiled loop fills in."""
        return kernel.Taken(self.inputs, effort, self.position, self.velocity, self.reading)


def _extended(history: FloatArray, rows: int) -> FloatArray:
    """Return room for ``rows`` more rows behind those of the history."""
    extended = np.empty((len(history) + rows, history.shape[1]))
    extended[: len(history)] = history
    return extended
