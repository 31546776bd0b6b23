"""The sequential inner loop: exact linear steps, with effects and controllers in between.

The error model is numpy's because a check for division by zero at every sample costs a third of
the time; sample times increase, so there is none.
"""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.effects.step import call_step
from rotemina.sim.plant.indexing import item
from rotemina.sim.plant.plant_arrays import Machine, TableArray

# How a loop obtains its speed.
NO_LOOP, STATE_VELOCITY, BACKWARD_VELOCITY = 0, 1, 2

# How much of the chain before the mechanics is in place.
WHOLE, BEHIND_AMPLIFIER, BEHIND_ACTUATOR = 0, 1, 2

_LONG_S = 1e9  # after which every memory of time has come to rest
_RISES = 256  # steps of the rise from the low end of the range
_FEW_LENGTHS = 16  # of steps, whose matrices are looked through for their zeros
_STILL = 1e-13  # of the largest value in a hold, by which a state may change at rest
_STILL_STEPS = 64  # for so long: more than a period, in which something may turn


class Steps(NamedTuple):
    """Segments (:class:`rotemina.sim.plant.zero_order_hold.Segments`) and the steps through them.

    Each of the k lengths is done in ``parts`` (k,) steps of ``length_s`` (k,). The matrices of
    group g begin at ``state_at[g]`` and ``input_at[g]`` of the flat arrays, k of them in a row.
    ``hold_s`` (s, d): for how long each applied input acts on.
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


class Given(NamedTuple):
    """What drives a run: rows from sample ``first`` on, but for ``time_s`` (n,), all samples.

    ``time_s`` counts from the start of the run. ``command``, ``add`` (n − first, axes) and
    ``kick`` (n − first, states): set-points, what is added to the controllers' outputs, V, and
    jumps of the state. ``force`` (n − first + 1, axes): forces while a row lasts, that of the
    sample before first. ``variates`` (n − first, ...): of the random effects, then of every axis'
    declared sensor. All but ``command`` may have no rows.
    """

    first: int
    time_s: FloatArray
    command: FloatArray
    add: FloatArray
    force: FloatArray
    kick: FloatArray
    variates: FloatArray


class Taken(NamedTuple):
    """What a run fills in, all (n, axes): rows before the first sample are given.

    ``inputs`` as asked for (given without a loop), ``effort`` what the electronics make of them
    (may have no rows), ``position`` as seen from outside, ``velocity``, ``reading``.
    """

    inputs: FloatArray
    effort: FloatArray
    position: FloatArray
    velocity: FloatArray
    reading: FloatArray


class State(NamedTuple):
    """What a run moves: states ``x``, the effects' ``memory``, when each was ``seen`` last."""

    x: FloatArray
    memory: FloatArray
    seen: FloatArray


@numba.njit(cache=True, error_model="numpy", inline="always")
def _through(
    function: TableArray, numbers: FloatArray, memory: FloatArray, begin: int, end: int,
    x: float, own: float, t: float, h: float,
) -> float:  # fmt: skip
    """Send an input through the functions from ``begin`` to ``end``."""
    for e in range(begin, end):
        one = function[e]
        x = call_step(
            one.address, x, own, t, h, 0.0, 0.0, numbers, one.numbers_at, memory, one.memory_at
        )
    return x


@numba.njit(cache=True, error_model="numpy", inline="always")
def _drive(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray, i: int,
    u: float, own: float, t: float, h: float,
) -> float:  # fmt: skip
    """Return the input that axis i would need to do the same without effects on it."""
    one = axis[i]
    if one.part == WHOLE:
        u = _through(function, numbers, memory, one.electronics, one.actuator, u, own, t, h)
    if one.part == BEHIND_ACTUATOR or one.actuator == one.force:
        return u
    w = one.asked * u
    w = _through(function, numbers, memory, one.actuator, one.force, w, own, t, h)
    return float(w / one.asked)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _outputs(
    output: TableArray, state: IntArray, weight: FloatArray, x: FloatArray, u: FloatArray,
    shown: FloatArray,
) -> None:  # fmt: skip
    """Fill in the positions of all axes, and what goes to ports, before any effect on them."""
    for o in range(output.shape[0]):
        one = output[o]
        total = one.through * u[one.source] if one.through != 0.0 else 0.0
        for term in range(one.begin, one.end):
            total += item(weight, term) * item(x, item(state, term))
        shown[o] = total


