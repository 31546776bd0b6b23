"""Curvatures at a mesh's points from those of its elements."""

from typing import TYPE_CHECKING

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray

if TYPE_CHECKING:
    from skfem import MeshTri


def at_points(mesh: "MeshTri", values: FloatArray) -> FloatArray:
    """Return values at points from values that are constant in each element.

    A plane is laid through the values of the elements around each point by least squares (patch
    recovery: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Eng. 33 (1992)); around a point at
    a border through those of its neighbours too, so that the border's value is not taken from
    half an element inside.

    Parameters
    ----------
    values : (k, elements) array

    Returns
    -------
    (k, points) array
    """
    elements = mesh.t.shape[1]
    near = scipy.sparse.csr_matrix(
        (np.ones(3 * elements), (mesh.t.ravel(), np.tile(np.arange(elements), 3))),
        shape=(mesh.p.shape[1], elements),
    )
    border = np.zeros(mesh.p.shape[1])
    border[mesh.boundary_nodes()] = 1.0
    wide = scipy.sparse.diags(border) @ near @ near.T @ near
    patches = scipy.sparse.csr_matrix(scipy.sparse.diags(1.0 - border) @ near + (wide > 0))
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    sums = patches @ np.stack([np.ones(elements), x, y, x * x, x * y, y * y], axis=1)
    n, sx, sy, sxx, sxy, syy = sums.T
    px, py = mesh.p
    # Moments about the point itself, in which the plane's height is what is wanted.
    mx, my = sx - n * px, sy - n * py
    mxx = sxx - 2.0 * px * sx + n * px**2
    mxy = sxy - px * sy - py * sx + n * px * py
    myy = syy - 2.0 * py * sy + n * py**2
    normal = np.stack([n, mx, my, mx, mxx, mxy, my, mxy, myy], axis=1).reshape(-1, 3, 3)
    found = []
    for value in values:
        r0, rx, ry = (patches @ np.stack([value, value * x, value * y], axis=1)).T
        right = np.stack([r0, rx - px * r0, ry - py * r0], axis=1)
        found.append(np.linalg.solve(normal, right[:, :, None])[:, 0, 0])
    return np.stack(found)
