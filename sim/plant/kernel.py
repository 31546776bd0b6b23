"""Sequential inner loop: exact linear steps, with effects and controllers in between.

The functions use numpy's error model, because a check for division by zero at every sample costs a
third of the time. Sample times increase, so no such division occurs.
"""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects import call_step
from rotemina.sim.plant.indexing import item
from rotemina.sim.plant.plant_arrays import PlantTables, TableArray

# How a controller obtains the speed.
NO_LOOP, STATE_VELOCITY, BACKWARD_VELOCITY = 0, 1, 2

# Which part of the chain before the mechanics acts on the inputs.
WHOLE_CHAIN, AFTER_AMPLIFIER, AFTER_ACTUATOR = 0, 1, 2

# An input that is held for this long brings every time-dependent memory to rest.
_INITIAL_HOLD_S = 1e9
# Steps of the rise from the low end of the range.
_RISE_STEP_COUNT = 256
# With more step lengths, the matrices are not searched for zeros.
_MAX_BANDED_LENGTHS = 16
# A state is at rest if it changes by less than this, relative to its largest value in the hold.
_STILL_CHANGE_RATIO = 1e-13
# It must be at rest for this many steps: more than a period, because a motion stands still where
# it turns.
_STILL_STEP_COUNT = 64


class KernelSteps(NamedTuple):
    """Steps through the segments of a run.

    The segments are those of :class:`rotemina.sim.plant.zero_order_hold.RunSegments`.
    Each of the k lengths is done in ``parts`` (k,) steps of ``length_s`` (k,). The matrices of
    group g begin at ``state_at[g]`` and ``input_at[g]`` of the flat arrays, k of them in sequence.
    ``hold_s`` (s, d): how long each applied input continues to act.
    """

    step: IntArray
    sample: IntArray
    applied: IntArray
    hold_s: FloatArray
    length_s: FloatArray
    parts: IntArray
    state: FloatArray
    state_at: IntArray
    input: FloatArray
    input_at: IntArray


class KernelInputs(NamedTuple):
    """Inputs of a run: rows from sample ``first`` on, but all n samples in ``time_s`` (n,).

    ``time_s`` counts from the start of the run. ``command`` and ``add`` (n − first, axes):
    set-points, and voltages that are added to the outputs of the controllers. ``kick``
    (n − first, states): jumps of the state. ``force`` (n − first + 1, axes): forces that act during
    a row; the first row is that of the sample before ``first``. ``variates`` (n − first, ...):
    those of the random effects, then those of every axis' declared sensor. All but ``command`` may
    have no rows.
    """

    first: int
    time_s: FloatArray
    command: FloatArray
    add: FloatArray
    force: FloatArray
    kick: FloatArray
    variates: FloatArray


class KernelSamples(NamedTuple):
    """Samples that a run fills in, all (n, axes); rows before the first sample are given.

    ``inputs`` as requested (given for axes without a controller), ``effort``: the inputs after the
    electronics (may have no rows), ``position`` as observed, ``velocity``, ``reading``.
    """

    inputs: FloatArray
    effort: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray


class KernelState(NamedTuple):
    """State that a run changes.

    ``x``: the states. ``memory``: that of the effects. ``called_s``: time of the last call of each
    effect.
    """

    x: FloatArray
    memory: FloatArray
    called_s: FloatArray


@numba.njit(cache=True, error_model="numpy", inline="always")
def _apply_functions(
    function: TableArray, numbers: FloatArray, memory: FloatArray, begin: int, end: int,
    x: float, position: float, t: float, h: float,
) -> float:  # fmt: skip
    for e in range(begin, end):
        entry = function[e]
        x = call_step(
            entry.address,
            x,
            position,
            t,
            h,
            0.0,
            0.0,
            numbers,
            entry.numbers_at,
            memory,
            entry.memory_at,
        )
    return x


