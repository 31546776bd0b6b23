"""Mechanics as the generator makes it: exact steps of Eq. (1) with forces held for a fine step."""

from typing import NamedTuple

import numba
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

# What a load row holds: its code, its axis, then up to ten numbers.
SLIP, DAHL, ELASTOPLASTIC, CONTACT, HARDENING, BREATHING = range(6)
ROW = 12
_STATES = 12


class Structure(NamedTuple):
    """``mass``, ``damping``, ``stiffness`` (d, d); ``drive`` (m,) force per unit of target."""

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    drive: FloatArray


def propagator(structure: Structure, step_s: float) -> tuple[FloatArray, FloatArray]:
    """Return the exact step of the state (positions, speeds) and of forces held over it."""
    d = len(structure.mass)
    inverse = np.linalg.inv(structure.mass)
    system = np.zeros((3 * d, 3 * d))
    system[:d, d : 2 * d] = np.eye(d)
    system[d : 2 * d, :d] = -inverse @ structure.stiffness
    system[d : 2 * d, d : 2 * d] = -inverse @ structure.damping
    system[d : 2 * d, 2 * d :] = inverse
    whole = scipy.linalg.expm(system * step_s)
    return whole[: 2 * d, : 2 * d].copy(), whole[: 2 * d, 2 * d :].copy()


def move(structure: Structure, targets: FloatArray, loads: FloatArray, step_s: float) -> FloatArray:
    """Return the motion (n, m) of m axes driven to ``targets`` (n, m) under ``loads`` (k, 12)."""
    steps = propagator(structure, step_s)
    d = len(structure.mass)
    start = np.zeros(2 * d)
    drive = np.zeros(d)
    drive[: len(structure.drive)] = structure.drive * targets[0]
    start[:d] = np.linalg.solve(structure.stiffness, drive)
    return _moved(*steps, structure.drive, np.ascontiguousarray(targets), loads, start, step_s)


@numba.njit(cache=True, error_model="numpy")
def _moved(
    free: FloatArray,
    forced: FloatArray,
    drive: FloatArray,
    targets: FloatArray,
    loads: FloatArray,
    start: FloatArray,
    step_s: float,
) -> FloatArray:
    n, m = targets.shape
    d = len(start) // 2
    state, after, force = start.copy(), start.copy(), np.zeros(d)
    memory = np.zeros((len(loads), _STATES))
    out = np.empty((n, m))
    for k in range(n):
        for i in range(m):
            out[k, i] = state[i]
            force[i] = drive[i] * targets[k, i]
        for j in range(len(loads)):
            i = int(loads[j, 1])
            force[i] += load_force(loads[j], memory[j], state[i], state[d + i], k, step_s)
        for i in range(2 * d):
            total = 0.0
            for j in range(2 * d):
                total += free[i, j] * state[j]
            for j in range(d):
                total += forced[i, j] * force[j]
            after[i] = total
        state, after = after, state
    return out


@numba.njit(cache=True, error_model="numpy")
def load_force(
    row: FloatArray,
    memory: FloatArray,
    q: float,
    v: float,
    k: int,
    step_s: float,
) -> float:
    """Return the force of one load at position q and speed v; its ``memory`` continues a step."""
    code = int(row[0])
    if code == SLIP:
        return -_maxwell(row, memory, v, step_s)
    if code == DAHL:
        return -_dahl(row, memory, v, step_s)
    if code == CONTACT:
        return _pressed(row, q, v)
    if code == HARDENING:
        return float(-row[2] * hardened(row, q))
    if code == ELASTOPLASTIC:
        return -_elastoplastic(row, memory, v, step_s)
    # BREATHING: a stiffness that changes by itself with time.
    return float(-row[2] * (q - row[5]) * np.sin(row[3] * k * step_s + row[4]))


@numba.njit(cache=True, error_model="numpy")
def _stribeck(v: float, coulomb: float, static: float, speed: float) -> float:
    return coulomb + (static - coulomb) / (1.0 + (v / speed) ** 2)


@numba.njit(cache=True, error_model="numpy")
def _maxwell(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Generalised Maxwell slip: six elements that stick, or slip towards their Stribeck share.

    An element sticks until it holds its share of what the speed allows, and slips, that share
    catching up with a rate of its own, until the motion turns; its springs pull no more meanwhile.

    Row: Coulomb by direction, static over Coulomb, Stribeck speed, presliding length, attraction,
    viscous.
    """
    coulomb = row[2] if v > 0.0 else row[3]
    bound = _stribeck(v, coulomb, coulomb * row[4], row[5])
    side = np.sign(v)
    total = row[8] * v
    for i in range(6):
        share = (i + 1) / 21.0
        f = memory[i]
        if side != 0.0 and memory[6 + i] == side:
            f = side * share * bound + (f - side * share * bound) * np.exp(-step_s * row[7])
        else:
            f += share * row[2] / (row[6] * (i + 1) / 6.0) * v * step_s
            slips = f * side >= share * bound
            memory[6 + i] = side if slips else 0.0
            if slips:
                f = side * min(f * side, share * coulomb * row[4])
        memory[i] = f
        total += f
    return float(total)


@numba.njit(cache=True, error_model="numpy")
def _dahl(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Dahl's solid friction; row: Coulomb by direction, -, exponent, length, -, viscous."""
    coulomb = row[2] if v > 0.0 else row[3]
    rest = 1.0 - memory[0] / coulomb * np.sign(v)
    slope = np.sign(rest) * abs(rest) ** row[5]
    f = memory[0] + coulomb / row[6] * slope * v * step_s
    memory[0] = min(max(f, -row[3]), row[2])
    return float(memory[0] + row[8] * v)


@numba.njit(cache=True, error_model="numpy")
def _elastoplastic(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Elastic up to a break-away share, then plastic; row as for Dahl, row[5] the share."""
    coulomb = row[2] if v > 0.0 else row[3]
    z, away = memory[0] / row[6], row[5]
    plastic = 0.0
    if z * v > 0.0 and abs(z) > away:
        x = min((abs(z) - away) / (1.0 - away), 1.0)
        plastic = 0.5 - 0.5 * np.cos(np.pi * x)
    memory[0] = memory[0] + v * step_s * (1.0 - plastic * abs(z))
    memory[0] = min(max(memory[0], -row[6]), row[6])
    return float(coulomb * memory[0] / row[6] + row[8] * v)


@numba.njit(cache=True, error_model="numpy")
def _pressed(row: FloatArray, q: float, v: float) -> float:
    """Hertz contact with a damper beyond row[2]; stiffness row[3], damper row[4], side row[5]."""
    depth = (q - row[2]) * row[5]
    if depth <= 0.0:
        return 0.0
    push = row[3] * depth ** row[6] * (1.0 + row[4] * v * row[5])
    return float(-row[5] * max(push, 0.0))


@numba.njit(cache=True, error_model="numpy")
def hardened(row: FloatArray, q: float) -> float:
    """Extra restoring share about row[3] over the length row[4], by one of three laws row[5]."""
    x = (q - row[3]) / row[4]
    if row[5] == 0.0:
        return float(np.sinh(row[6] * x) / row[6] - x)
    if row[5] == 1.0:
        return float(x * abs(x) ** row[6])
    return float(np.tan(1.2 * max(min(x, 1.2), -1.2)) / 1.2 - x)
