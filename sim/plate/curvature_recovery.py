"""Curvatures at a mesh's points from those of its elements."""

from typing import TYPE_CHECKING

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

if TYPE_CHECKING:
    from skfem import MeshTri


def recover_at_points(mesh: "MeshTri", values: FloatArray) -> FloatArray:
    """Return values at points from values that are constant in each element.

    A plane is fitted to the values of the elements around each point by least squares (patch
    recovery: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Eng. 33 (1992)). At a border the
    elements around the neighbouring points are used too. Otherwise the value at the border would
    be that of half an element further inside.

    Parameters
    ----------
    mesh : MeshTri
    values : (k, elements) array

    Returns
    -------
    (k, points) array
    """
    elements = mesh.t.shape[1]
    neighbours = scipy.sparse.csr_matrix(
        (np.ones(3 * elements), (mesh.t.ravel(), np.tile(np.arange(elements), 3))),
        shape=(mesh.p.shape[1], elements),
    )
    border = np.zeros(mesh.p.shape[1])
    border[mesh.boundary_nodes()] = 1.0
    border_patches = scipy.sparse.diags(border) @ neighbours @ neighbours.T @ neighbours
    patches = scipy.sparse.csr_matrix(
        scipy.sparse.diags(1.0 - border) @ neighbours + (border_patches > 0)
    )
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    sums = patches @ np.stack([np.ones(elements), x, y, x * x, x * y, y * y], axis=1)
    n, sx, sy, sxx, sxy, syy = sums.T
    px, py = mesh.p
    # Moments about the point itself, where the height of the plane is the recovered value.
    mx, my = sx - n * px, sy - n * py
    mxx = sxx - 2.0 * px * sx + n * px**2
    mxy = sxy - px * sy - py * sx + n * px * py
    myy = syy - 2.0 * py * sy + n * py**2
    normal_matrix = np.stack([n, mx, my, mx, mxx, mxy, my, mxy, myy], axis=1).reshape(-1, 3, 3)
    recovered = []
    for value in values:
        r0, rx, ry = (patches @ np.stack([value, value * x, value * y], axis=1)).T
        right_side = np.stack([r0, rx - px * r0, ry - py * r0], axis=1)
        recovered.append(np.linalg.solve(normal_matrix, right_side[:, :, None])[:, 0, 0])
    return np.stack(recovered)
