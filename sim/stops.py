"""Stop operators: the part of a motion by which hysteresis lags behind.

``E_r(x) = x − P_r(x)`` with the play ``P_r = max(x − r, min(x + r, P_r))``: it follows x and stops
at ±r. A weighted sum of them, beside a straight line, is the Prandtl–Ishlinskii model (Kuhnen,
European Journal of Control 9 (2003) 407–418). Its loop is ``2 Σ w r`` wide.
"""

import numba
import numpy as np

from rotemina.sim.arrays import FloatArray


@numba.njit(cache=True, error_model="numpy")
def stops(x: FloatArray, radii: FloatArray, state: FloatArray) -> FloatArray:
    """Return ``E_r`` (n, k) of x (n,) for radii (k,); ``state`` (k,), the plays, continues."""
    result = np.empty((len(x), len(radii)))
    for row in range(len(x)):
        for each in range(len(radii)):
            r = radii[each]
            state[each] = max(x[row] - r, min(x[row] + r, state[each]))
            result[row, each] = x[row] - state[each]
    return result