@numba.njit(cache=True, error_model="numpy")
def _position(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray,
    seen: FloatArray, i: int, shown: FloatArray, t: float,
) -> float:  # fmt: skip
    """Return the position of axis i as it is seen from outside."""
    q: float = shown[i]
    for e in range(axis[i].motion, axis[i].reading):
        one = function[e]
        other = shown[one.other] if one.other >= 0 else 0.0
        q = call_step(
            one.address, q, other, t, t - seen[e], 0.0, 0.0,
            numbers, one.numbers_at, memory, one.memory_at,
        )  # fmt: skip
        seen[e] = t
    return q


@numba.njit(cache=True, error_model="numpy")
def _reading(
    function: TableArray, numbers: FloatArray, memory: FloatArray,
    seen: FloatArray, begin: int, end: int, y: float, q: float, t: float, row: int,
    variates: FloatArray,
) -> float:  # fmt: skip
    """Send a reading y of the position q through the functions from ``begin`` to ``end``.

    With ``row`` < 0 between samples, where chance is asleep.
    """
    for e in range(begin, end):
        one = function[e]
        z = 0.0
        if one.variate >= 0:
            if row < 0:
                continue
            if variates.shape[0] > 0:
                z = variates[row, one.variate]
        y = call_step(
            one.address, y, q, t, t - seen[e], z, 0.0,
            numbers, one.numbers_at, memory, one.memory_at,
        )  # fmt: skip
        seen[e] = t
    return y


@numba.njit(cache=True, error_model="numpy")
def _noisy(axis: TableArray, i: int, y: float, row: int, variates: FloatArray) -> float:
    """Return a reading with the noise and resolution that the sensor declares."""
    own = axis[i]
    y += own.noise_rms * variates[row, variates.shape[1] - axis.shape[0] + i]
    if own.resolution > 0.0:
        y = np.rint(y / own.resolution) * own.resolution
    return y


@numba.njit(cache=True, error_model="numpy")
def _effort(
    axis: TableArray, i: int, command: float, read: float, speed: float, add: float
) -> float:
    """Return the output of a cascade controller, V."""
    own = axis[i]
    effort = own.kv * (own.kp * (command - read) - speed) + add
    return float(min(max(effort, -own.limit), own.limit))


@numba.njit(cache=True, error_model="numpy", inline="always")
def _forces(
    machine: Machine, moving: State, g: int, into: FloatArray, at: int, t: float, h: float,
    fresh: FloatArray,
) -> None:  # fmt: skip
    """Let the forces of effects act on the states of group g, stepped without them."""
    axis, function, numbers, _, _, _, group, member = machine
    x, memory, _ = moving
    first, n, m = group[g].first, group[g].states, group[g].axes
    wide = 2 * m + 1
    for c in range(m):
        i = member[group[g].member + c]
        column = at + m + 1 + c
        place, rate = axis[i].place, axis[i].rate
        for e in range(axis[i].force, axis[i].motion):
            one = function[e]
            force = call_step(
                one.address, 0.5 * (x[place] + fresh[place]), fresh[rate], t, h,
                into[column + (place - first) * wide], into[column + (rate - first) * wide],
                numbers, one.numbers_at, memory, one.memory_at,
            )  # fmt: skip
            for row in range(n):
                fresh[first + row] += item(into, column + row * wide) * force


@numba.njit(cache=True, error_model="numpy", inline="always")
def _linear(
    group: TableArray, member: IntArray, g: int, within: FloatArray, own: int, into: FloatArray,
    at: int, band: IntArray, u: FloatArray, force: FloatArray, x: FloatArray, fresh: FloatArray,
) -> None:  # fmt: skip
    """Step the states of group g exactly, by its matrices at ``own`` and ``at``."""
    first, n, m, begin = group[g].first, group[g].states, group[g].axes, group[g].member
    if n == 2 and force.shape[0] == 0:  # one axis by itself: loops this short cost more than work
        q, v, drive = x[first], x[first + 1], u[member[begin]]
        fresh[first] = into[at] * drive + into[at + 1] + within[own] * q + within[own + 1] * v
        at, own = at + 3, own + 2
        fresh[first + 1] = into[at] * drive + into[at + 1] + within[own] * q + within[own + 1] * v
        n = 0
    elif n == 4 and m == 2 and force.shape[0] == 0:  # and two coupled ones
        q1, q2, v1, v2 = x[first], x[first + 1], x[first + 2], x[first + 3]
        drive, other = u[member[begin]], u[member[begin + 1]]
        for row in range(4):
            total = into[at] * drive + into[at + 1] * other + into[at + 2]
            total += within[own] * q1 + within[own + 1] * q2
            fresh[first + row] = total + within[own + 2] * v1 + within[own + 3] * v2
            at, own = at + 5, own + 4
        n = 0
    for row in range(n):
        # Inputs first: they do not wait for the step before, so the processor can run ahead.
        place = at + row * (2 * m + 1)
        total = item(into, place + m)
        for c in range(m):
            total += item(into, place + c) * item(u, item(member, begin + c))
        if force.shape[0] > 0:
            for c in range(m):
                total += item(into, place + m + 1 + c) * item(force, item(member, begin + c))
        place = own + row * n
        for c in range(band[first + row, 0], band[first + row, 1]):
            total += item(within, place + c) * item(x, first + c)
        fresh[first + row] = total


