"""The lag of a sensor that is sampled at a constant interval: a first-order low-pass or a delay."""

from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray


class SensorLag(StrEnum):
    """The kind of a sensor's lag."""

    NONE = "none"
    # T ẏ + y = q
    FIRST_ORDER = "first_order"
    # y(t) = q(t − T)
    DELAY = "delay"


MAX_LAG_S = 0.1


def apply_lag(signal: FloatArray, kind: SensorLag, lag_s: float, step_s: float) -> FloatArray:
    """Return a signal (n,) at intervals of ``step_s`` after the lag.

    Both kinds are exact for a signal that is linear between rows. Before the first row, the signal
    is assumed to rest at its first value.
    """
    if kind is SensorLag.NONE or lag_s <= 0.0:
        return signal
    if kind is SensorLag.DELAY:
        rows = np.arange(len(signal), dtype=np.float64)
        return np.interp(rows - lag_s / step_s, rows, signal)
    ratio = step_s / lag_s
    decay = float(np.exp(-ratio))
    mean_decay = -float(np.expm1(-ratio)) / ratio
    weights = [1.0 - mean_decay, mean_decay - decay]
    start = signal[0]
    # Imported here because the import takes half a second.
    from scipy.signal import lfilter

    output, _ = lfilter(weights, [1.0, -decay], signal - start, zi=[0.0])
    return np.asarray(start + output)


def compute_lag_slope(
    signal: FloatArray, kind: SensorLag, lag_s: float, step_s: float
) -> FloatArray:
    """Return the derivative (n,) of the lagged signal with respect to T; at T = 0 it is −q̇."""
    if kind is SensorLag.NONE:
        return np.zeros_like(signal)
    half_step = 0.02 * step_s + 1e-3 * lag_s
    lower = max(lag_s - half_step, 0.0)
    upper = lag_s + half_step
    return np.asarray(
        (apply_lag(signal, kind, upper, step_s) - apply_lag(signal, kind, lower, step_s))
        / (upper - lower)
    )
