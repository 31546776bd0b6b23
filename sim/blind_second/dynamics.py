"""Mechanics of the second generator: exact linear steps, with forces held for a fine step."""

import numba
import numpy as np
from scipy.linalg import expm

from rotemina.sim.arrays import FloatArray

NONE, FRICTION, CONTACT, STIFFENING = 0, 1, 2, 3


def simulate_motion(
    mass: FloatArray,
    damping: FloatArray,
    stiffness: FloatArray,
    targets: FloatArray,
    step_s: float,
    force: FloatArray,
) -> FloatArray:
    """Return the motion (n, m) of axes that springs pull to ``targets`` (n, m).

    Each row of ``force`` (m, 6) holds the kind of the force on an axis, and the parameters of the
    force. The matrices may have further coordinates, which only the coupling moves.
    """
    size, axis_count = len(mass), targets.shape[1]
    inverse = np.linalg.inv(mass)
    system_matrix = np.zeros((4 * size, 4 * size))
    system_matrix[:size, size : 2 * size] = np.eye(size)
    system_matrix[size : 2 * size, :size] = -inverse @ stiffness
    system_matrix[size : 2 * size, size : 2 * size] = -inverse @ damping
    system_matrix[size : 2 * size, 2 * size : 3 * size] = inverse @ np.diag(np.diag(stiffness))
    system_matrix[size : 2 * size, 3 * size :] = inverse
    step_matrix = expm(system_matrix * step_s)
    start = np.zeros(2 * size)
    start[:axis_count] = targets[0]
    all_targets = np.zeros((len(targets), size))
    all_targets[:, :axis_count] = targets
    state_matrix, target_matrix, force_matrix = (
        np.ascontiguousarray(step_matrix[: 2 * size, columns])
        for columns in (slice(2 * size), slice(2 * size, 3 * size), slice(3 * size, 4 * size))
    )
    table = np.zeros((size, 6))
    table[:axis_count] = force
    return np.asarray(
        _simulate_steps(
            state_matrix, target_matrix, force_matrix, all_targets, start, table, step_s
        )[:, :axis_count]
    )


@numba.njit(cache=True, error_model="numpy")
def _simulate_steps(
    state_matrix: FloatArray,
    target_matrix: FloatArray,
    force_matrix: FloatArray,
    targets: FloatArray,
    start: FloatArray,
    table: FloatArray,
    step_s: float,
) -> FloatArray:
    rows, size = targets.shape
    motion = np.empty((rows, size))
    state, force, bristle = start.copy(), np.zeros(size), np.zeros((size, 2))
    for k in range(rows):
        motion[k] = state[:size]
        for i in range(size):
            force[i] = _compute_force(table[i], state[i], state[size + i], bristle[i], step_s)
        next_state = np.zeros(2 * size)
        for row in range(2 * size):
            total = 0.0
            for column in range(2 * size):
                total += state_matrix[row, column] * state[column]
            for column in range(size):
                total += target_matrix[row, column] * targets[k, column]
                total += force_matrix[row, column] * force[column]
            next_state[row] = total
        state = next_state
    return motion


@numba.njit(cache=True, error_model="numpy")
def _compute_force(
    row: FloatArray, q: float, v: float, bristle: FloatArray, step_s: float
) -> float:
    """Return the force of one effect on an axis.

    Friction follows Bliman and Sorine (1995): two bristles of opposite sign whose strain decays
    with the distance travelled. Contact is a quadratic spring that begins softly. Stiffening
    follows a hyperbolic sine.
    """
    kind = row[0]
    if kind == FRICTION:
        distance = v * step_s
        for j in range(2):
            length = row[2] * (1.0 if j == 0 else row[4])
            decay = np.exp(-abs(distance) / length)
            bristle[j] = bristle[j] * decay + np.sign(distance) * (1.0 - decay)
        return float(-row[1] * (bristle[0] * (1.0 + row[5]) - row[5] * bristle[1]) - row[3] * v)
    if kind == CONTACT:
        depth = (q - row[2]) / row[3]
        soft = depth if depth > 30.0 else np.log1p(np.exp(depth))
        return float(-row[1] * row[3] * soft * (1.0 + row[4] * soft))
    if kind == STIFFENING:
        return float(-row[1] * row[3] * (np.sinh((q - row[2]) / row[3]) - (q - row[2]) / row[3]))
    return 0.0
