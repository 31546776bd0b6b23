"""Linear filters on the fine grid that start at rest with their first value."""

from math import pi

import numpy as np
import scipy

from rotemina.sim.arrays import ComplexArray, FloatArray


def lagged(values: FloatArray, poles: ComplexArray | FloatArray, step_s: float) -> FloatArray:
    """Filter ``values`` (n,) by a low-pass with the given ``poles`` (1/s) and static gain 1."""
    numerator = np.atleast_1d(np.float64(np.real(np.prod(-poles))))
    denominator = np.asarray(np.real(np.poly(poles)), np.float64)
    digital = scipy.signal.cont2discrete((numerator, denominator), step_s, "foh")
    sections = scipy.signal.tf2sos(np.ravel(digital[0]), digital[1])
    settled = scipy.signal.sosfilt_zi(sections) * values[0]
    return np.asarray(scipy.signal.sosfilt(sections, values, zi=settled)[0])


def mode_poles(frequency_hz: float, damping_ratio: float) -> ComplexArray:
    """Return the pair of poles (1/s) of a mode."""
    rate = 2.0 * pi * frequency_hz
    return np.asarray(np.roots([1.0, 2.0 * damping_ratio * rate, rate**2]), np.complex128)


def shifted(values: FloatArray, steps: FloatArray | float) -> FloatArray:
    """Return ``values`` (n,) later by a fractional number of fine steps (a number or (n,))."""
    index = np.arange(len(values), dtype=np.float64)
    return np.interp(index - steps, index, values)


def smoothly_shifted(values: FloatArray, steps: FloatArray) -> FloatArray:
    """Return a smooth signal (n,) later by ``steps`` (n,), through cubics over four fine steps.

    A straight line between fine steps would leave more of a resonance than a sensor's noise.
    """
    n = len(values)
    at = np.clip(np.arange(n) - steps, 0.0, n - 1.0)
    first = np.clip(np.floor(at).astype(np.int64) - 1, 0, n - 4)
    x = at - first
    weights = (
        -(x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0,
        x * (x - 2.0) * (x - 3.0) / 2.0,
        -x * (x - 1.0) * (x - 3.0) / 2.0,
        x * (x - 1.0) * (x - 2.0) / 6.0,
    )
    return np.asarray(sum(weight * values[first + k] for k, weight in enumerate(weights)))
