"""The painting order of solids, so that nearer ones cover farther ones."""

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_TOUCHING = 0.3  # of the smaller of two sizes: solids that overlap by less are beside each other


def painter_order(low: FloatArray, high: FloatArray, eye: FloatArray, veil: BoolArray) -> list[int]:
    """Return the numbers of n solids in the order of painting.

    Of two boxes beside each other along an axis, the one on the eye's side of a plane between
    them is painted later. Of two that overlap a veil is painted later, or else the nearer one.

    Parameters
    ----------
    low, high : (n, 3), m, corners of the boxes about them.
    eye : (3,), m.
    veil : (n,), what hides nothing.
    """
    size = high - low
    gap = low[None, :] - high[:, None]  # [a, b]: from a up to b
    slack = _TOUCHING * np.minimum(size[:, None], size[None, :])
    below = (gap >= -slack) & ~np.eye(len(low), dtype=bool)[:, :, None]
    middle = (high[:, None] + low[None, :]) / 2  # between them neither hides the other
    lower_side = eye <= np.maximum(low[None, :], middle)
    upper_side = eye >= np.minimum(high[:, None], middle)
    cannot = np.any(below & upper_side, axis=2)  # a does not hide the b above it
    cannot |= np.any(below & lower_side, axis=2).T
    apart = np.any(below, axis=2)
    apart |= apart.T
    far = np.linalg.norm((low + high) / 2 - eye, axis=1)
    later = np.where(
        veil[:, None] == veil[None, :], far[:, None] < far[None, :], veil[:, None] > veil[None, :]
    )
    hides = np.where(apart, ~cannot, later)
    np.fill_diagonal(hides, False)
    waiting = hides.sum(axis=1).astype(float)  # how many a solid may hide that are not yet painted
    order = []
    for _ in range(len(low)):
        chosen = int(np.lexsort((-far, waiting))[0])
        order.append(chosen)
        waiting -= hides[:, chosen]
        waiting[chosen] = np.inf
    return order
