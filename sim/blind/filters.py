"""Linear filters on the fine grid. Each starts in its steady state at the first value."""

from math import pi

import numpy as np
import scipy

from rotemina.sim.arrays import ComplexArray, FloatArray


def apply_low_pass(
    values: FloatArray, poles: ComplexArray | FloatArray, step_s: float
) -> FloatArray:
    """Filter ``values`` (n,) by a low-pass with the given ``poles`` (1/s) and static gain 1."""
    numerator = np.atleast_1d(np.float64(np.real(np.prod(-poles))))
    denominator = np.asarray(np.real(np.poly(poles)), np.float64)
    digital = scipy.signal.cont2discrete((numerator, denominator), step_s, "foh")
    sections = scipy.signal.tf2sos(np.ravel(digital[0]), digital[1])
    settled = scipy.signal.sosfilt_zi(sections) * values[0]
    return np.asarray(scipy.signal.sosfilt(sections, values, zi=settled)[0])


def compute_mode_poles(frequency_hz: float, damping_ratio: float) -> ComplexArray:
    """Return the pole pair (1/s) of a mode."""
    rate = 2.0 * pi * frequency_hz
    return np.asarray(np.roots([1.0, 2.0 * damping_ratio * rate, rate**2]), np.complex128)


def delay_signal(values: FloatArray, steps: FloatArray | float) -> FloatArray:
    """Delay ``values`` (n,) by a fractional number of fine steps, a scalar or (n,)."""
    index = np.arange(len(values), dtype=np.float64)
    return np.interp(index - steps, index, values)


def delay_smooth_signal(values: FloatArray, steps: FloatArray) -> FloatArray:
    """Delay a smooth signal (n,) by ``steps`` (n,), with cubics over four fine steps.

    Linear interpolation would distort a resonance by more than the noise of a sensor.
    """
    n = len(values)
    read_positions = np.clip(np.arange(n) - steps, 0.0, n - 1.0)
    first_row = np.clip(np.floor(read_positions).astype(np.int64) - 1, 0, n - 4)
    offset = read_positions - first_row
    weights = (
        -(offset - 1.0) * (offset - 2.0) * (offset - 3.0) / 6.0,
        offset * (offset - 2.0) * (offset - 3.0) / 2.0,
        -offset * (offset - 1.0) * (offset - 3.0) / 2.0,
        offset * (offset - 1.0) * (offset - 2.0) / 6.0,
    )
    return np.asarray(sum(weight * values[first_row + k] for k, weight in enumerate(weights)))
