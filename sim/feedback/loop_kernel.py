"""Loops around axes, compiled: alternating steps of plant and controllers."""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.feedback.controller_kernel import ASKED, BELIEVED, OUTPUT, control
from rotemina.sim.plant.kernel import Given, State, Steps, Taken, run
from rotemina.sim.plant.plant_arrays import Machine


class Loops(NamedTuple):
    """Where l loops sit, (l,) each, and their controllers.

    ``column`` of the axis; ``per_asked`` is the input for a position that is requested, ``offset``
    the sensor's, ``delay`` by how many rows an output acts late. ``numbers`` (l, NUMBERS) and
    ``memory`` (l, MEMORY) are the controllers'; the memory continues.
    """

    column: IntArray
    per_asked: FloatArray
    offset: FloatArray
    delay: IntArray
    numbers: FloatArray
    memory: FloatArray


class Rows(NamedTuple):
    """What a run fills in: all (n + 1, axes), row 0 being what was before it.

    ``inputs`` of axes without a loop are given, and ``effort``, what the amplifiers make of them,
    may have no rows.
    """

    time_s: FloatArray
    inputs: FloatArray
    effort: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray


@numba.njit(cache=True, nogil=True, error_model="numpy")
def follow(
    machine: Machine, steps: Steps, moving: State, rows: Rows, command: FloatArray,
    variates: FloatArray, loops: Loops, reference: FloatArray, feed: FloatArray,
    output: FloatArray,
) -> int:  # fmt: skip
    """Let axes follow references (n, l) and return how many samples a limit cut off.

    ``output`` (n, l) is filled with what the controllers ask for; ``command`` (n, axes) is of the
    robot's own controllers. ``steps`` go from a row to the next, so the plant is stepped as a live
    one is. A reading or reference that is not finite, or farther apart than is believed, leaves a
    controller as it was.
    """
    axes, count = rows.inputs.shape[1], loops.column.shape[0]
    none, no_kick, limited = np.zeros((0, axes)), np.zeros((0, 0)), 0
    at_rest = np.empty(count)
    for i in range(count):
        at_rest[i] = rows.inputs[0, loops.column[i]]
    for k in range(reference.shape[0]):
        for i in range(count):
            column = loops.column[i]
            rows.inputs[k + 1, column] = rows.inputs[k, column]
            if loops.delay[i] > 0:
                since = k - 1 - loops.delay[i]
                late = output[since, i] * loops.per_asked[i] if since >= 0 else at_rest[i]
                rows.inputs[k, column] = rows.inputs[k + 1, column] = late
        window = slice(k, k + 2)
        given = Given(
            1, rows.time_s[window], command[k : k + 1], none, none, no_kick,
            variates[k : k + 1] if variates.shape[0] > 0 else variates,
        )  # fmt: skip
        taken = Taken(
            rows.inputs[window], rows.effort[window] if rows.effort.shape[0] > 0 else rows.effort,
            rows.position[window], rows.velocity[window], rows.reading[window],
        )  # fmt: skip
        run(machine, steps, given, taken, moving, rows.time_s[k])
        for i in range(count):
            column, memory = loops.column[i], loops.memory[i]
            error = reference[k, i] - (rows.reading[k + 1, column] - loops.offset[i])
            # An error that is no number is not believed either.
            if abs(error) <= loops.numbers[i, BELIEVED] and np.isfinite(feed[k, i]):
                output[k, i] = control(loops.numbers[i], memory, error, feed[k, i])
                limited += memory[OUTPUT] != memory[ASKED]
            else:
                output[k, i] = memory[OUTPUT]
            if loops.delay[i] == 0:
                rows.inputs[k + 1, column] = output[k, i] * loops.per_asked[i]
    return limited
