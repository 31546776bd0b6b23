"""Statics of the plate clamped at its rim and moved by its hub: unit solutions, stiffness, stress.

The hub is rigid and moves by q = (zn, thx, thy), with ``w = zn + thx·y − thy·x`` on it. A rotation
of the pin by thx moves the tip to +y, and a rotation by thy moves it to −x, as in the machine's
kinematics. The plate is treated as rigid in its own plane, because the pin is ten thousand times
softer sideways. The theory is linear. Stretching would add about (w/h)²/2 to the stiffness, which
is 1 % at the 65 µm of the shipped plate.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plate.bending import BendingMatrices, assemble_bending, factorize
from rotemina.sim.plate.curvature_recovery import recover_at_points
from rotemina.sim.plate.mesh import DEFAULT_DIVISIONS, PlateMesh, make_mesh
from rotemina.sim.robot import Plate

AXES = ("zn", "thx", "thy")


@dataclass(frozen=True, slots=True, eq=False)
class ClampedPlate:
    """A meshed plate, clamped at its rim, with its hub as three degrees of freedom.

    Attributes
    ----------
    hub_motion : (unknowns, 3) array
        Unknowns at the hub for each unit motion of the hub; zero elsewhere.
    free : array of indices
        Unknowns that are neither at the rim nor at the hub.
    """

    plate: Plate
    mesh: PlateMesh
    bending: BendingMatrices
    hub_motion: FloatArray
    free: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class UnitSolutions:
    """Solutions for a unit motion of the hub along each of :data:`AXES`.

    Attributes
    ----------
    clamped : ClampedPlate
    deflection : (3, points) array
        Deflection in m per m or rad.
    stress : (3, 3, points) array
        Indexed by axis, then σx, σy, τxy. It is the stress of the upper surface, Pa per m or rad;
        that of the lower surface has the opposite sign.
    stiffness, mass : (3, 3) arrays
        Stiffness for the motion of the hub (N or N m per m or rad), and inertia of the plate alone
        when it deflects in these shapes (kg, kg m, kg m²).
    rim_force : (3,) array
        Total force of the rim on the plate along the pin, N per m or rad.
    unknowns : int
        Number of unknowns.
    """

    clamped: ClampedPlate
    deflection: FloatArray
    stress: FloatArray
    stiffness: FloatArray
    mass: FloatArray
    rim_force: FloatArray
    unknowns: int


def clamp_plate(plate: Plate, divisions: int = DEFAULT_DIVISIONS) -> ClampedPlate:
    """Mesh a plate and assemble its matrices.

    Raises
    ------
    PlateError
        For the same reasons as in :func:`~rotemina.sim.plate.mesh.make_mesh`.
    """
    # Imported here, so that programs that compute no plate start faster.
    from skfem import MeshTri

    mesh = make_mesh(plate, divisions)
    length = plate.rim_radius
    bending = assemble_bending(
        MeshTri(np.ascontiguousarray(mesh.points / length), np.ascontiguousarray(mesh.triangles)),
        length,
        plate.flexural_rigidity,
        plate.poissons_ratio,
        plate.density * plate.thickness,
    )
    edge_ends = bending.basis.mesh.facets
    at_hub = np.concatenate(
        [bending.points[mesh.hub], bending.edges[mesh.hub[edge_ends].all(axis=0)]]
    )
    at_rim = np.concatenate(
        [bending.points[mesh.rim], bending.edges[mesh.rim[edge_ends].all(axis=0)]]
    )
    hub_motion = np.zeros((bending.basis.N, len(AXES)))
    hub_motion[at_hub] = _make_rigid_motions(bending, mesh)[at_hub]
    free = np.ones(bending.basis.N, dtype=bool)
    free[at_hub] = free[at_rim] = False
    return ClampedPlate(plate, mesh, bending, hub_motion, np.flatnonzero(free))


def _make_rigid_motions(bending: BendingMatrices, mesh: PlateMesh) -> FloatArray:
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


def solve_unit_motions(clamped: ClampedPlate) -> UnitSolutions:
    """Solve the plate for unit motions of its hub."""
    bending, free = clamped.bending, clamped.free
    stiffness = bending.stiffness
    factors = factorize(stiffness[free][:, free])
    unknowns = clamped.hub_motion.copy()
    unknowns[free] = -factors.solve((stiffness @ clamped.hub_motion)[free])
    forces = stiffness @ unknowns
    deflection = unknowns[bending.points].T
    return UnitSolutions(
        clamped=clamped,
        deflection=deflection,
        stress=np.stack([_compute_surface_stress(clamped, column) for column in unknowns.T]),
        stiffness=_symmetrise(clamped.hub_motion.T @ forces),
        mass=_symmetrise(unknowns.T @ (bending.mass @ unknowns)),
        rim_force=forces[bending.points[clamped.mesh.rim]].sum(axis=0),
        unknowns=bending.basis.N,
    )


def _compute_surface_stress(clamped: ClampedPlate, unknowns: FloatArray) -> FloatArray:
    """Return σx, σy, τxy at the points of the upper surface, (3, points), Pa.

    By Kirchhoff's hypothesis ``σx = −E h / (2 (1 − ν²)) (w_xx + ν w_yy)``, and so on.
    """
    plate, bending = clamped.plate, clamped.bending
    curvature = recover_at_points(bending.basis.mesh, bending.curvatures(unknowns))
    ratio = plate.poissons_ratio
    factor = -plate.youngs_modulus * plate.thickness / (2.0 * (1.0 - ratio**2))
    xx, yy, xy = curvature
    return factor * np.stack([xx + ratio * yy, yy + ratio * xx, (1.0 - ratio) * xy])


def _symmetrise(matrix: FloatArray) -> FloatArray:
    return np.asarray(0.5 * (matrix + matrix.T))


def hub_inertia(plate: Plate, pin_length_m: float) -> FloatArray:
    """Return the inertia (3, 3) of hub and pin about the pivot in the middle plane of the plate.

    The pin is a uniform rod with the inertia ``m L² / 3 + m d² / 16`` about its end.
    """
    pin = plate.pin
    rod_mass = pin.density * np.pi / 4.0 * pin.diameter**2 * pin_length_m
    inertia = plate.hub.inertia + rod_mass * (pin_length_m**2 / 3.0 + pin.diameter**2 / 16.0)
    product = plate.hub.product
    return np.array(
        [
            [plate.hub.mass + rod_mass, 0.0, 0.0],
            [0.0, inertia, product],
            [0.0, product, inertia],
        ]
    )


def reduce_matrix(
    clamped: ClampedPlate, matrix: "scipy.sparse.csr_matrix"
) -> "scipy.sparse.csc_matrix":
    """Return a matrix for the unknowns zn, R thx, R thy and the free ones, all in m."""
    length = clamped.bending.length
    hub_columns = scipy.sparse.csr_matrix(clamped.hub_motion / np.array([1.0, length, length]))
    count = clamped.free.size
    free_selection = scipy.sparse.csr_matrix(
        (np.ones(count), (clamped.free, np.arange(count))), shape=(matrix.shape[0], count)
    )
    transformation = scipy.sparse.hstack([hub_columns, free_selection], format="csr")
    return scipy.sparse.csc_matrix(transformation.T @ matrix @ transformation)
