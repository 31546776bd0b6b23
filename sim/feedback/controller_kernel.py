"""The recurrence of the controller, compiled: one sample of it."""

import numba

from rotemina.sim.arrays import FloatArray

# Places of the numbers. BELIEVED: the greatest error that is answered; a larger one is no reading.
P, I_STEP, D_STEP, D_POLE, BACK, CONDITIONAL, LOW, HIGH, MOST = range(9)
NOTCH, LOW_PASS, J_STEP, BELIEVED, NUMBERS = 9, 14, 19, 20, 21

# Places of the memory. DRIFT: by how much the second integral moves the first at each sample.
# OUTPUT, ASKED: what was put out, and what would have been without limits.
INTEGRAL, SLOPE, ERROR, NOTCH_MEMORY, LOW_PASS_MEMORY, DRIFT, OUTPUT, ASKED = 0, 1, 2, 3, 5, 7, 8, 9
LINEAR, MEMORY = 8, 10  # the first LINEAR of them act on the output, away from its limits


@numba.njit(cache=True, error_model="numpy", inline="always")
def _filtered(p: FloatArray, first: int, s: FloatArray, memory: int, x: float) -> float:
    """Send a sample through a biquad, in the second direct form transposed."""
    y = p[first] * x + s[memory]
    s[memory] = p[first + 1] * x - p[first + 3] * y + s[memory + 1]
    s[memory + 1] = p[first + 2] * x - p[first + 4] * y
    return float(y)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def control(p: FloatArray, s: FloatArray, error: float, feed: float) -> float:
    """Return the output for the error of a sample, beside the feed-forward.

    ``J_k = J_{k−1} + J h² e_k``; ``I_k = I_{k−1} + I h e_k + J_k``;
    ``D_k = a D_{k−1} + D (1 − a)/h (e_k − e_{k−1})``, ``a = exp(−h/T)``.
    """
    e = _filtered(p, NOTCH, s, NOTCH_MEMORY, error)
    e = _filtered(p, LOW_PASS, s, LOW_PASS_MEMORY, e)
    s[SLOPE] = p[D_POLE] * s[SLOPE] + p[D_STEP] * (e - s[ERROR])
    s[ERROR] = e
    drift = s[DRIFT] + p[J_STEP] * e
    integral = s[INTEGRAL] + p[I_STEP] * e + drift
    asked = feed + p[P] * e + integral + s[SLOPE]
    low, high = max(p[LOW], s[OUTPUT] - p[MOST]), min(p[HIGH], s[OUTPUT] + p[MOST])
    output = min(max(asked, low), high)
    beyond = asked - output
    if p[CONDITIONAL] == 0.0:
        integral -= p[BACK] * beyond
        if beyond != 0.0:  # what is at a limit goes no further, however fast it came
            drift = (1.0 - p[BACK]) * s[DRIFT]
    elif beyond * e > 0.0:
        integral, drift = s[INTEGRAL], 0.0
    s[INTEGRAL], s[DRIFT], s[OUTPUT], s[ASKED] = integral, drift, output, asked
    return float(output)
