"""The lag of a sensor at a steady interval: a low pass of first order, or a delay."""

from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import FloatArray


class Lag(StrEnum):
    """How a sensor comes late."""

    NONE = "none"
    FIRST_ORDER = "first_order"  # T ẏ + y = q
    DELAY = "delay"  # y(t) = q(t − T)


MOST_S = 0.1


def lagged(signal: FloatArray, kind: Lag, lag_s: float, step_s: float) -> FloatArray:
    """Return a signal (n,) at intervals of ``step_s`` as it comes through the lag.

    Between rows it moves along a straight line, for which both are exact. Before the first row it
    rested there.
    """
    if kind is Lag.NONE or lag_s <= 0.0:
        return signal
    if kind is Lag.DELAY:
        rows = np.arange(len(signal), dtype=np.float64)
        return np.interp(rows - lag_s / step_s, rows, signal)
    pace = step_s / lag_s
    kept = float(np.exp(-pace))
    share = -float(np.expm1(-pace)) / pace
    weights = [1.0 - share, share - kept]
    start = signal[0]
    from scipy.signal import lfilter  # only here: it takes half a second

    output, _ = lfilter(weights, [1.0, -kept], signal - start, zi=[0.0])
    return np.asarray(start + output)


def slope_by_lag(signal: FloatArray, kind: Lag, lag_s: float, step_s: float) -> FloatArray:
    """Return ``d lagged / d T`` (n,), by which a fit finds T; at T = 0 it is −q̇."""
    if kind is Lag.NONE:
        return np.zeros_like(signal)
    small = 0.02 * step_s + 1e-3 * lag_s
    least = max(lag_s - small, 0.0)
    wide = lag_s + small
    return np.asarray(
        (lagged(signal, kind, wide, step_s) - lagged(signal, kind, least, step_s)) / (wide - least)
    )
