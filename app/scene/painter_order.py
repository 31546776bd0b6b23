"""The painting order of solids, so that nearer ones cover farther ones."""

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

# Two boxes count as separate along an axis if they overlap by at most this fraction of the smaller.
_MAX_OVERLAP_RATIO = 0.3


def find_painting_order(
    low: FloatArray, high: FloatArray, eye: FloatArray, is_veil: BoolArray
) -> list[int]:
    """Return the indices of n solids in the order of painting.

    If the boxes of two solids are separate along an axis, the solid on the eye's side of the plane
    between them is painted later. If they overlap, a veil is painted after a solid that is not a
    veil; otherwise the nearer solid is painted later.

    Parameters
    ----------
    low, high : (n, 3)
        Lower and upper corners of the bounding boxes, m.
    eye : (3,)
        Position of the camera, m.
    is_veil : (n,)
        Whether a solid hides nothing.
    """
    size = high - low
    # In each matrix, element [a, b] describes the solids a and b. Here it is the gap from the upper
    # side of a to the lower side of b.
    gap = low[None, :] - high[:, None]
    tolerance = _MAX_OVERLAP_RATIO * np.minimum(size[:, None], size[None, :])
    is_below = (gap >= -tolerance) & ~np.eye(len(low), dtype=bool)[:, :, None]
    # If the eye is between the two, neither solid hides the other.
    middle = (high[:, None] + low[None, :]) / 2
    eye_is_on_lower_side = eye <= np.maximum(low[None, :], middle)
    eye_is_on_upper_side = eye >= np.minimum(high[:, None], middle)
    # Seen from above, the lower solid a cannot hide the upper solid b.
    cannot_hide = np.any(is_below & eye_is_on_upper_side, axis=2)
    cannot_hide |= np.any(is_below & eye_is_on_lower_side, axis=2).T
    is_separate = np.any(is_below, axis=2)
    is_separate |= is_separate.T
    eye_distance = np.linalg.norm((low + high) / 2 - eye, axis=1)
    is_later = np.where(
        is_veil[:, None] == is_veil[None, :],
        eye_distance[:, None] < eye_distance[None, :],
        is_veil[:, None] > is_veil[None, :],
    )
    hides = np.where(is_separate, ~cannot_hide, is_later)
    np.fill_diagonal(hides, False)
    # For each solid, the number of solids that it may hide and that are not painted yet.
    unpainted_count = hides.sum(axis=1).astype(float)
    order = []
    for _ in range(len(low)):
        next_index = int(np.lexsort((-eye_distance, unpainted_count))[0])
        order.append(next_index)
        unpainted_count -= hides[:, next_index]
        unpainted_count[next_index] = np.inf
    return order
