"""How much later a real signal comes than the modelled one."""

import numpy as np
from scipy import signal as dsp

from rotemina.sim.arrays import FloatArray

_ALIKE = 0.5  # correlation below which two signals have no common shift


def delay(time_s: FloatArray, model: FloatArray, real: FloatArray) -> float | None:
    """Return by how many seconds ``real`` (n,) lags ``model`` (n,), or None where none shows.

    The cross-correlation gives the lag in whole samples; a least-squares fit of
    ``real(t) ≈ a + g·model(t − lag) − τ·dmodel/dt`` then refines it below a sample.
    """
    count = len(time_s)
    if count < 8:
        return None
    grid = np.linspace(time_s[0], time_s[-1], count)
    step = float(grid[1] - grid[0])
    modelled, measured = (np.interp(grid, time_s, values) for values in (model, real))
    modelled, measured = modelled - modelled.mean(), measured - measured.mean()
    scale = float(np.linalg.norm(modelled) * np.linalg.norm(measured))
    if scale == 0.0 or not np.isfinite(scale):
        return None
    lags = dsp.correlation_lags(count, count)
    near = np.abs(lags) <= count // 4
    correlation = dsp.correlate(measured, modelled, method="fft")[near]
    if correlation.max() < _ALIKE * scale:
        return None
    lag = int(lags[near][np.argmax(correlation)])
    return lag * step + _refine(modelled, measured, lag, step)


def _refine(model: FloatArray, real: FloatArray, lag: int, step: float) -> float:
    if lag >= 0:
        shifted, measured = model[: len(model) - lag], real[lag:]
    else:
        shifted, measured = model[-lag:], real[:lag]
    slope = np.gradient(shifted, step)
    matrix = np.column_stack([np.ones_like(shifted), shifted, -slope])
    weights = np.linalg.norm(matrix, axis=0)
    if np.any(weights == 0.0):
        return 0.0
    solution, *_ = np.linalg.lstsq(matrix / weights, measured, rcond=None)
    gain, shift = solution[1] / weights[1], solution[2] / weights[2]
    return float(np.clip(shift / gain, -step, step)) if gain > 0 else 0.0
