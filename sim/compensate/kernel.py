"""The inner loop of an inverse: one sample after another, in shares of the range."""

from typing import NamedTuple

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray, IntArray

# Flags that are returned with the command of a sample.
LOW, HIGH, FAST, COMMAND = 1, 2, 4, 8

# First entries of the state: whether there was a sample, the two previous samples, and the first
# sample. The states of creep and plays follow.
_HAS_STARTED, _PREVIOUS, _SECOND_PREVIOUS, _FIRST, FIXED_STATE_COUNT = 0, 1, 2, 3, 4


class KernelParameters(NamedTuple):
    """An inverse at one sampling rate.

    Shapes are those of :mod:`rotemina.sim.compensate.inverse_parameters`. There are few arrays,
    because each of them makes a call slower by about half a microsecond.

    Attributes
    ----------
    fixed : (11,)
        Origins of position and command and their span; lowest and highest desired position and
        command, and the largest distance between samples, SI; taps of the lag's filter.
    creep : (2, c)
        Share by which each relaxation approaches its goal in a sample; its weight.
    bend : (2, b + 1)
        The offset, then the start of each dead zone; the common slope, then the additional slope
        of each dead zone.
    plays : (2, p)
        Radii; states at the low end.
    premise : (k,)
        Kind of each input.
    memberships : (2, k, m)
        Centres; widths.
    consequents : (rules, 2 + p)
    """

    fixed: FloatArray
    creep: FloatArray
    bend: FloatArray
    plays: FloatArray
    premise: IntArray
    memberships: FloatArray
    consequents: FloatArray


@numba.njit(cache=True, error_model="numpy")
def advance(parameters: KernelParameters, state: FloatArray, desired: float) -> tuple[float, int]:
    """Return the command of the next sample, SI, and its flags; ``state`` is advanced."""
    fixed = parameters.fixed
    flags = 0
    if desired < fixed[3]:
        desired, flags = fixed[3], LOW
    elif desired > fixed[4]:
        desired, flags = fixed[4], HIGH
    y = (desired - fixed[0]) / fixed[2]
    if state[_HAS_STARTED] == 0.0:
        _start_at_rest(state, y, parameters.creep.shape[1])
        state[FIXED_STATE_COUNT + parameters.creep.shape[1] :] = parameters.plays[1]
    if abs(y - state[_PREVIOUS]) * fixed[2] > fixed[7]:
        flags |= FAST
    z = fixed[8] * y + fixed[9] * state[_PREVIOUS] + fixed[10] * state[_SECOND_PREVIOUS]
    state[_SECOND_PREVIOUS], state[_PREVIOUS] = state[_PREVIOUS], y
    z = apply_bend(parameters.bend, _subtract_creep_step(parameters.creep, state, z))
    plays = state[FIXED_STATE_COUNT + parameters.creep.shape[1] :]
    for j in range(len(plays)):
        plays[j] = max(z - parameters.plays[0, j], min(z + parameters.plays[0, j], plays[j]))
    command = fixed[1] + fixed[2] * _infer_command(parameters, plays, z)
    if command < fixed[5]:
        return fixed[5], flags | COMMAND
    if command > fixed[6]:
        return fixed[6], flags | COMMAND
    return command, flags


@numba.njit(cache=True, error_model="numpy")
def advance_all(
    parameters: KernelParameters, state: FloatArray, desired: FloatArray, command: FloatArray
) -> IntArray:
    """Fill ``command`` (n,) for ``desired`` (n,) and return the flags (n,)."""
    flags = np.zeros(len(desired), np.int64)
    for k in range(len(desired)):
        command[k], flags[k] = advance(parameters, state, desired[k])
    return flags


@numba.njit(cache=True, error_model="numpy")
def _start_at_rest(state: FloatArray, y: float, relaxations: int) -> None:
    state[_HAS_STARTED] = 1.0
    state[_PREVIOUS], state[_SECOND_PREVIOUS], state[_FIRST] = y, y, y
    state[FIXED_STATE_COUNT : FIXED_STATE_COUNT + relaxations] = y