@numba.njit(cache=True, error_model="numpy", inline="always")
def _apply_input_effects(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray, i: int,
    u: float, position: float, t: float, h: float,
) -> float:  # fmt: skip
    """Return the input that, without effects on it, gives the same motion of axis i."""
    entry = axis[i]
    if entry.part == WHOLE_CHAIN:
        u = _apply_functions(
            function, numbers, memory, entry.electronics, entry.actuator, u, position, t, h
        )
    if entry.part == AFTER_ACTUATOR or entry.actuator == entry.force:
        return u
    w = entry.asked * u
    w = _apply_functions(function, numbers, memory, entry.actuator, entry.force, w, position, t, h)
    return float(w / entry.asked)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _compute_outputs(
    output: TableArray, state: IntArray, weight: FloatArray, x: FloatArray, u: FloatArray,
    raw_q: FloatArray,
) -> None:  # fmt: skip
    """Fill in ``raw_q``: the positions of all axes and the outputs to ports, without effects."""
    for o in range(output.shape[0]):
        entry = output[o]
        total = entry.through * u[entry.source] if entry.through != 0.0 else 0.0
        for term in range(entry.begin, entry.end):
            total += item(weight, term) * item(x, item(state, term))
        raw_q[o] = total


@numba.njit(cache=True, error_model="numpy")
def _compute_position(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray,
    called_s: FloatArray, i: int, raw_q: FloatArray, t: float,
) -> float:  # fmt: skip
    q: float = raw_q[i]
    for e in range(axis[i].motion, axis[i].reading):
        entry = function[e]
        other = raw_q[entry.other] if entry.other >= 0 else 0.0
        q = call_step(
            entry.address, q, other, t, t - called_s[e], 0.0, 0.0,
            numbers, entry.numbers_at, memory, entry.memory_at,
        )  # fmt: skip
        called_s[e] = t
    return q


@numba.njit(cache=True, error_model="numpy")
def _apply_reading_effects(
    function: TableArray, numbers: FloatArray, memory: FloatArray,
    called_s: FloatArray, begin: int, end: int, y: float, q: float, t: float, row: int,
    variates: FloatArray,
) -> float:  # fmt: skip
    """Pass a reading y of the position q through the step functions from ``begin`` to ``end``.

    ``row`` < 0 means between samples, where random effects are not called.
    """
    for e in range(begin, end):
        entry = function[e]
        variate = 0.0
        if entry.variate >= 0:
            if row < 0:
                continue
            if variates.shape[0] > 0:
                variate = variates[row, entry.variate]
        y = call_step(
            entry.address, y, q, t, t - called_s[e], variate, 0.0,
            numbers, entry.numbers_at, memory, entry.memory_at,
        )  # fmt: skip
        called_s[e] = t
    return y


@numba.njit(cache=True, error_model="numpy")
def _add_sensor_noise(axis: TableArray, i: int, y: float, row: int, variates: FloatArray) -> float:
    entry = axis[i]
    y += entry.noise_rms * variates[row, variates.shape[1] - axis.shape[0] + i]
    if entry.resolution > 0.0:
        y = np.rint(y / entry.resolution) * entry.resolution
    return y


@numba.njit(cache=True, error_model="numpy")
def _compute_effort(
    axis: TableArray, i: int, command: float, reading: float, speed: float, add: float
) -> float:
    """Return the output of a cascade controller, V."""
    entry = axis[i]
    effort = entry.kv * (entry.kp * (command - reading) - speed) + add
    return float(min(max(effort, -entry.limit), entry.limit))


@numba.njit(cache=True, error_model="numpy", inline="always")
def _apply_forces(
    tables: PlantTables, kernel_state: KernelState, g: int, gamma: FloatArray, gamma_at: int,
    t: float, h: float, next_x: FloatArray,
) -> None:  # fmt: skip
    """Apply the forces of effects to the states of group g, which were stepped without them."""
    axis, function, numbers, _, _, _, group, member = tables
    x, memory, _ = kernel_state
    first, n, m = group[g].first, group[g].states, group[g].axes
    row_length = 2 * m + 1
    for c in range(m):
        i = member[group[g].member + c]
        column = gamma_at + m + 1 + c
        place, rate = axis[i].place, axis[i].rate
        for e in range(axis[i].force, axis[i].motion):
            entry = function[e]
            force = call_step(
                entry.address, 0.5 * (x[place] + next_x[place]), next_x[rate], t, h,
                gamma[column + (place - first) * row_length],
                gamma[column + (rate - first) * row_length],
                numbers, entry.numbers_at, memory, entry.memory_at,
            )  # fmt: skip
            for row in range(n):
                next_x[first + row] += item(gamma, column + row * row_length) * force


