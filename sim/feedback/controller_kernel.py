"""One sample of the controller's recurrence, compiled."""

import numba

from rotemina.sim.arrays import FloatArray

# Indices of the parameters. MAX_PLAUSIBLE_ERROR is the largest error that is used; a larger one is
# attributed to a wrong reading.
P, I_STEP, D_STEP, D_POLE, BACK, CONDITIONAL, LOW, HIGH, MAX_STEP = range(9)
NOTCH, LOW_PASS, J_STEP, MAX_PLAUSIBLE_ERROR, NUMBER_COUNT = 9, 14, 19, 20, 21

# Indices of the memory. DRIFT is the change of the integral per sample that the second integral
# causes. OUTPUT is the output after the limits, and UNLIMITED_OUTPUT that before them.
INTEGRAL, SLOPE, ERROR, NOTCH_MEMORY, LOW_PASS_MEMORY, DRIFT, OUTPUT, UNLIMITED_OUTPUT = (
    0,
    1,
    2,
    3,
    5,
    7,
    8,
    9,
)
# Away from the limits, only the first LINEAR_COUNT entries act on the output.
LINEAR_COUNT, MEMORY_COUNT = 8, 10


@numba.njit(cache=True, error_model="numpy", inline="always")
def _filter_sample(p: FloatArray, first: int, s: FloatArray, memory: int, x: float) -> float:
    y = p[first] * x + s[memory]
    s[memory] = p[first + 1] * x - p[first + 3] * y + s[memory + 1]
    s[memory + 1] = p[first + 2] * x - p[first + 4] * y
    return float(y)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def control(p: FloatArray, s: FloatArray, error: float, feed: float) -> float:
    """Return the output for the error of a sample, with the feed-forward added.

    ``J_k = J_{k−1} + J h² e_k``; ``I_k = I_{k−1} + I h e_k + J_k``;
    ``D_k = a D_{k−1} + D (1 − a)/h (e_k − e_{k−1})``, ``a = exp(−h/T)``.
    """
    e = _filter_sample(p, NOTCH, s, NOTCH_MEMORY, error)
    e = _filter_sample(p, LOW_PASS, s, LOW_PASS_MEMORY, e)
    s[SLOPE] = p[D_POLE] * s[SLOPE] + p[D_STEP] * (e - s[ERROR])
    s[ERROR] = e
    drift = s[DRIFT] + p[J_STEP] * e
    integral = s[INTEGRAL] + p[I_STEP] * e + drift
    unlimited = feed + p[P] * e + integral + s[SLOPE]
    low, high = max(p[LOW], s[OUTPUT] - p[MAX_STEP]), min(p[HIGH], s[OUTPUT] + p[MAX_STEP])
    output = min(max(unlimited, low), high)
    excess = unlimited - output
    if p[CONDITIONAL] == 0.0:
        integral -= p[BACK] * excess
        # At a limit the second integral must not drive the output further.
        if excess != 0.0:
            drift = (1.0 - p[BACK]) * s[DRIFT]
    elif excess * e > 0.0:
        integral, drift = s[INTEGRAL], 0.0
    s[INTEGRAL], s[DRIFT], s[OUTPUT], s[UNLIMITED_OUTPUT] = integral, drift, output, unlimited
    return float(output)