@numba.njit(cache=True, error_model="numpy")
def _bands(
    group: TableArray, within: FloatArray, state_at: IntArray, lengths: int, states: int
) -> IntArray:
    """Return from which to before which column (states, 2) the step of each state has entries.

    Modes beside each other have two each. Of many lengths all columns are taken.
    """
    band = np.zeros((states, 2), dtype=np.int64)
    for g in range(group.shape[0]):
        first, n = group[g].first, group[g].states
        for row in range(n):
            low, high = n, 0
            for j in range(lengths if lengths <= _FEW_LENGTHS else 0):
                for c in range(n):
                    if within[state_at[g] + (j * n + row) * n + c] != 0.0:
                        low, high = min(low, c), max(high, c + 1)
            if lengths > _FEW_LENGTHS:
                low, high = 0, n
            band[first + row, 0], band[first + row, 1] = low, high
    return band


@numba.njit(cache=True, error_model="numpy", inline="always")
def _sample(
    machine: Machine, given: Given, taken: Taken, moving: State, shown: FloatArray, k: int
) -> None:
    """Take sample k of every axis and close the loops."""
    axis, function, numbers = machine.axis, machine.function, machine.numbers
    x, memory, seen = moving
    time_s, command, add, variates = given.time_s, given.command, given.add, given.variates
    inputs, reading = taken.inputs, taken.reading
    t, row = time_s[k], k - given.first
    places, speeds, readings = taken.position[k], taken.velocity[k], reading[k]
    for i in range(axis.shape[0]):
        own = axis[i]
        q = y = shown[i]
        if own.motion < own.end:
            q = _position(axis, function, numbers, memory, seen, i, shown, t)
            y = _reading(
                function, numbers, memory, seen, own.reading, own.digits, q, q, t, row, variates
            )
        y += own.offset
        if variates.shape[0] > 0:
            y = _noisy(axis, i, y, row, variates)
        if own.digits < own.end:
            y = _reading(
                function, numbers, memory, seen, own.digits, own.end, y, q, t, row, variates
            )
        places[i] = q
        readings[i] = y
        speed = x[own.rate] if own.rate >= 0 else 0.0
        speeds[i] = speed
        if own.loop != NO_LOOP:
            if own.loop == BACKWARD_VELOCITY and k > 0:
                speed = (y - reading[k - 1, i]) / (time_s[k] - time_s[k - 1])
            extra = add[row, i] if add.shape[0] > 0 else 0.0
            inputs[k, i] = _effort(axis, i, command[row, i], y - own.offset, speed, extra)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _amplified(
    machine: Machine, memory: FloatArray, taken: Taken, shown: FloatArray, applied: IntArray,
    t: float, k: int,
) -> None:  # fmt: skip
    """Fill in, where it is requested, what the amplifiers put out at this instant.

    Of an axis under a controller it is what the controller writes down, before it comes late.
    """
    if taken.effort.shape[0] == 0:
        return
    for i in range(machine.axis.shape[0]):
        own = machine.axis[i]
        asked = taken.inputs[k if own.loop != NO_LOOP else applied[own.late], i]
        taken.effort[k, i] = _through(
            machine.function, machine.numbers, memory, own.electronics, own.actuator, asked,
            shown[i], t, 0.0,
        )  # fmt: skip