@numba.njit(cache=True, error_model="numpy", inline="always")
def _step_group(
    group: TableArray, member: IntArray, g: int, phi: FloatArray, phi_at: int,
    gamma: FloatArray, gamma_at: int, band: IntArray, u: FloatArray, force: FloatArray,
    x: FloatArray, next_x: FloatArray,
) -> None:  # fmt: skip
    """Step the states of group g exactly: ``x ← Φ x + Γ [u, 1, force]``.

    Its matrices begin at ``phi_at`` and ``gamma_at``.
    """
    first, n, m, begin = group[g].first, group[g].states, group[g].axes, group[g].member
    # A single axis, unrolled: the overhead of such a short loop exceeds its work.
    if n == 2 and force.shape[0] == 0:
        q, v, drive = x[first], x[first + 1], u[member[begin]]
        next_x[first] = (
            gamma[gamma_at] * drive + gamma[gamma_at + 1] + phi[phi_at] * q + phi[phi_at + 1] * v
        )
        gamma_at, phi_at = gamma_at + 3, phi_at + 2
        next_x[first + 1] = (
            gamma[gamma_at] * drive + gamma[gamma_at + 1] + phi[phi_at] * q + phi[phi_at + 1] * v
        )
        n = 0
    elif n == 4 and m == 2 and force.shape[0] == 0:
        # Two coupled axes, also unrolled.
        q1, q2, v1, v2 = x[first], x[first + 1], x[first + 2], x[first + 3]
        drive, other = u[member[begin]], u[member[begin + 1]]
        for row in range(4):
            total = gamma[gamma_at] * drive + gamma[gamma_at + 1] * other + gamma[gamma_at + 2]
            total += phi[phi_at] * q1 + phi[phi_at + 1] * q2
            next_x[first + row] = total + phi[phi_at + 2] * v1 + phi[phi_at + 3] * v2
            gamma_at, phi_at = gamma_at + 5, phi_at + 4
        n = 0
    for row in range(n):
        # Inputs come first: they do not need the previous step, so the processor can run ahead.
        row_begin = gamma_at + row * (2 * m + 1)
        total = item(gamma, row_begin + m)
        for c in range(m):
            total += item(gamma, row_begin + c) * item(u, item(member, begin + c))
        if force.shape[0] > 0:
            for c in range(m):
                total += item(gamma, row_begin + m + 1 + c) * item(force, item(member, begin + c))
        row_begin = phi_at + row * n
        for c in range(band[first + row, 0], band[first + row, 1]):
            total += item(phi, row_begin + c) * item(x, first + c)
        next_x[first + row] = total


@numba.njit(cache=True, error_model="numpy")
def _find_bands(
    group: TableArray, phi: FloatArray, state_at: IntArray, lengths: int, states: int
) -> IntArray:
    """Return the columns (states, 2), first and end, in which the step of each state has entries.

    Uncoupled modes have only two each. With many step lengths all columns are taken.
    """
    band = np.zeros((states, 2), dtype=np.int64)
    for g in range(group.shape[0]):
        first, n = group[g].first, group[g].states
        for row in range(n):
            low, high = n, 0
            for j in range(lengths if lengths <= _MAX_BANDED_LENGTHS else 0):
                for c in range(n):
                    if phi[state_at[g] + (j * n + row) * n + c] != 0.0:
                        low, high = min(low, c), max(high, c + 1)
            if lengths > _MAX_BANDED_LENGTHS:
                low, high = 0, n
            band[first + row, 0], band[first + row, 1] = low, high
    return band


