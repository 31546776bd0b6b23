"""Mechanics of the first generator: exact linear steps, with forces held for a fine step."""

from typing import NamedTuple

import numba
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

# Codes of a load. A load is a row that holds the code, the index of the axis, and up to ten
# numbers.
SLIP, DAHL, ELASTOPLASTIC, CONTACT, HARDENING, BREATHING = range(6)
LOAD_ROW_LENGTH = 12
_MEMORY_LENGTH = 12


class LinearStructure(NamedTuple):
    """A linear structure with d coordinates.

    Attributes
    ----------
    mass, damping, stiffness : (d, d)
    drive : (m,) force per unit of target.
    """

    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    drive: FloatArray


def compute_propagator(structure: LinearStructure, step_s: float) -> tuple[FloatArray, FloatArray]:
    """Return the transition matrix (2d, 2d) of the state, and the input matrix (2d, d) of forces.

    Both are exact for a step during which the forces are constant.

    The state holds the positions, followed by the speeds.
    """
    d = len(structure.mass)
    inverse = np.linalg.inv(structure.mass)
    system = np.zeros((3 * d, 3 * d))
    system[:d, d : 2 * d] = np.eye(d)
    system[d : 2 * d, :d] = -inverse @ structure.stiffness
    system[d : 2 * d, d : 2 * d] = -inverse @ structure.damping
    system[d : 2 * d, 2 * d :] = inverse
    exponential = scipy.linalg.expm(system * step_s)
    return exponential[: 2 * d, : 2 * d].copy(), exponential[: 2 * d, 2 * d :].copy()


def simulate_motion(
    structure: LinearStructure, targets: FloatArray, loads: FloatArray, step_s: float
) -> FloatArray:
    """Return the motion (n, m) of axes that are driven to ``targets`` (n, m).

    ``loads`` (k, 12) are the load rows of the forces that act on the axes.
    """
    steps = compute_propagator(structure, step_s)
    d = len(structure.mass)
    start = np.zeros(2 * d)
    drive = np.zeros(d)
    drive[: len(structure.drive)] = structure.drive * targets[0]
    start[:d] = np.linalg.solve(structure.stiffness, drive)
    return _simulate_steps(
        *steps, structure.drive, np.ascontiguousarray(targets), loads, start, step_s
    )


