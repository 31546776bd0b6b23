"""Array types shared by the model: double precision throughout."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]


def read_only(array: FloatArray) -> FloatArray:
    """Return a view of ``array`` (any shape) that cannot be written through."""
    view = array.view()
    view.flags.writeable = False
    return view
