"""The matrices M, D and C of a robot: axes on the diagonal, couplings off it."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.robot.model import Robot


class InertiaMatrices(NamedTuple):
    """``M``, ``D``, ``C`` (m, m) of the m axes that have dynamics, in the order of ``axes``."""

    axes: tuple[str, ...]
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray


def inertia_matrices(robot: Robot) -> InertiaMatrices:
    """Assemble M, D, C (SI) over the axes that are not static, in the robot's order."""
    inertias = {name: axis.inertia for name, axis in robot.axes.items()}
    moving = tuple(name for name, inertia in inertias.items() if inertia is not None)
    diagonals = np.array([inertias[name] for name in moving], dtype=np.float64).reshape(-1, 3)
    matrices = {letter: np.diag(diagonals[:, k]) for k, letter in enumerate("MDC")}
    for coupling in robot.couplings:
        first, second = (moving.index(name) for name in coupling.axes)
        matrices[coupling.matrix][first, second] = coupling.value
        matrices[coupling.matrix][second, first] = coupling.value
    return InertiaMatrices(moving, matrices["M"], matrices["D"], matrices["C"])
