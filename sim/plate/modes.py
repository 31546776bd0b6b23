"""Natural frequencies and mode shapes of the plate with hub and pin."""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlateError
from rotemina.sim.plate.bending import factorize
from rotemina.sim.plate.statics import ClampedPlate, hub_inertia, reduce_matrix

MAX_MODES = 60


@dataclass(frozen=True, slots=True, eq=False)
class PlateModes:
    """Undamped modes in order of rising frequency.

    Attributes
    ----------
    frequencies_hz : (n,) array
    deflection : (n, points) array
        Mode shapes, scaled to a largest deflection of 1.
    hub : (n, 3) array
        Motion zn (m), thx, thy (rad) of the hub at the same scale.
    """

    frequencies_hz: FloatArray
    deflection: FloatArray
    hub: FloatArray


def compute_eigenmodes(clamped: ClampedPlate, pin_length_m: float, count: int = 10) -> PlateModes:
    """Return the modes of lowest frequency. The pin is a rigid rod on the hub.

    Raises
    ------
    PlateError
        If ``count`` is out of range.
    """
    if not 1 <= count <= MAX_MODES:
        raise PlateError("modes = {count}: must be 1 to {most}", count=count, most=MAX_MODES)
    length = clamped.bending.length
    unknown_scales = np.array([1.0, length, length])
    inertia = hub_inertia(clamped.plate, pin_length_m) / np.outer(unknown_scales, unknown_scales)
    stiffness = reduce_matrix(clamped, clamped.bending.stiffness)
    mass = reduce_matrix(clamped, clamped.bending.mass)
    size = stiffness.shape[0]
    rigid_mass = scipy.sparse.block_diag(
        [inertia, scipy.sparse.csr_matrix((size - 3, size - 3))], format="csc"
    )
    factors = factorize(stiffness)
    inverse = scipy.sparse.linalg.LinearOperator(
        (size, size), matvec=factors.solve, dtype=np.float64
    )
    # A fixed start vector makes the result reproducible.
    start_vector = np.random.default_rng(0).standard_normal(size)
    squared_frequencies, vectors = scipy.sparse.linalg.eigsh(
        stiffness, count, M=mass + rigid_mass, sigma=0.0, OPinv=inverse, v0=start_vector, which="LM"
    )
    order = np.argsort(squared_frequencies)
    squared_frequencies, vectors = squared_frequencies[order], vectors[:, order]
    unknowns = clamped.hub_motion @ (vectors[:3] / unknown_scales[:, None])
    unknowns[clamped.free] = vectors[3:]
    deflection = unknowns[clamped.bending.points].T
    rows = np.arange(count)
    largest_deflections = deflection[rows, np.argmax(np.abs(deflection), axis=1)]
    return PlateModes(
        frequencies_hz=np.sqrt(squared_frequencies) / (2.0 * np.pi),
        deflection=deflection / largest_deflections[:, None],
        hub=(vectors[:3] / unknown_scales[:, None] / largest_deflections).T,
    )