@numba.njit(cache=True, error_model="numpy")
def _simulate_steps(
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
    state, next_state, force = start.copy(), start.copy(), np.zeros(d)
    memory = np.zeros((len(loads), _MEMORY_LENGTH))
    out = np.empty((n, m))
    for k in range(n):
        for i in range(m):
            out[k, i] = state[i]
            force[i] = drive[i] * targets[k, i]
        for j in range(len(loads)):
            i = int(loads[j, 1])
            force[i] += compute_load_force(loads[j], memory[j], state[i], state[d + i], k, step_s)
        for i in range(2 * d):
            total = 0.0
            for j in range(2 * d):
                total += free[i, j] * state[j]
            for j in range(d):
                total += forced[i, j] * force[j]
            next_state[i] = total
        state, next_state = next_state, state
    return out


@numba.njit(cache=True, error_model="numpy")
def compute_load_force(
    row: FloatArray,
    memory: FloatArray,
    q: float,
    v: float,
    k: int,
    step_s: float,
) -> float:
    """Return the force of one load at position q and speed v.

    ``memory`` is advanced by one step.
    """
    code = int(row[0])
    if code == SLIP:
        return -_step_maxwell_slip(row, memory, v, step_s)
    if code == DAHL:
        return -_step_dahl(row, memory, v, step_s)
    if code == CONTACT:
        return _compute_contact_force(row, q, v)
    if code == HARDENING:
        return float(-row[2] * compute_hardening_share(row, q))
    if code == ELASTOPLASTIC:
        return -_step_elastoplastic(row, memory, v, step_s)
    # Only BREATHING is left: a stiffness that varies with time.
    return float(-row[2] * (q - row[5]) * np.sin(row[3] * k * step_s + row[4]))


@numba.njit(cache=True, error_model="numpy")
def _compute_stribeck_force(v: float, coulomb: float, static: float, speed: float) -> float:
    return coulomb + (static - coulomb) / (1.0 + (v / speed) ** 2)


@numba.njit(cache=True, error_model="numpy")
def _step_maxwell_slip(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Return the friction of generalised Maxwell slip with six elements.

    An element sticks until its force reaches its share of the Stribeck force at the present speed.
    Then it slips: its force approaches that share exponentially until the motion reverses, and its
    spring does not act.

    The row holds the Coulomb force in each direction, the ratio of static to Coulomb force, the
    Stribeck speed, the presliding length, the attraction rate and the viscous damping.
    """
    coulomb = row[2] if v > 0.0 else row[3]
    stribeck_force = _compute_stribeck_force(v, coulomb, coulomb * row[4], row[5])
    direction = np.sign(v)
    total = row[8] * v
    for i in range(6):
        share = (i + 1) / 21.0
        force = memory[i]
        if direction != 0.0 and memory[6 + i] == direction:
            force = direction * share * stribeck_force + (
                force - direction * share * stribeck_force
            ) * np.exp(-step_s * row[7])
        else:
            force += share * row[2] / (row[6] * (i + 1) / 6.0) * v * step_s
            slips = force * direction >= share * stribeck_force
            memory[6 + i] = direction if slips else 0.0
            if slips:
                force = direction * min(force * direction, share * coulomb * row[4])
        memory[i] = force
        total += force
    return float(total)


@numba.njit(cache=True, error_model="numpy")
def _step_dahl(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Return Dahl's solid friction.

    The row holds the Coulomb force in each direction, an unused number, the exponent, the
    presliding length, an unused number and the viscous damping.
    """
    coulomb = row[2] if v > 0.0 else row[3]
    margin = 1.0 - memory[0] / coulomb * np.sign(v)
    slope = np.sign(margin) * abs(margin) ** row[5]
    force = memory[0] + coulomb / row[6] * slope * v * step_s
    memory[0] = min(max(force, -row[3]), row[2])
    return float(memory[0] + row[8] * v)


@numba.njit(cache=True, error_model="numpy")
def _step_elastoplastic(row: FloatArray, memory: FloatArray, v: float, step_s: float) -> float:
    """Return the friction of a bristle that is elastic up to its break-away deflection.

    Beyond it the bristle deforms plastically. The row is that of Dahl's friction, but row[5] is the
    break-away deflection, as a fraction of the presliding length.
    """
    coulomb = row[2] if v > 0.0 else row[3]
    z, breakaway = memory[0] / row[6], row[5]
    plastic = 0.0
    if z * v > 0.0 and abs(z) > breakaway:
        x = min((abs(z) - breakaway) / (1.0 - breakaway), 1.0)
        plastic = 0.5 - 0.5 * np.cos(np.pi * x)
    memory[0] = memory[0] + v * step_s * (1.0 - plastic * abs(z))
    memory[0] = min(max(memory[0], -row[6]), row[6])
    return float(coulomb * memory[0] / row[6] + row[8] * v)


@numba.njit(cache=True, error_model="numpy")
def _compute_contact_force(row: FloatArray, q: float, v: float) -> float:
    """Return the force of a damped Hertz contact.

    The row holds the position, stiffness, damping, side and exponent from row[2] on.
    """
    depth = (q - row[2]) * row[5]
    if depth <= 0.0:
        return 0.0
    push = row[3] * depth ** row[6] * (1.0 + row[4] * v * row[5])
    return float(-row[5] * max(push, 0.0))


@numba.njit(cache=True, error_model="numpy")
def compute_hardening_share(row: FloatArray, q: float) -> float:
    """Return the added restoring force of a hardening flexure, divided by stiffness and length.

    The flexure rests at row[3] and has the length row[4]; row[5] selects one of three laws.
    """
    x = (q - row[3]) / row[4]
    if row[5] == 0.0:
        return float(np.sinh(row[6] * x) / row[6] - x)
    if row[5] == 1.0:
        return float(x * abs(x) ** row[6])
    return float(np.tan(1.2 * max(min(x, 1.2), -1.2)) / 1.2 - x)