@numba.njit(cache=True, error_model="numpy", inline="always")
def _take_sample(
    tables: PlantTables,
    run_inputs: KernelInputs,
    samples: KernelSamples,
    kernel_state: KernelState,
    raw_q: FloatArray,
    k: int,
) -> None:
    axis, function, numbers = tables.axis, tables.function, tables.numbers
    x, memory, called_s = kernel_state
    time_s, command, add, variates = (
        run_inputs.time_s,
        run_inputs.command,
        run_inputs.add,
        run_inputs.variates,
    )
    inputs, reading = samples.inputs, samples.reading
    t, row = time_s[k], k - run_inputs.first
    positions, velocities, readings = samples.position[k], samples.velocity[k], reading[k]
    for i in range(axis.shape[0]):
        entry = axis[i]
        q = y = raw_q[i]
        if entry.motion < entry.end:
            q = _compute_position(axis, function, numbers, memory, called_s, i, raw_q, t)
            y = _apply_reading_effects(
                function,
                numbers,
                memory,
                called_s,
                entry.reading,
                entry.digits,
                q,
                q,
                t,
                row,
                variates,
            )
        y += entry.offset
        if variates.shape[0] > 0:
            y = _add_sensor_noise(axis, i, y, row, variates)
        if entry.digits < entry.end:
            y = _apply_reading_effects(
                function, numbers, memory, called_s, entry.digits, entry.end, y, q, t, row, variates
            )
        positions[i] = q
        readings[i] = y
        speed = x[entry.rate] if entry.rate >= 0 else 0.0
        velocities[i] = speed
        if entry.loop != NO_LOOP:
            if entry.loop == BACKWARD_VELOCITY and k > 0:
                speed = (y - reading[k - 1, i]) / (time_s[k] - time_s[k - 1])
            added = add[row, i] if add.shape[0] > 0 else 0.0
            inputs[k, i] = _compute_effort(axis, i, command[row, i], y - entry.offset, speed, added)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _fill_amplifier_outputs(
    tables: PlantTables, memory: FloatArray, samples: KernelSamples, raw_q: FloatArray,
    applied: IntArray, t: float, k: int,
) -> None:  # fmt: skip
    """Fill in the amplifier outputs at this instant if they are requested.

    For an axis with a controller, it is the output of the controller before its delay.
    """
    if samples.effort.shape[0] == 0:
        return
    for i in range(tables.axis.shape[0]):
        entry = tables.axis[i]
        requested = samples.inputs[k if entry.loop != NO_LOOP else applied[entry.late], i]
        samples.effort[k, i] = _apply_functions(
            tables.function, tables.numbers, memory, entry.electronics, entry.actuator,
            requested, raw_q[i], t, 0.0,
        )  # fmt: skip


@numba.njit(cache=True, error_model="numpy")
def _compute_static_inputs(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray,
    raw_q: FloatArray, applied: IntArray, inputs: FloatArray, t: float, current_inputs: FloatArray,
) -> None:  # fmt: skip
    for i in range(axis.shape[0]):
        if axis[i].place < 0:
            requested = inputs[applied[axis[i].late], i]
            current_inputs[i] = _apply_input_effects(
                axis, function, numbers, memory, i, requested, raw_q[i], t, 0.0
            )


@numba.njit(cache=True, error_model="numpy", inline="always")
def _compute_held_inputs(
    tables: PlantTables, steps: KernelSteps, memory: FloatArray, raw_q: FloatArray, s: int,
    inputs: FloatArray, t: float, h: float, previous: IntArray, u: FloatArray,
) -> None:  # fmt: skip
    axis, function, numbers = tables.axis, tables.function, tables.numbers
    applied, hold_s = steps.applied, steps.hold_s
    undelayed_row = applied[s, 0]
    for i in range(axis.shape[0]):
        entry = axis[i]
        applied_row = undelayed_row if entry.late == 0 else applied[s, entry.late]
        if entry.electronics == entry.force:
            u[i] = inputs[applied_row, i]
        elif entry.inner_input != 0:
            u[i] = _apply_input_effects(
                axis, function, numbers, memory, i, inputs[applied_row, i], raw_q[i], t, h
            )
        elif applied_row != previous[i]:
            hold_time_s = hold_s[s, entry.late]
            u[i] = _apply_input_effects(
                axis, function, numbers, memory, i, inputs[applied_row, i], raw_q[i], t, hold_time_s
            )
            previous[i] = applied_row


@numba.njit(cache=True, error_model="numpy", inline="always")
def _call_inner_effects(
    tables: PlantTables, kernel_state: KernelState, u: FloatArray, raw_q: FloatArray, t: float,
    variates: FloatArray,
) -> None:  # fmt: skip
    """Call the effects on positions and readings that need steps between samples."""
    axis, function, numbers, output, state, weight, _, _ = tables
    x, memory, called_s = kernel_state
    _compute_outputs(output, state, weight, x, u, raw_q)
    for i in range(axis.shape[0]):
        if axis[i].inner_position != 0:
            q = _compute_position(axis, function, numbers, memory, called_s, i, raw_q, t)
            if axis[i].inner_reading != 0:
                begin, end = axis[i].reading, axis[i].digits
                _apply_reading_effects(
                    function, numbers, memory, called_s, begin, end, q, q, t, -1, variates
                )