@numba.njit(cache=True, error_model="numpy")
def _static_inputs(
    axis: TableArray, function: TableArray, numbers: FloatArray, memory: FloatArray,
    shown: FloatArray, applied: IntArray, inputs: FloatArray, t: float, now: FloatArray,
) -> None:  # fmt: skip
    """Fill in the inputs of static axes: such an axis is where this very moment's puts it."""
    for i in range(axis.shape[0]):
        if axis[i].place < 0:
            asked = inputs[applied[axis[i].late], i]
            now[i] = _drive(axis, function, numbers, memory, i, asked, shown[i], t, 0.0)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _held_inputs(
    machine: Machine, steps: Steps, memory: FloatArray, shown: FloatArray, s: int,
    inputs: FloatArray, t: float, h: float, before: IntArray, u: FloatArray,
) -> None:  # fmt: skip
    """Fill in the inputs that act for the next ``h`` seconds."""
    axis, function, numbers = machine.axis, machine.function, machine.numbers
    applied, hold_s = steps.applied, steps.hold_s
    at_once = applied[s, 0]
    for i in range(axis.shape[0]):
        own = axis[i]
        a = at_once if own.late == 0 else applied[s, own.late]
        if own.electronics == own.force:
            u[i] = inputs[a, i]
        elif own.inner_input != 0:
            u[i] = _drive(axis, function, numbers, memory, i, inputs[a, i], shown[i], t, h)
        elif a != before[i]:
            hold = hold_s[s, own.late]
            u[i] = _drive(axis, function, numbers, memory, i, inputs[a, i], shown[i], t, hold)
            before[i] = a


@numba.njit(cache=True, error_model="numpy", inline="always")
def _follow(
    machine: Machine, moving: State, u: FloatArray, shown: FloatArray, t: float,
    variates: FloatArray,
) -> None:  # fmt: skip
    """Show positions and readings between samples to the effects that remember them."""
    axis, function, numbers, output, state, weight, _, _ = machine
    x, memory, seen = moving
    _outputs(output, state, weight, x, u, shown)
    for i in range(axis.shape[0]):
        if axis[i].inner_position != 0:
            q = _position(axis, function, numbers, memory, seen, i, shown, t)
            if axis[i].inner_reading != 0:
                begin, end = axis[i].reading, axis[i].digits
                _reading(function, numbers, memory, seen, begin, end, q, q, t, -1, variates)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _stepped(
    machine: Machine, steps: Steps, moving: State, j: int, band: IntArray, u: FloatArray,
    force: FloatArray, forces: bool, t: float, fresh: FloatArray,
) -> None:  # fmt: skip
    """Step all groups by the matrices of length j."""
    group, member, within, into = machine.group, machine.member, steps.state, steps.input
    for g in range(group.shape[0]):
        states = group[g].states
        at = steps.input_at[g] + j * states * (2 * group[g].axes + 1)
        own = steps.state_at[g] + j * states * states
        _linear(group, member, g, within, own, into, at, band, u, force, moving.x, fresh)
        if forces:
            _forces(machine, moving, g, into, at, t, steps.length_s[j], fresh)


@numba.njit(cache=True, error_model="numpy", inline="always")
def _put(source: FloatArray, x: FloatArray) -> None:
    for n in range(x.shape[0]):
        x[n] = source[n]


@numba.njit(cache=True, error_model="numpy", inline="always")
def _kicked(kick: FloatArray, row: int, x: FloatArray) -> None:
    if kick.shape[0] > 0:
        for n in range(x.shape[0]):
            x[n] += kick[row, n]


@numba.njit(cache=True, nogil=True, error_model="numpy")
def run(
    machine: Machine, steps: Steps, given: Given, taken: Taken, moving: State, start_s: float
) -> None:
    """Step all axes through all segments, from ``start_s`` on; fill ``taken``, move ``moving``."""
    # Taken apart once: compiled code counts references each time it reaches into a tuple. The
    # functions called here are put in its place, so that tuples cost them nothing.
    axis, function, numbers, output, state, weight, _, _ = machine
    step, sample, applied, length_s, parts = (
        steps.step, steps.sample, steps.applied, steps.length_s, steps.parts,
    )  # fmt: skip
    first, time_s, _, _, forced, kick, variates = given
    x, memory, _ = moving
    inputs = taken.inputs
    u, now = np.zeros(axis.shape[0]), np.zeros(axis.shape[0])
    shown, fresh, no_force = np.zeros(output.shape[0]), np.empty(x.shape[0]), np.zeros(0)
    most = np.zeros(x.shape[0])
    band = _bands(machine.group, steps.state, steps.state_at, length_s.shape[0], x.shape[0])
    before = np.full(axis.shape[0], -1, dtype=np.int64)
    static, forces, followed, inside = _kinds(axis)
    held = not axis["inner_input"].any()
    t, k = start_s, first - 1
    if first > 0:  # the sample before was taken in the piece before: its position is shown again
        _static_inputs(axis, function, numbers, memory, shown, applied[0], inputs, t, now)
        _outputs(output, state, weight, x, now, shown)
    for s in range(step.shape[0]):
        taking = sample[s] >= 0
        if taking:
            k = sample[s]
            t = time_s[k]
            if static:
                _static_inputs(axis, function, numbers, memory, shown, applied[s], inputs, t, now)
            _outputs(output, state, weight, x, now, shown)
            _sample(machine, given, taken, moving, shown, k)
            _amplified(machine, memory, taken, shown, applied[s], t, k)
            _kicked(kick, k - first, x)
        j = step[s]
        h = length_s[j]
        if h == 0.0:
            continue
        force = forced[k - first + 1] if forced.shape[0] > 0 else no_force
        still = 0
        for part in range(parts[j]):
            if inside if part > 0 else followed and s > 0 and not taking:
                _follow(machine, moving, u, shown, t, variates)
            _held_inputs(machine, steps, memory, shown, s, inputs, t, h, before, u)
            _stepped(machine, steps, moving, j, band, u, force, forces, t, fresh)
            if held and parts[j] > _STILL_STEPS:
                still = still + 1 if _rests(fresh, x, most, part) else 0
            _put(fresh, x)
            t += h
            if still == _STILL_STEPS:  # so it stays while the hold lasts
                t += (parts[j] - 1 - part) * h
                break


