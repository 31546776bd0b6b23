"""The sequential inner loop: exact linear steps with sampled controllers in between."""

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

# How a loop obtains its speed.
NO_LOOP, STATE_VELOCITY, BACKWARD_VELOCITY = 0, 1, 2


@numba.njit(cache=True, inline="always")
def _effort(gains: FloatArray, error: float, speed: float, add: float) -> float:
    """Return the output of a cascade controller, V."""
    effort = gains[1] * (gains[0] * error - speed) + add
    return float(min(max(effort, -gains[2]), gains[2]))


# The error model is numpy's because a check for division by zero at every sample costs a third
# of the time; sample times increase, so there is none.
@numba.njit(cache=True, error_model="numpy")
def run(
    state_step: FloatArray,
    input_step: FloatArray,
    step: IntArray,
    sample: IntArray,
    applied: IntArray,
    late: IntArray,
    columns: IntArray,
    first: int,
    time_s: FloatArray,
    command: FloatArray,
    add: FloatArray,
    loop: IntArray,
    gains: FloatArray,
    inputs: FloatArray,
    position: FloatArray,
    velocity: FloatArray,
    x: FloatArray,
) -> None:
    """Step one group through all segments.

    Fills the group's columns of ``inputs`` (where a loop is closed), ``position`` and
    ``velocity``, and moves ``x``.

    Parameters
    ----------
    state_step, input_step : (k, 2m, 2m), (k, 2m, m + 1)
    step, sample, applied : (s,), (s,), (s, d)
        See :class:`rotemina.sim.plant.sampling.Segments`.
    late : (m,)
        Which column of ``applied``, that is which delay, holds for each axis.
    columns : (m,)
        Where the group's axes stand in the (n, axes) arrays.
    first : int
        The sample to which the first row of ``command`` belongs.
    time_s : (n,)
    command, add : (n - first, axes)
        Set-points, and what is added to the controllers' outputs, V; ``add`` may have no rows.
    loop : (m,)
        ``NO_LOOP``, ``STATE_VELOCITY`` or ``BACKWARD_VELOCITY`` per axis.
    gains : (m, 3)
        ``kp``, ``kv``, ``limit`` per axis.
    inputs, position, velocity : (n, axes)
        The state at each sample is the one before its command acts; rows of history are given.
    x : (2m,)
        State at the start; afterwards the state at the last sample.
    """
    axes = loop.shape[0]
    order = x.shape[0]
    fresh = np.empty(order)
    for s in range(step.shape[0]):
        k = sample[s]
        if k >= 0:
            for i in range(axes):
                position[k, columns[i]] = x[i]
                velocity[k, columns[i]] = x[axes + i]
                if loop[i] != NO_LOOP:
                    c = columns[i]
                    speed = x[axes + i]
                    if loop[i] == BACKWARD_VELOCITY and k > 0:
                        speed = (x[i] - position[k - 1, c]) / (time_s[k] - time_s[k - 1])
                    extra = add[k - first, c] if add.shape[0] > 0 else 0.0
                    inputs[k, c] = _effort(gains[i], command[k - first, c] - x[i], speed, extra)
        j = step[s]
        for row in range(order):
            # Inputs first: they do not wait for the step before, so the processor can run ahead.
            total = input_step[j, row, axes]
            for i in range(axes):
                total += input_step[j, row, i] * inputs[applied[s, late[i]], columns[i]]
            for column in range(order):
                total += state_step[j, row, column] * x[column]
            fresh[row] = total
        for row in range(order):
            x[row] = fresh[row]