@numba.njit(cache=True, error_model="numpy", inline="always")
def _step_groups(
    tables: PlantTables, steps: KernelSteps, kernel_state: KernelState, j: int, band: IntArray,
    u: FloatArray, force: FloatArray, has_forces: bool, t: float, next_x: FloatArray,
) -> None:  # fmt: skip
    group, member, phi, gamma = tables.group, tables.member, steps.state, steps.input
    for g in range(group.shape[0]):
        states = group[g].states
        gamma_at = steps.input_at[g] + j * states * (2 * group[g].axes + 1)
        phi_at = steps.state_at[g] + j * states * states
        _step_group(
            group, member, g, phi, phi_at, gamma, gamma_at, band, u, force, kernel_state.x, next_x
        )
        if has_forces:
            _apply_forces(tables, kernel_state, g, gamma, gamma_at, t, steps.length_s[j], next_x)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _copy_state(source: FloatArray, x: FloatArray) -> None:
    for n in range(x.shape[0]):
        x[n] = source[n]


@numba.njit(cache=True, error_model="numpy", inline="always")
def _apply_kick(kick: FloatArray, row: int, x: FloatArray) -> None:
    if kick.shape[0] > 0:
        for n in range(x.shape[0]):
            x[n] += kick[row, n]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def run(
    tables: PlantTables,
    steps: KernelSteps,
    run_inputs: KernelInputs,
    samples: KernelSamples,
    kernel_state: KernelState,
    start_s: float,
) -> None:
    """Step all axes through all segments from ``start_s`` on, filling samples and state."""
    # Unpack the tuples once: compiled code counts references at each access to a tuple. The
    # functions called here are inlined, so that tuples cost them nothing.
    axis, function, numbers, output, state, weight, _, _ = tables
    step, sample, applied, length_s, parts = (
        steps.step, steps.sample, steps.applied, steps.length_s, steps.parts,
    )  # fmt: skip
    first, time_s, _, _, row_forces, kick, variates = run_inputs
    x, memory, _ = kernel_state
    inputs = samples.inputs
    u, static_u = np.zeros(axis.shape[0]), np.zeros(axis.shape[0])
    raw_q, next_x, no_force = np.zeros(output.shape[0]), np.empty(x.shape[0]), np.zeros(0)
    largest_values = np.zeros(x.shape[0])
    band = _find_bands(tables.group, steps.state, steps.state_at, length_s.shape[0], x.shape[0])
    previous = np.full(axis.shape[0], -1, dtype=np.int64)
    has_static_axes, has_forces, needs_positions, needs_inner_positions = _classify_axes(axis)
    are_inputs_held = not axis["inner_input"].any()
    t, k = start_s, first - 1
    # The previous piece took the sample before the first one; compute its positions again.
    if first > 0:
        _compute_static_inputs(
            axis, function, numbers, memory, raw_q, applied[0], inputs, t, static_u
        )
        _compute_outputs(output, state, weight, x, static_u, raw_q)
    for s in range(step.shape[0]):
        is_sample = sample[s] >= 0
        if is_sample:
            k = sample[s]
            t = time_s[k]
            if has_static_axes:
                _compute_static_inputs(
                    axis, function, numbers, memory, raw_q, applied[s], inputs, t, static_u
                )
            _compute_outputs(output, state, weight, x, static_u, raw_q)
            _take_sample(tables, run_inputs, samples, kernel_state, raw_q, k)
            _fill_amplifier_outputs(tables, memory, samples, raw_q, applied[s], t, k)
            _apply_kick(kick, k - first, x)
        j = step[s]
        h = length_s[j]
        if h == 0.0:
            continue
        force = row_forces[k - first + 1] if row_forces.shape[0] > 0 else no_force
        still_steps = 0
        for part_index in range(parts[j]):
            if (
                needs_inner_positions
                if part_index > 0
                else needs_positions and s > 0 and not is_sample
            ):
                _call_inner_effects(tables, kernel_state, u, raw_q, t, variates)
            _compute_held_inputs(tables, steps, memory, raw_q, s, inputs, t, h, previous, u)
            _step_groups(tables, steps, kernel_state, j, band, u, force, has_forces, t, next_x)
            if are_inputs_held and parts[j] > _STILL_STEP_COUNT:
                still_steps = (
                    still_steps + 1 if _is_at_rest(next_x, x, largest_values, part_index) else 0
                )
            _copy_state(next_x, x)
            t += h
            # The state then stays at rest until the hold ends.
            if still_steps == _STILL_STEP_COUNT:
                t += (parts[j] - 1 - part_index) * h
                break


