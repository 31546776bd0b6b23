"""Bending of a thin plate by Morley's triangle, assembled with scikit-fem.

Kirchhoff's plate, ``D Δ²w = p`` with the moments' free edges as natural conditions. Morley's
element has w at the corners and its normal derivative at the edges' middles; its curvature is
constant. It bends without transverse shear, so there is nothing in it that could lock however
thin the plate is. Argyris' element, of higher order, loses it on the straight-sided mesh of a
round plate, and a rigid hub puts conditions on its second derivatives too.

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
class Bending:
    """A plate's matrices, in the unknowns w (m) at points and R ∂w/∂n (m) at edges.

    The mesh is in units of the length R: figures then have the same size for every plate.

    Attributes
    ----------
    basis : skfem.Basis
        Of the stiffness, one integration point in each element.
    length : float
        R, m.
    stiffness : (n, n) sparse array
        N/m.
    mass : (n, n) sparse array
        kg.
    normals : (2, facets) array
        The directions in which the unknowns at edges count.
    """

    basis: "Basis"
    length: float
    stiffness: "scipy.sparse.csr_matrix"
    mass: "scipy.sparse.csr_matrix"
    normals: FloatArray

    @property
    def points(self) -> np.ndarray:
        """The unknowns at the mesh's points, (n,) indices."""
        return np.asarray(self.basis.nodal_dofs[0])

    @property
    def edges(self) -> np.ndarray:
        """The unknowns at the mesh's edges, (facets,) indices."""
        return np.asarray(self.basis.facet_dofs[0])

    def interpolate(self, value: FloatArray, slope: FloatArray) -> FloatArray:
        """Return the unknowns of a function from its values and its gradient.

        ``value`` (points,), m; ``slope`` (2, facets), m per unit of the mesh, at edges' middles.
        """
        unknowns = np.zeros(self.basis.N)
        unknowns[self.points] = value
        unknowns[self.edges] = np.sum(slope * self.normals, axis=0)
        return unknowns

    def curvatures(self, unknowns: FloatArray) -> FloatArray:
        """Return w_xx, w_yy, w_xy of each element, (3, elements), 1/m."""
        hessian = self.basis.interpolate(unknowns).hess[:, :, :, 0] / self.length**2
        return np.stack([hessian[0, 0], hessian[1, 1], hessian[0, 1]])


def assemble(
    mesh: "MeshTri", length: float, rigidity: float, poissons_ratio: float, areal_mass: float
) -> Bending:
    """Assemble the matrices of a plate.

    Parameters
    ----------
    mesh : MeshTri
        In units of ``length`` (m).
    rigidity : float
        D, N m.
    areal_mass : float
        kg/m².
    """
    # Loaded here, so that a program that computes no plate starts sooner.
    from skfem import Basis, BilinearForm, ElementTriMorley
    from skfem.helpers import dd, ddot, trace

    @BilinearForm
    def bending(u, v, _):  # type: ignore[no-untyped-def]
        traces = poissons_ratio * trace(dd(u)) * trace(dd(v))
        return (1.0 - poissons_ratio) * ddot(dd(u), dd(v)) + traces

    @BilinearForm
    def inertia(u, v, _):  # type: ignore[no-untyped-def]
        return u * v

    element = ElementTriMorley()  # one for both: it keeps its shape functions
    basis = Basis(mesh, element, intorder=0)
    return Bending(
        basis=basis,
        length=length,
        stiffness=rigidity / length**2 * bending.assemble(basis).tocsr(),
        mass=areal_mass * length**2 * inertia.assemble(Basis(mesh, element, intorder=4)).tocsr(),
        normals=_normals(mesh),
    )


def _normals(mesh: "MeshTri") -> FloatArray:
    """Return the normals of edges as scikit-fem's element counts them: outwards at a border.

    Inside, from the corner with the lower number to that with the higher, turned to the left.
    """
    low, high = mesh.p[:, mesh.facets[0]], mesh.p[:, mesh.facets[1]]
    along = low - high
    normals = np.stack([along[1], -along[0]]) / np.hypot(*along)
    border = mesh.boundary_facets()
    inside = mesh.p[:, mesh.t[:, mesh.f2t[0, border]]].mean(axis=1)
    middle = 0.5 * (low + high)[:, border]
    inwards = np.sum(normals[:, border] * (middle - inside), axis=0) < 0.0
    normals[:, border[inwards]] *= -1.0
    return np.asarray(normals)


def factorized(matrix: "scipy.sparse.spmatrix") -> "scipy.sparse.linalg.SuperLU":
    """Factorize a symmetric positive definite matrix; its pivots need no search."""
    return scipy.sparse.linalg.splu(
        scipy.sparse.csc_matrix(matrix),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
