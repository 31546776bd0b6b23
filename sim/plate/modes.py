"""Eigenfrequencies and eigenforms of the plate with hub and pin."""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plate.bending import factorized
from rotemina.sim.plate.errors import PlateError
from rotemina.sim.plate.statics import HeldPlate, hub_inertia, reduced

MOST = 60


@dataclass(frozen=True, slots=True, eq=False)
class Modes:
    """Undamped modes, slowest first.

    Attributes
    ----------
    frequencies_hz : (n,) array
    deflection : (n, points) array
        With the largest deflection 1.
    hub : (n, 3) array
        zn (m), thx, thy (rad) of the hub in the same scale.
    """

    frequencies_hz: FloatArray
    deflection: FloatArray
    hub: FloatArray


def eigenmodes(held: HeldPlate, pin_length_m: float, count: int = 10) -> Modes:
    """Return the slowest modes; the pin rides on the hub as a rigid rod.

    Raises
    ------
    PlateError
        If more modes are asked for than are computed well.
    """
    if not 1 <= count <= MOST:
        raise PlateError(
            message("engine", "modes = {count}: must be 1 to {most}").fill(count=count, most=MOST)
        )
    length = held.bending.length
    scale = np.array([1.0, length, length])
    inertia = hub_inertia(held.plate, pin_length_m) / np.outer(scale, scale)
    stiffness = reduced(held, held.bending.stiffness)
    mass = reduced(held, held.bending.mass)
    size = stiffness.shape[0]
    rigid = scipy.sparse.block_diag(
        [inertia, scipy.sparse.csr_matrix((size - 3, size - 3))], format="csc"
    )
    factors = factorized(stiffness)
    inverse = scipy.sparse.linalg.LinearOperator(
        (size, size), matvec=factors.solve, dtype=np.float64
    )
    start = np.random.default_rng(0).standard_normal(size)  # the same answer every time
    squares, vectors = scipy.sparse.linalg.eigsh(
        stiffness, count, M=mass + rigid, sigma=0.0, OPinv=inverse, v0=start, which="LM"
    )
    order = np.argsort(squares)
    squares, vectors = squares[order], vectors[:, order]
    unknowns = held.hub_motion @ (vectors[:3] / scale[:, None])
    unknowns[held.free] = vectors[3:]
    deflection = unknowns[held.bending.points].T
    rows = np.arange(count)
    largest = deflection[rows, np.argmax(np.abs(deflection), axis=1)]
    return Modes(
        frequencies_hz=np.sqrt(squares) / (2.0 * np.pi),
        deflection=deflection / largest[:, None],
        hub=(vectors[:3] / scale[:, None] / largest).T,
    )
