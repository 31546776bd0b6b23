"""The mechanics: exact steps of the linear system, forces of effects held over a fine step."""

import numba
import numpy as np
from scipy.linalg import expm

from rotemina.sim.arrays import FloatArray

NONE, FRICTION, CONTACT, STIFFENING = 0, 1, 2, 3


def moved(
    mass: FloatArray,
    damping: FloatArray,
    stiffness: FloatArray,
    targets: FloatArray,
    step_s: float,
    force: FloatArray,
) -> FloatArray:
    """Return the motion (n, m) of axes that springs pull to ``targets`` (n, m).

    ``force`` (m, 6): kind of force on each axis and its numbers. Axes beyond those of ``targets``
    ride along.
    """
    size, axes = len(mass), targets.shape[1]
    inverse = np.linalg.inv(mass)
    generator = np.zeros((4 * size, 4 * size))
    generator[:size, size : 2 * size] = np.eye(size)
    generator[size : 2 * size, :size] = -inverse @ stiffness
    generator[size : 2 * size, size : 2 * size] = -inverse @ damping
    generator[size : 2 * size, 2 * size : 3 * size] = inverse @ np.diag(np.diag(stiffness))
    generator[size : 2 * size, 3 * size :] = inverse
    step = expm(generator * step_s)
    start = np.zeros(2 * size)
    start[:axes] = targets[0]
    own = np.zeros((len(targets), size))
    own[:, :axes] = targets
    state, drive, push = (
        np.ascontiguousarray(step[: 2 * size, part])
        for part in (slice(2 * size), slice(2 * size, 3 * size), slice(3 * size, 4 * size))
    )
    table = np.zeros((size, 6))
    table[:axes] = force
    return np.asarray(_run(state, drive, push, own, start, table, step_s)[:, :axes])


@numba.njit(cache=True, error_model="numpy")
def _run(
    state: FloatArray,
    drive: FloatArray,
    push: FloatArray,
    targets: FloatArray,
    start: FloatArray,
    table: FloatArray,
    step_s: float,
) -> FloatArray:
    rows, size = targets.shape
    motion = np.empty((rows, size))
    x, force, bristle = start.copy(), np.zeros(size), np.zeros((size, 2))
    for k in range(rows):
        motion[k] = x[:size]
        for i in range(size):
            force[i] = _force(table[i], x[i], x[size + i], bristle[i], step_s)
        fresh = np.zeros(2 * size)
        for row in range(2 * size):
            total = 0.0
            for column in range(2 * size):
                total += state[row, column] * x[column]
            for column in range(size):
                total += drive[row, column] * targets[k, column]
                total += push[row, column] * force[column]
            fresh[row] = total
        x = fresh
    return motion


@numba.njit(cache=True, error_model="numpy")
def _force(row: FloatArray, q: float, v: float, bristle: FloatArray, step_s: float) -> float:
    """Return the force of one effect on an axis.

    Friction after Bliman and Sorine (1995): two bristles of opposite sign whose strain decays with
    the distance gone; contact: a softly met quadratic spring; stiffening: a hyperbolic sine.
    """
    kind = row[0]
    if kind == FRICTION:
        gone = v * step_s
        for j in range(2):
            length = row[2] * (1.0 if j == 0 else row[4])
            decay = np.exp(-abs(gone) / length)
            bristle[j] = bristle[j] * decay + np.sign(gone) * (1.0 - decay)
        return float(-row[1] * (bristle[0] * (1.0 + row[5]) - row[5] * bristle[1]) - row[3] * v)
    if kind == CONTACT:
        depth = (q - row[2]) / row[3]
        soft = depth if depth > 30.0 else np.log1p(np.exp(depth))
        return float(-row[1] * row[3] * soft * (1.0 + row[4] * soft))
    if kind == STIFFENING:
        return float(-row[1] * row[3] * (np.sinh((q - row[2]) / row[3]) - (q - row[2]) / row[3]))
    return 0.0