@numba.njit(cache=True, error_model="numpy", inline="always")
def _is_at_rest(
    next_x: FloatArray, x: FloatArray, largest_values: FloatArray, part_index: int
) -> bool:
    """Return whether a step changes nothing.

    ``largest_values``, the largest values in this hold, is updated.
    """
    is_at_rest = True
    for n in range(x.shape[0]):
        largest_values[n] = max(
            largest_values[n] if part_index > 0 else 0.0, abs(next_x[n]), abs(x[n])
        )
        if abs(next_x[n] - x[n]) > _STILL_CHANGE_RATIO * largest_values[n]:
            is_at_rest = False
    return is_at_rest


@numba.njit(cache=True, error_model="numpy")
def _classify_axes(axis: TableArray) -> tuple[bool, bool, bool, bool]:
    """Return whether any axis is static, has forces of effects, needs positions between samples.

    The fourth value tells whether positions are also needed at the steps inside a segment, where no
    held input changes.
    """
    has_static_axes, has_forces, needs_positions, needs_inner_positions = False, False, False, False
    for i in range(axis.shape[0]):
        entry = axis[i]
        # Step functions on the input receive the position.
        input_needs_position = entry.electronics < entry.force
        has_static_axes |= entry.place < 0
        has_forces |= entry.force < entry.motion
        needs_positions |= entry.inner_position != 0 or input_needs_position
        needs_inner_positions |= entry.inner_position != 0
        needs_inner_positions |= input_needs_position and (
            entry.inner_input != 0 or entry.place < 0
        )
    return has_static_axes, has_forces, needs_positions, needs_inner_positions


@numba.njit(cache=True, error_model="numpy")
def simulate_input_rise(
    tables: PlantTables, kernel_state: KernelState, low: FloatArray, inputs: FloatArray
) -> FloatArray:
    """Return the inputs (axes,) that reach the mechanics after a rise from ``low`` long ago.

    The memory of the effects on inputs is set to its value after this rise.
    """
    axis, function, numbers = tables.axis, tables.function, tables.numbers
    memory = kernel_state.memory
    u = inputs.copy()
    for step in range(_RISE_STEP_COUNT + 1):
        for i in range(u.shape[0]):
            requested = low[i] + (inputs[i] - low[i]) * step / _RISE_STEP_COUNT
            position = axis[i].asked * requested
            u[i] = _apply_input_effects(
                axis, function, numbers, memory, i, requested, position, 0.0, _INITIAL_HOLD_S
            )
    return u


@numba.njit(cache=True, error_model="numpy")
def simulate_position_rise(
    tables: PlantTables, kernel_state: KernelState, low: FloatArray, u: FloatArray
) -> None:
    """Update the effects on positions and readings for a rise from ``low`` (axes,), long ago."""
    axis, function, numbers, output, state, weight, _, _ = tables
    x, memory, called_s = kernel_state
    final_positions, raw_q = np.zeros(output.shape[0]), np.zeros(output.shape[0])
    no_variates = np.zeros((0, 0))
    _compute_outputs(output, state, weight, x, u, final_positions)
    for step in range(_RISE_STEP_COUNT + 1):
        raw_q[:] = final_positions
        for i in range(u.shape[0]):
            raw_q[i] = low[i] + (final_positions[i] - low[i]) * step / _RISE_STEP_COUNT
        for i in range(u.shape[0]):
            for e in range(axis[i].motion, axis[i].end):
                called_s[e] = -_INITIAL_HOLD_S
            q = _compute_position(axis, function, numbers, memory, called_s, i, raw_q, 0.0)
            begin, digits, end = axis[i].reading, axis[i].digits, axis[i].end
            y = _apply_reading_effects(
                function, numbers, memory, called_s, begin, digits, q, q, 0.0, 0, no_variates
            )
            y += axis[i].offset
            _apply_reading_effects(
                function, numbers, memory, called_s, digits, end, y, q, 0.0, 0, no_variates
            )
