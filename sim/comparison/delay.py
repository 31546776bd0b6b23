"""The delay of a real signal relative to the modelled one."""

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray, IntArray

_ALIKE = 0.5  # correlation below which two signals have no common shift
_CONVERGED = 1e-3  # of a sample
_MOST_STEPS = 20


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
    lags, correlation = _correlate(modelled, measured, longest=count // 4)
    if correlation.max() < _ALIKE * scale:
        return None
    start = float(lags[np.argmax(correlation)]) * step
    return _refine(grid, modelled, measured, start)


def _correlate(model: FloatArray, real: FloatArray, longest: int) -> tuple[IntArray, FloatArray]:
    """Return ``Σ real[k + lag]·model[k]`` for every lag up to ``longest`` samples either way."""
    size = scipy.fft.next_fast_len(len(model) + longest, real=True)
    spectrum = scipy.fft.rfft(real, size) * np.conj(scipy.fft.rfft(model, size))
    circular = scipy.fft.irfft(spectrum, size)
    lags = np.arange(-longest, longest + 1)
    return lags, circular[lags]


def _refine(time_s: FloatArray, model: FloatArray, real: FloatArray, start_s: float) -> float:
    """Gauss–Newton from a lag in whole samples; stays there where it does not converge."""
    step, longest = time_s[1] - time_s[0], 0.25 * (time_s[-1] - time_s[0])
    slope = np.gradient(model, step)
    lag = start_s
    for _ in range(_MOST_STEPS):
        seen = (time_s - lag >= time_s[0]) & (time_s - lag <= time_s[-1])
        moved, steep = (np.interp(time_s[seen] - lag, time_s, x) for x in (model, slope))
        matrix = np.column_stack([np.ones_like(moved), moved, -steep])
        weights = np.linalg.norm(matrix, axis=0)
        if np.any(weights == 0.0):
            return start_s
        solution, *_ = np.linalg.lstsq(matrix / weights, real[seen], rcond=None)
        gain, shift = solution[1:] / weights[1:]
        if gain <= 0 or abs(lag + shift / gain) > longest:
            return start_s
        lag += float(shift / gain)
        if abs(shift / gain) < _CONVERGED * step:
            return lag
    return start_s
