"""Array types that all modules share, and decimation for drawing.

Floating-point numbers have double precision.
"""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.compatibility import serve_former_names

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


def make_read_only(array: FloatArray) -> FloatArray:
    """Return a read-only view of ``array`` (any shape)."""
    view = array.view()
    view.flags.writeable = False
    return view


def decimate_to_envelope(
    time_s: FloatArray, values: FloatArray, buckets: int
) -> tuple[FloatArray, FloatArray]:
    """Return at most ``2·buckets`` points: the lowest and the highest value of each bucket.

    Parameters
    ----------
    time_s, values : (n,)
    buckets : int
        Number of groups of neighbouring samples, each drawn by two points. About one group per
        pixel is enough.

    Returns
    -------
    time_s, values : (k,), k = min(n, 2·buckets) or a few less
        In time order. A short signal is returned unchanged.
    """
    sample_count = len(values)
    if sample_count <= 2 * buckets:
        return time_s, values
    bucket_size = -(-sample_count // buckets)
    full_rows = sample_count // bucket_size * bucket_size
    full_buckets = values[:full_rows].reshape(-1, bucket_size)
    extreme_rows = np.stack([full_buckets.argmin(axis=1), full_buckets.argmax(axis=1)], axis=1)
    extreme_rows.sort(axis=1)
    index = (extreme_rows + bucket_size * np.arange(len(full_buckets))[:, None]).ravel()
    if full_rows < sample_count:
        last_bucket = values[full_rows:]
        index = np.append(index, full_rows + np.sort([last_bucket.argmin(), last_bucket.argmax()]))
    return time_s[index], values[index]


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(__name__, read_only="make_read_only")