@numba.njit(cache=True, error_model="numpy")
def _subtract_creep_step(creep: FloatArray, state: FloatArray, y: float) -> float:
    position = y
    for i in range(creep.shape[1]):
        state[FIXED_STATE_COUNT + i] += creep[0, i] * (y - state[FIXED_STATE_COUNT + i])
        position -= creep[1, i] * (state[FIXED_STATE_COUNT + i] - state[_FIRST])
    return position


@numba.njit(cache=True, error_model="numpy")
def apply_bend(bend: FloatArray, z: float) -> float:
    """Return ``offset + slope₀ z + Σ slopeᵢ max(z − atᵢ, 0)`` of ``bend`` (2, b + 1)."""
    out = bend[0, 0] + bend[1, 0] * z
    for i in range(1, bend.shape[1]):
        out += bend[1, i] * max(z - bend[0, i], 0.0)
    return float(out)


@numba.njit(cache=True, error_model="numpy")
def compute_memberships(
    centres: FloatArray, widths: FloatArray, value: float, out: FloatArray
) -> None:
    """Fill ``out`` (m,) with Gaussians at ``value``, normalised to a sum of 1.

    The largest Gaussian is factored out, so that values far from all centres do not underflow.
    """
    min_exponent = np.inf
    for m in range(len(out)):
        out[m] = 0.5 * ((value - centres[m]) / widths[m]) ** 2
        min_exponent = min(min_exponent, out[m])
    total = 0.0
    for m in range(len(out)):
        out[m] = np.exp(min_exponent - out[m])
        total += out[m]
    for m in range(len(out)):
        out[m] /= total


@numba.njit(cache=True, error_model="numpy")
def _multiply_grades(grid: FloatArray, values: FloatArray, grades: FloatArray) -> None:
    """Multiply ``grades`` (rules,) by the grade of each rule of ``grid`` (2, k, m)."""
    rules_per_membership, membership_count = len(grades), grid.shape[2]
    input_grades = np.empty(membership_count)
    for i in range(len(values)):
        compute_memberships(grid[0, i], grid[1, i], values[i], input_grades)
        rules_per_membership //= membership_count
        for r in range(len(grades)):
            grades[r] *= input_grades[(r // rules_per_membership) % membership_count]


@numba.njit(cache=True, error_model="numpy")
def _infer_command(parameters: KernelParameters, plays: FloatArray, z: float) -> float:
    rules, inputs = len(parameters.consequents), len(parameters.premise)
    values = np.empty(inputs)
    for i in range(inputs):
        j = parameters.premise[i]
        values[i] = z if j < 0 else (z - plays[j]) / parameters.plays[0, j]
    grades = np.ones(rules)
    _multiply_grades(parameters.memberships, values, grades)
    command = 0.0
    for r in range(rules):
        rule_command = parameters.consequents[r, 0] + parameters.consequents[r, 1] * z
        for j in range(len(plays)):
            rule_command += parameters.consequents[r, j + 2] * (z - plays[j])
        command += grades[r] * rule_command
    return command


@numba.njit(cache=True, error_model="numpy")
def subtract_creep(creep: FloatArray, positions: FloatArray) -> FloatArray:
    """Return ``positions`` (n,) without the creep since the first one; ``creep`` is (2, c)."""
    state = np.zeros(FIXED_STATE_COUNT + creep.shape[1])
    _start_at_rest(state, positions[0], creep.shape[1])
    out = np.empty_like(positions)
    for k in range(len(positions)):
        out[k] = _subtract_creep_step(creep, state, positions[k])
    return out


@numba.njit(cache=True, error_model="numpy")
def grade_rules(grid: FloatArray, values: FloatArray) -> FloatArray:
    """Return the grade of each rule of ``grid`` (2, k, m), (n, rules), for ``values`` (n, k)."""
    out = np.ones((len(values), grid.shape[2] ** grid.shape[1]))
    for n in range(len(values)):
        _multiply_grades(grid, values[n], out[n])
    return out
