"""The plate held at its rim and moved by its hub: unit solutions, stiffness, stress.

The hub is rigid and moves by q = (zn, thx, thy): ``w = zn + thx·y − thy·x`` on it, so a turn of
the pin by thx carries the tip to +y, one by thy to −x, as in the machine's kinematics. In its own
plane the plate is taken as rigid: the pin is ten thousand times softer sideways. The theory is
linear: stretching would add about (w/h)²/2 to the stiffness, 1 % at the shipped plate's 65 µm.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.bending import Bending, assemble, factorized
from rotemina.sim.plate.curvature_recovery import at_points
from rotemina.sim.plate.mesh import DIVISIONS, PlateMesh, make_mesh
from rotemina.sim.robot.plate import Plate

AXES = ("zn", "thx", "thy")


@dataclass(frozen=True, slots=True, eq=False)
class HeldPlate:
    """A meshed plate, clamped at its rim, with its hub as three degrees of freedom.

    Attributes
    ----------
    hub_motion : (unknowns, 3) array
        The plate's unknowns at the hub for each unit motion of it; zero elsewhere.
    free : array of indices
        The unknowns neither at the rim nor at the hub.
    """

    plate: Plate
    mesh: PlateMesh
    bending: Bending
    hub_motion: FloatArray
    free: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class UnitSolutions:
    """What the plate does for a unit motion of its hub along each of :data:`AXES`.

    Attributes
    ----------
    deflection : (3, points) array
        m per m or rad.
    stress : (3, 3, points) array
        By axis, then σx, σy, τxy, at the upper surface; the lower one has the opposite. Pa per m
        or rad.
    stiffness, mass : (3, 3) arrays
        Of the hub's motion: forces N or N m, and the plate's own share of the inertia in these
        shapes (kg, kg m, kg m²).
    rim_force : (3,) array
        Force of the whole rim on the plate along the pin, N per m or rad.
    unknowns : int
    """

    held: HeldPlate
    deflection: FloatArray
    stress: FloatArray
    stiffness: FloatArray
    mass: FloatArray
    rim_force: FloatArray
    unknowns: int


def hold(plate: Plate, divisions: int = DIVISIONS) -> HeldPlate:
    """Mesh and assemble a plate.

    Raises
    ------
    PlateError
        As :func:`~rotemina.sim.plate.mesh.make_mesh`.
    """
    from skfem import MeshTri  # loaded here for the same reason as in assemble()

    mesh = make_mesh(plate, divisions)
    length = plate.rim_radius
    bending = assemble(
        MeshTri(np.ascontiguousarray(mesh.points / length), np.ascontiguousarray(mesh.triangles)),
        length,
        plate.flexural_rigidity,
        plate.poissons_ratio,
        plate.density * plate.thickness,
    )
    ends = bending.basis.mesh.facets
    at_hub = np.concatenate([bending.points[mesh.hub], bending.edges[mesh.hub[ends].all(axis=0)]])
    at_rim = np.concatenate([bending.points[mesh.rim], bending.edges[mesh.rim[ends].all(axis=0)]])
    hub_motion = np.zeros((bending.basis.N, len(AXES)))
    hub_motion[at_hub] = _rigid_motions(bending, mesh)[at_hub]
    free = np.ones(bending.basis.N, dtype=bool)
    free[at_hub] = free[at_rim] = False
    return HeldPlate(plate, mesh, bending, hub_motion, np.flatnonzero(free))


def _rigid_motions(bending: Bending, mesh: PlateMesh) -> FloatArray:
    x, y = mesh.points
    edges = np.ones(bending.edges.size)
    length = bending.length
    return np.stack(
        [
            bending.interpolate(np.ones_like(x), np.stack([0.0 * edges, 0.0 * edges])),
            bending.interpolate(y, np.stack([0.0 * edges, length * edges])),
            bending.interpolate(-x, np.stack([-length * edges, 0.0 * edges])),
        ],
        axis=1,
    )


def solve(held: HeldPlate) -> UnitSolutions:
    """Solve for unit motions of the hub."""
    bending, free = held.bending, held.free
    stiffness = bending.stiffness
    factors = factorized(stiffness[free][:, free])
    unknowns = held.hub_motion.copy()
    unknowns[free] = -factors.solve((stiffness @ held.hub_motion)[free])
    forces = stiffness @ unknowns
    deflection = unknowns[bending.points].T
    return UnitSolutions(
        held=held,
        deflection=deflection,
        stress=np.stack([_stress(held, column) for column in unknowns.T]),
        stiffness=_symmetric(held.hub_motion.T @ forces),
        mass=_symmetric(unknowns.T @ (bending.mass @ unknowns)),
        rim_force=forces[bending.points[held.mesh.rim]].sum(axis=0),
        unknowns=bending.basis.N,
    )


def _stress(held: HeldPlate, unknowns: FloatArray) -> FloatArray:
    """Return σx, σy, τxy at the upper surface of the points, (3, points), Pa.

    ``σ = −E h / (2 (1 − ν²)) (w_xx + ν w_yy)`` and so on, by Kirchhoff's hypothesis.
    """
    plate, bending = held.plate, held.bending
    curvature = at_points(bending.basis.mesh, bending.curvatures(unknowns))
    ratio = plate.poissons_ratio
    factor = -plate.youngs_modulus * plate.thickness / (2.0 * (1.0 - ratio**2))
    xx, yy, xy = curvature
    return factor * np.stack([xx + ratio * yy, yy + ratio * xx, (1.0 - ratio) * xy])


def _symmetric(matrix: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (matrix + matrix.T))


def hub_inertia(plate: Plate, pin_length_m: float) -> FloatArray:
    """Return the (3, 3) inertia of hub and pin about the pivot in the plate's middle plane.

    The pin is a uniform rod, ``m L² / 3 + m d² / 16`` about its end.
    """
    pin = plate.pin
    rod = pin.density * np.pi / 4.0 * pin.diameter**2 * pin_length_m
    inertia = plate.hub.inertia + rod * (pin_length_m**2 / 3.0 + pin.diameter**2 / 16.0)
    product = plate.hub.product
    return np.array(
        [
            [plate.hub.mass + rod, 0.0, 0.0],
            [0.0, inertia, product],
            [0.0, product, inertia],
        ]
    )


def reduced(held: HeldPlate, matrix: "scipy.sparse.csr_matrix") -> "scipy.sparse.csc_matrix":
    """Return a matrix in the unknowns (zn, R thx, R thy, free ones), all of them lengths."""
    length = held.bending.length
    scaled = scipy.sparse.csr_matrix(held.hub_motion / np.array([1.0, length, length]))
    count = held.free.size
    chosen = scipy.sparse.csr_matrix(
        (np.ones(count), (held.free, np.arange(count))), shape=(matrix.shape[0], count)
    )
    both = scipy.sparse.hstack([scaled, chosen], format="csr")
    return scipy.sparse.csc_matrix(both.T @ matrix @ both)
