"""The sequential inner loop of an inverse: one sample after the other, in shares of the range."""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

# What a sample's answer says besides its command.
BELOW, ABOVE, FAST, COMMAND = 1, 2, 4, 8

# Places of the memory before that of creep and plays: begun, the two samples before, the start.
_BEGUN, _LAST, _BEFORE, _START, FIXED = 0, 1, 2, 3, 4


class Numbers(NamedTuple):
    """An inverse at one sampling rate.

    Shapes are those of :mod:`rotemina.sim.compensate.inverse_parameters`.

    Few arrays, because each of them costs a call about half a microsecond.

    ``fixed`` (11,): origins of position and command, their span; lowest and highest desired
    position and command, and the greatest distance from sample to sample, SI; taps of the lag's
    filter. ``creep`` (2, c): how far each relaxation comes in a sample, its weight. ``bend``
    (2, b + 1): the offset, then where each dead zone begins; the slope everywhere, then theirs.
    ``plays`` (2, p): radii, states at the low end. ``memberships`` (2, k, m): centres, widths.
    """

    fixed: FloatArray
    creep: FloatArray
    bend: FloatArray
    plays: FloatArray
    premise: IntArray
    memberships: FloatArray
    consequents: FloatArray


@numba.njit(cache=True, error_model="numpy")
def advance(numbers: Numbers, state: FloatArray, desired: float) -> tuple[float, int]:
    """Return the command of the next sample, SI, and what is said of it; ``state`` continues."""
    fixed = numbers.fixed
    said = 0
    if desired < fixed[3]:
        desired, said = fixed[3], BELOW
    elif desired > fixed[4]:
        desired, said = fixed[4], ABOVE
    y = (desired - fixed[0]) / fixed[2]
    if state[_BEGUN] == 0.0:
        _begin(state, y, numbers.creep.shape[1])
        state[FIXED + numbers.creep.shape[1] :] = numbers.plays[1]
    if abs(y - state[_LAST]) * fixed[2] > fixed[7]:
        said |= FAST
    z = fixed[8] * y + fixed[9] * state[_LAST] + fixed[10] * state[_BEFORE]
    state[_BEFORE], state[_LAST] = state[_LAST], y
    z = bent(numbers.bend, _uncrept(numbers.creep, state, z))
    plays = state[FIXED + numbers.creep.shape[1] :]
    for j in range(len(plays)):
        plays[j] = max(z - numbers.plays[0, j], min(z + numbers.plays[0, j], plays[j]))
    command = fixed[1] + fixed[2] * _inferred(numbers, plays, z)
    if command < fixed[5]:
        return fixed[5], said | COMMAND
    if command > fixed[6]:
        return fixed[6], said | COMMAND
    return command, said


@numba.njit(cache=True, error_model="numpy")
def advance_all(
    numbers: Numbers, state: FloatArray, desired: FloatArray, command: FloatArray
) -> IntArray:
    """Fill in ``command`` (n,) for ``desired`` (n,); return what is said of each (n,)."""
    said = np.zeros(len(desired), np.int64)
    for k in range(len(desired)):
        command[k], said[k] = advance(numbers, state, desired[k])
    return said


@numba.njit(cache=True, error_model="numpy")
def _begin(state: FloatArray, y: float, relaxations: int) -> None:
    """Rest at y, since long ago, after a rise from the low end."""
    state[_BEGUN] = 1.0
    state[_LAST], state[_BEFORE], state[_START] = y, y, y
    state[FIXED : FIXED + relaxations] = y


@numba.njit(cache=True, error_model="numpy")
def _uncrept(creep: FloatArray, state: FloatArray, y: float) -> float:
    out = y
    for i in range(creep.shape[1]):
        state[FIXED + i] += creep[0, i] * (y - state[FIXED + i])
        out -= creep[1, i] * (state[FIXED + i] - state[_START])
    return out


@numba.njit(cache=True, error_model="numpy")
def bent(bend: FloatArray, z: float) -> float:
    """Return ``offset + slope₀ z + Σ slopeᵢ max(z − atᵢ, 0)`` of ``bend`` (2, b + 1)."""
    out = bend[0, 0] + bend[1, 0] * z
    for i in range(1, bend.shape[1]):
        out += bend[1, i] * max(z - bend[0, i], 0.0)
    return float(out)


@numba.njit(cache=True, error_model="numpy")
def memberships(centres: FloatArray, widths: FloatArray, value: float, out: FloatArray) -> None:
    """Fill in ``out`` (m,): Gaussians over ``value`` whose sum is 1, however far off it is."""
    nearest = np.inf
    for m in range(len(out)):
        out[m] = 0.5 * ((value - centres[m]) / widths[m]) ** 2
        nearest = min(nearest, out[m])
    total = 0.0
    for m in range(len(out)):
        out[m] = np.exp(nearest - out[m])
        total += out[m]
    for m in range(len(out)):
        out[m] /= total


@numba.njit(cache=True, error_model="numpy")
def _hold(grid: FloatArray, values: FloatArray, held: FloatArray) -> None:
    """Multiply into ``held`` (rules,) how much each rule of ``grid`` (2, k, m) holds."""
    block, each = len(held), grid.shape[2]
    grades = np.empty(each)
    for i in range(len(values)):
        memberships(grid[0, i], grid[1, i], values[i], grades)
        block //= each
        for r in range(len(held)):
            held[r] *= grades[(r // block) % each]


@numba.njit(cache=True, error_model="numpy")
def _inferred(numbers: Numbers, plays: FloatArray, z: float) -> float:
    rules, inputs = len(numbers.consequents), len(numbers.premise)
    values = np.empty(inputs)
    for i in range(inputs):
        j = numbers.premise[i]
        values[i] = z if j < 0 else (z - plays[j]) / numbers.plays[0, j]
    held = np.ones(rules)
    _hold(numbers.memberships, values, held)
    out = 0.0
    for r in range(rules):
        part = numbers.consequents[r, 0] + numbers.consequents[r, 1] * z
        for j in range(len(plays)):
            part += numbers.consequents[r, j + 2] * (z - plays[j])
        out += held[r] * part
    return out


@numba.njit(cache=True, error_model="numpy")
def uncrept(creep: FloatArray, positions: FloatArray) -> FloatArray:
    """Return ``positions`` (n,) without what creep ``(2, c)`` added since the first of them."""
    state = np.zeros(FIXED + creep.shape[1])
    _begin(state, positions[0], creep.shape[1])
    out = np.empty_like(positions)
    for k in range(len(positions)):
        out[k] = _uncrept(creep, state, positions[k])
    return out


@numba.njit(cache=True, error_model="numpy")
def graded(grid: FloatArray, values: FloatArray) -> FloatArray:
    """Return how much each rule of ``grid`` (2, k, m) holds (n, rules) for ``values`` (n, k)."""
    out = np.ones((len(values), grid.shape[2] ** grid.shape[1]))
    for n in range(len(values)):
        _hold(grid, values[n], out[n])
    return out
