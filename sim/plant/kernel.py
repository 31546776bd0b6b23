"""The sequential inner loop: exact linear steps with sampled controllers in between."""

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

# How a loop obtains its speed.
NO_LOOP, STATE_VELOCITY, BACKWARD_VELOCITY = 0, 1, 2


@numba.njit(cache=True)
def run(
    state_step: FloatArray,
    input_step: FloatArray,
    step: IntArray,
    sample: IntArray,
    applied: IntArray,
    time_s: FloatArray,
    command: FloatArray,
    add: FloatArray,
    loop: IntArray,
    gains: FloatArray,
    inputs: FloatArray,
    states: FloatArray,
    x: FloatArray,
) -> None:
    """Step one group through all segments; fills ``inputs`` and ``states``, and moves ``x``.

    Parameters
    ----------
    state_step, input_step : (k, 2m, 2m), (k, 2m, m + 1)
    step, sample, applied : (s,), (s,), (s, m)
        See :class:`rotemina.sim.plant.sampling.Segments`.
    time_s : (n,)
    command, add : (n, m)
        Set-points, and what is added to the controllers' outputs, V.
    loop : (m,)
        ``NO_LOOP``, ``STATE_VELOCITY`` or ``BACKWARD_VELOCITY`` per axis.
    gains : (m, 3)
        ``kp``, ``kv``, ``limit`` per axis.
    inputs : (n, m)
        Given for axes without a loop, computed here for the others.
    states : (n, 2m)
        State at each sample, before its command acts; rows of history are given.
    x : (2m,)
        State at the start; afterwards the state at the last sample.
    """
    axes = loop.shape[0]
    order = x.shape[0]
    fresh = np.empty(order)
    for s in range(step.shape[0]):
        k = sample[s]
        if k >= 0:
            states[k, :] = x
            for i in range(axes):
                if loop[i] != NO_LOOP:
                    speed = x[axes + i]
                    if loop[i] == BACKWARD_VELOCITY and k > 0:
                        speed = (x[i] - states[k - 1, i]) / (time_s[k] - time_s[k - 1])
                    effort = gains[i, 1] * (gains[i, 0] * (command[k, i] - x[i]) - speed)
                    effort += add[k, i]
                    inputs[k, i] = min(max(effort, -gains[i, 2]), gains[i, 2])
        j = step[s]
        for row in range(order):
            total = input_step[j, row, axes]
            for column in range(order):
                total += state_step[j, row, column] * x[column]
            for i in range(axes):
                total += input_step[j, row, i] * inputs[applied[s, i], i]
            fresh[row] = total
        x[:] = fresh
