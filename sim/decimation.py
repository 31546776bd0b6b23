"""Fewer points for a drawing, without hiding what the signal does between them."""

import numpy as np

from rotemina.sim.arrays import FloatArray


def envelope(time_s: FloatArray, values: FloatArray, buckets: int) -> tuple[FloatArray, FloatArray]:
    """Return at most ``2·buckets`` points that keep every bucket's lowest and highest value.

    Parameters
    ----------
    time_s, values : (n,)
    buckets : int
        How many runs of neighbouring samples to draw, each by two points; about one a pixel.

    Returns
    -------
    time_s, values : (k,), k = min(n, 2·buckets) or a few less
        In the order of time within each bucket. A short signal comes back as it is.
    """
    count = len(values)
    if count <= 2 * buckets:
        return time_s, values
    size = -(-count // buckets)
    whole = count // size * size
    blocks = values[:whole].reshape(-1, size)
    rows = np.stack([blocks.argmin(axis=1), blocks.argmax(axis=1)], axis=1)
    rows.sort(axis=1)
    index = (rows + size * np.arange(len(blocks))[:, None]).ravel()
    if whole < count:
        rest = values[whole:]
        index = np.append(index, whole + np.sort([rest.argmin(), rest.argmax()]))
    return time_s[index], values[index]
