"""Loops around axes, compiled: alternating steps of plant and controllers."""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.feedback.controller_kernel import (
    MAX_PLAUSIBLE_ERROR,
    OUTPUT,
    UNLIMITED_OUTPUT,
    control,
)
from rotemina.sim.plant import (
    KernelInputs,
    KernelSamples,
    KernelState,
    KernelSteps,
    PlantTables,
    run,
)


class LoopArrays(NamedTuple):
    """Arrays of l loops and their controllers, (l,) each unless stated otherwise.

    Attributes
    ----------
    column : column of the axis.
    input_per_output : input of the plant per output of the controller.
    offset : offset of the sensor.
    delay : number of rows by which the output is delayed.
    numbers : (l, NUMBER_COUNT) parameters of the controllers.
    memory : (l, MEMORY_COUNT) states of the controllers, which are updated.
    """

    column: IntArray
    input_per_output: FloatArray
    offset: FloatArray
    delay: IntArray
    numbers: FloatArray
    memory: FloatArray


class RunArrays(NamedTuple):
    """Arrays that a run fills, all (n + 1, axes); row 0 is the state before the run.

    The ``inputs`` of axes without a loop are given. ``effort`` is the output of the amplifiers and
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
    tables: PlantTables, steps: KernelSteps, kernel_state: KernelState, rows: RunArrays,
    command: FloatArray, variates: FloatArray, loops: LoopArrays, reference: FloatArray,
    feed: FloatArray, output: FloatArray,
) -> int:  # fmt: skip
    """Let axes follow references (n, l); return the number of outputs that a limit cut off.

    ``output`` (n, l) receives the outputs of the controllers. ``command`` (n, axes) is for the
    robot's own controllers. ``steps`` lead from one row to the next, so the plant is stepped as in
    live operation. A controller keeps its state if its reading or reference is not finite, or if
    their difference is implausibly large.
    """
    axis_count, loop_count = rows.inputs.shape[1], loops.column.shape[0]
    no_rows, no_kick, limited_count = np.zeros((0, axis_count)), np.zeros((0, 0)), 0
    rest_inputs = np.empty(loop_count)
    for i in range(loop_count):
        rest_inputs[i] = rows.inputs[0, loops.column[i]]
    for k in range(reference.shape[0]):
        for i in range(loop_count):
            column = loops.column[i]
            rows.inputs[k + 1, column] = rows.inputs[k, column]
            if loops.delay[i] > 0:
                row = k - 1 - loops.delay[i]
                delayed_input = (
                    output[row, i] * loops.input_per_output[i] if row >= 0 else rest_inputs[i]
                )
                rows.inputs[k, column] = rows.inputs[k + 1, column] = delayed_input
        window = slice(k, k + 2)
        segment = KernelInputs(
            1, rows.time_s[window], command[k : k + 1], no_rows, no_rows, no_kick,
            variates[k : k + 1] if variates.shape[0] > 0 else variates,
        )  # fmt: skip
        samples = KernelSamples(
            rows.inputs[window], rows.effort[window] if rows.effort.shape[0] > 0 else rows.effort,
            rows.position[window], rows.velocity[window], rows.reading[window],
        )  # fmt: skip
        run(tables, steps, segment, samples, kernel_state, rows.time_s[k])
        for i in range(loop_count):
            column, memory = loops.column[i], loops.memory[i]
            error = reference[k, i] - (rows.reading[k + 1, column] - loops.offset[i])
            # The comparison also excludes an error that is not a number.
            if abs(error) <= loops.numbers[i, MAX_PLAUSIBLE_ERROR] and np.isfinite(feed[k, i]):
                output[k, i] = control(loops.numbers[i], memory, error, feed[k, i])
                limited_count += memory[OUTPUT] != memory[UNLIMITED_OUTPUT]
            else:
                output[k, i] = memory[OUTPUT]
            if loops.delay[i] == 0:
                rows.inputs[k + 1, column] = output[k, i] * loops.input_per_output[i]
    return limited_count
