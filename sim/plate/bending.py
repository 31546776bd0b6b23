"""Bending of a thin plate by Morley's triangle, assembled with scikit-fem.

The model is Kirchhoff's plate, ``D Δ²w = p``, with free edges as natural boundary conditions.
The unknowns of Morley's element are w at the corners and its normal derivative at the midpoints of
the edges. Its curvature is constant. It bends without transverse shear, so it cannot lock, however
thin the plate is. The Argyris element, of higher order, loses its accuracy on the straight-sided
mesh of a round plate, and a rigid hub would impose conditions on its second derivatives too.

Source: L. S. D. Morley, "The triangular equilibrium element in the solution of plate bending
problems", Aero. Quart. 19 (1968); convergence: M. Wang, J. Xu, Numer. Math. 103 (2006).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

if TYPE_CHECKING:
    from skfem import Basis, MeshTri


@dataclass(frozen=True, slots=True, eq=False)
class BendingMatrices:
    """Matrices of a plate for the unknowns w (m) at points and R ∂w/∂n (m) at edges.

    The mesh is in units of the length R, so that numbers have a similar size for every plate.

    Attributes
    ----------
    basis : skfem.Basis
        Basis of the stiffness matrix, with one integration point in each element.
    length : float
        Length R, m.
    stiffness : (n, n) sparse array
        Stiffness matrix, N/m.
    mass : (n, n) sparse array
        Mass matrix, kg.
    normals : (2, facets) array
        Directions n of the unknowns at the edges.
    """

    basis: "Basis"
    length: float
    stiffness: "scipy.sparse.csr_matrix"
    mass: "scipy.sparse.csr_matrix"
    normals: FloatArray

    @property
    def points(self) -> np.ndarray:
        """Indices (n,) of the unknowns at the mesh's points."""
        return np.asarray(self.basis.nodal_dofs[0])

    @property
    def edges(self) -> np.ndarray:
        """Indices (facets,) of the unknowns at the mesh's edges."""
        return np.asarray(self.basis.facet_dofs[0])

    def interpolate(self, value: FloatArray, slope: FloatArray) -> FloatArray:
        """Return the unknowns of a function from its values and its gradient.

        ``value`` (points,), m; ``slope`` (2, facets), m per unit of the mesh, at edge midpoints.
        """
        unknowns = np.zeros(self.basis.N)
        unknowns[self.points] = value
        unknowns[self.edges] = np.sum(slope * self.normals, axis=0)
        return unknowns

    def curvatures(self, unknowns: FloatArray) -> FloatArray:
        """Return w_xx, w_yy, w_xy of each element, (3, elements), 1/m."""
        hessian = self.basis.interpolate(unknowns).hess[:, :, :, 0] / self.length**2
        return np.stack([hessian[0, 0], hessian[1, 1], hessian[0, 1]])


def assemble_bending(
    mesh: "MeshTri", length: float, rigidity: float, poissons_ratio: float, areal_mass: float
) -> BendingMatrices:
    """Assemble the stiffness and mass matrices of a plate.

    Parameters
    ----------
    mesh : MeshTri
        Mesh in units of ``length``.
    length : float
        Length R, m.
    rigidity : float
        Flexural rigidity D, N m.
    poissons_ratio : float
    areal_mass : float
        Mass per area, kg/m².
    """
    # Imported here, so that programs that compute no plate start faster.
    from skfem import Basis, BilinearForm, ElementTriMorley
    from skfem.helpers import dd, ddot, trace

    @BilinearForm
    def bending(u, v, _):  # type: ignore[no-untyped-def]
        traces = poissons_ratio * trace(dd(u)) * trace(dd(v))
        return (1.0 - poissons_ratio) * ddot(dd(u), dd(v)) + traces

    @BilinearForm
    def inertia(u, v, _):  # type: ignore[no-untyped-def]
        return u * v

    # Both bases use the same element, which caches its shape functions.
    element = ElementTriMorley()
    basis = Basis(mesh, element, intorder=0)
    return BendingMatrices(
        basis=basis,
        length=length,
        stiffness=rigidity / length**2 * bending.assemble(basis).tocsr(),
        mass=areal_mass * length**2 * inertia.assemble(Basis(mesh, element, intorder=4)).tocsr(),
        normals=_compute_edge_normals(mesh),
    )


def _compute_edge_normals(mesh: "MeshTri") -> FloatArray:
    """Return the normals of the edges with the signs that scikit-fem's element uses.

    At a border they point outwards. Inside, they are the direction from the corner with the lower
    index to the corner with the higher index, turned to the left.
    """
    first_corners, second_corners = mesh.p[:, mesh.facets[0]], mesh.p[:, mesh.facets[1]]
    edge_vectors = first_corners - second_corners
    normals = np.stack([edge_vectors[1], -edge_vectors[0]]) / np.hypot(*edge_vectors)
    border = mesh.boundary_facets()
    element_centres = mesh.p[:, mesh.t[:, mesh.f2t[0, border]]].mean(axis=1)
    midpoints = 0.5 * (first_corners + second_corners)[:, border]
    is_inward = np.sum(normals[:, border] * (midpoints - element_centres), axis=0) < 0.0
    normals[:, border[is_inward]] *= -1.0
    return np.asarray(normals)


def factorize(matrix: "scipy.sparse.spmatrix") -> "scipy.sparse.linalg.SuperLU":
    """Factorize a symmetric positive definite matrix, which needs no search for pivots."""
    return scipy.sparse.linalg.splu(
        scipy.sparse.csc_matrix(matrix),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