@numba.njit(cache=True, error_model="numpy", inline="always")
def _rests(fresh: FloatArray, x: FloatArray, most: FloatArray, part: int) -> bool:
    """Return whether a step changes nothing; ``most``, the largest values in a hold, is kept."""
    rests = True
    for n in range(x.shape[0]):
        most[n] = max(most[n] if part > 0 else 0.0, abs(fresh[n]), abs(x[n]))
        if abs(fresh[n] - x[n]) > _STILL * most[n]:
            rests = False
    return rests


@numba.njit(cache=True, error_model="numpy")
def _kinds(axis: TableArray) -> tuple[bool, bool, bool, bool]:
    """Return whether any axis is static, has forces of effects, is followed between samples.

    Last whether it is so at the steps inside a segment as well, where no held input changes.
    """
    static, forces, followed, inside = False, False, False, False
    for i in range(axis.shape[0]):
        own = axis[i]
        informed = own.electronics < own.force  # these know the position
        static |= own.place < 0
        forces |= own.force < own.motion
        followed |= own.inner_position != 0 or informed
        inside |= own.inner_position != 0
        inside |= informed and (own.inner_input != 0 or own.place < 0)
    return static, forces, followed, inside


@numba.njit(cache=True, error_model="numpy")
def rise_inputs(machine: Machine, moving: State, low: FloatArray, inputs: FloatArray) -> FloatArray:
    """Let all inputs (axes,) rise from ``low`` long ago; return what reaches the mechanics."""
    axis, function, numbers = machine.axis, machine.function, machine.numbers
    memory = moving.memory
    u = inputs.copy()
    for step in range(_RISES + 1):
        for i in range(u.shape[0]):
            asked = low[i] + (inputs[i] - low[i]) * step / _RISES
            own = axis[i].asked * asked
            u[i] = _drive(axis, function, numbers, memory, i, asked, own, 0.0, _LONG_S)
    return u


@numba.njit(cache=True, error_model="numpy")
def rise_positions(machine: Machine, moving: State, low: FloatArray, u: FloatArray) -> None:
    """Let the effects on positions and readings have seen a rise from ``low`` (axes,) long ago."""
    axis, function, numbers, output, state, weight, _, _ = machine
    x, memory, seen = moving
    rest, shown = np.zeros(output.shape[0]), np.zeros(output.shape[0])
    none = np.zeros((0, 0))
    _outputs(output, state, weight, x, u, rest)
    for step in range(_RISES + 1):
        shown[:] = rest
        for i in range(u.shape[0]):
            shown[i] = low[i] + (rest[i] - low[i]) * step / _RISES
        for i in range(u.shape[0]):
            for e in range(axis[i].motion, axis[i].end):
                seen[e] = -_LONG_S
            q = _position(axis, function, numbers, memory, seen, i, shown, 0.0)
            begin, digits, end = axis[i].reading, axis[i].digits, axis[i].end
            y = _reading(function, numbers, memory, seen, begin, digits, q, q, 0.0, 0, none)
            y += axis[i].offset
            _reading(function, numbers, memory, seen, digits, end, y, q, 0.0, 0, none)
