"""The delay of a real signal relative to the modelled one."""

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, IntArray

# Below this correlation, the signals do not match at any shift.
_MIN_CORRELATION = 0.5
_CONVERGENCE_SAMPLES = 1e-3
_MAX_STEPS = 20


def estimate_delay(time_s: FloatArray, model: FloatArray, real: FloatArray) -> float | None:
    """Return the time, s, by which ``real`` (n,) lags ``model`` (n,), or None if it is unclear.

    The cross-correlation gives the lag in whole samples. A least-squares fit of
    ``real(t) ≈ a + g·model(t − lag) − τ·dmodel/dt`` then refines it below a sample.
    """
    count = len(time_s)
    if count < 8:
        return None
    grid = np.linspace(time_s[0], time_s[-1], count)
    step_s = float(grid[1] - grid[0])
    modelled, measured = (np.interp(grid, time_s, values) for values in (model, real))
    modelled, measured = modelled - modelled.mean(), measured - measured.mean()
    scale = float(np.linalg.norm(modelled) * np.linalg.norm(measured))
    if scale == 0.0 or not np.isfinite(scale):
        return None
    lags, correlation = _correlate(modelled, measured, max_lag=count // 4)
    if correlation.max() < _MIN_CORRELATION * scale:
        return None
    start_s = float(lags[np.argmax(correlation)]) * step_s
    return _refine(grid, modelled, measured, start_s)


def _correlate(model: FloatArray, real: FloatArray, max_lag: int) -> tuple[IntArray, FloatArray]:
    """Return the lags up to ``max_lag`` samples either way, and ``Σ real[k + lag]·model[k]``."""
    size = scipy.fft.next_fast_len(len(model) + max_lag, real=True)
    spectrum = scipy.fft.rfft(real, size) * np.conj(scipy.fft.rfft(model, size))
    circular = scipy.fft.irfft(spectrum, size)
    lags = np.arange(-max_lag, max_lag + 1)
    return lags, circular[lags]


def _refine(time_s: FloatArray, model: FloatArray, real: FloatArray, start_s: float) -> float:
    """Refine a lag in whole samples by Gauss–Newton.

    Returns the initial lag if the iteration does not converge.
    """
    step_s, max_lag_s = time_s[1] - time_s[0], 0.25 * (time_s[-1] - time_s[0])
    slope = np.gradient(model, step_s)
    lag_s = start_s
    for _ in range(_MAX_STEPS):
        overlapping = (time_s - lag_s >= time_s[0]) & (time_s - lag_s <= time_s[-1])
        shifted, shifted_slope = (
            np.interp(time_s[overlapping] - lag_s, time_s, x) for x in (model, slope)
        )
        matrix = np.column_stack([np.ones_like(shifted), shifted, -shifted_slope])
        norms = np.linalg.norm(matrix, axis=0)
        if np.any(norms == 0.0):
            return start_s
        solution, *_ = np.linalg.lstsq(matrix / norms, real[overlapping], rcond=None)
        gain, shift = solution[1:] / norms[1:]
        if gain <= 0 or abs(lag_s + shift / gain) > max_lag_s:
            return start_s
        lag_s += float(shift / gain)
        if abs(shift / gain) < _CONVERGENCE_SAMPLES * step_s:
            return lag_s
    return start_s
