"""The loop around one axis, compiled: the plant's own step and the controller in turn."""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback.kernel import ASKED, OUTPUT, control
from rotemina.sim.plant.kernel import Given, State, Steps, Taken, run
from rotemina.sim.plant.machine import Machine


class Loop(NamedTuple):
    """Where the loop sits: ``per_asked`` is the input for a position that is asked for."""

    column: int
    per_asked: float
    offset: float
    delay: int


class Rows(NamedTuple):
    """What a run fills in: all (n + 1, axes), row 0 being the rest before it."""

    time_s: FloatArray
    inputs: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray


@numba.njit(cache=True, nogil=True, error_model="numpy")
def follow(
    machine: Machine, steps: Steps, moving: State, rows: Rows, variates: FloatArray, loop: Loop,
    numbers: FloatArray, memory: FloatArray, reference: FloatArray, feed: FloatArray,
    output: FloatArray,
) -> int:  # fmt: skip
    """Follow a reference (n,) and return how many samples a limit cut off.

    ``output`` (n,) is filled with what the controller asks for. ``steps`` go from a row to the
    next, so the plant is stepped as a live one is. An output acts ``delay`` rows late.
    """
    axes = rows.inputs.shape[1]
    none, command = np.zeros((0, axes)), np.zeros((1, axes))
    no_kick, column, limited = np.zeros((0, 0)), loop.column, 0
    at_rest = rows.inputs[0, column]
    for k in range(reference.shape[0]):
        rows.inputs[k + 1] = rows.inputs[k]
        if loop.delay > 0:
            since = k - 1 - loop.delay
            rows.inputs[k, column] = output[since] * loop.per_asked if since >= 0 else at_rest
            rows.inputs[k + 1, column] = rows.inputs[k, column]
        window = slice(k, k + 2)
        given = Given(
            1, rows.time_s[window], command, none, none, no_kick,
            variates[k : k + 1] if variates.shape[0] > 0 else variates,
        )  # fmt: skip
        taken = Taken(
            rows.inputs[window], none, rows.position[window], rows.velocity[window],
            rows.reading[window],
        )  # fmt: skip
        run(machine, steps, given, taken, moving, rows.time_s[k])
        error = reference[k] - (rows.reading[k + 1, column] - loop.offset)
        output[k] = control(numbers, memory, error, feed[k])
        limited += memory[OUTPUT] != memory[ASKED]
        if loop.delay == 0:
            rows.inputs[k + 1, column] = output[k] * loop.per_asked
    return limited
