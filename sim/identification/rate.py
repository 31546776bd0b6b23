"""A lower sampling rate for identification, without folding fast content into the band."""

from dataclasses import replace
from fractions import Fraction
from typing import Literal

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.errors import SettingError, TooShortError
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

PASSBAND = 0.8  # of the new Nyquist frequency, up to which signals pass unchanged
STOPBAND_DB = 80.0
_FINEST = 1000  # largest denominator of a factor
_SHORTEST = 8


def resample(signals: Signals, factor: float) -> Signals:
    """Return the experiment at ``factor`` times its rate, such as the paper's 0.15.

    All signals go through the same linear-phase low-pass filter (Kaiser window, 80 dB; flat up to
    0.8 of the new Nyquist frequency and shut above it), whose delay is taken out, in polyphase
    form (Crochiere and Rabiner, *Multirate Digital Signal Processing*, 1983). A linear relation
    between them is kept in the passband. A periodic record of whole periods stays one where the
    new period has whole samples; else the filter's length is cut off at both ends.

    Raises
    ------
    SettingError
        If the factor is not in (0, 1] or no fraction with a denominator up to 1000.
    TooShortError
        If fewer than 8 samples are left.
    """
    up, down = _fraction(factor)
    if up == down:
        return signals
    taps = _low_pass(up, down)
    periodic = _stays_periodic(signals, up, down)
    lost = 0 if periodic else -(-(len(taps) // 2) // down)
    driven, answer = (
        _moved(values, up, down, taps, "wrap" if periodic else "constant")
        for values in (signals.inputs, signals.outputs)
    )
    left = len(driven) - 2 * lost
    if left < _SHORTEST:
        raise TooShortError(
            message(
                "engine",
                "resampling by {factor}: {count} samples leave {left} after the filter, fewer than "
                "{shortest}; record longer or lower the rate less",
            ).fill(factor=factor, count=signals.count, left=max(left, 0), shortest=_SHORTEST)
        )
    kept = slice(lost, lost + left)
    period = signals.period_samples * up // down if periodic and signals.period_samples else None
    return replace(
        signals,
        rate_hz=signals.rate_hz * up / down,
        inputs=driven[kept],
        outputs=answer[kept],
        period_samples=period,
    )


def _moved(
    values: FloatArray, up: int, down: int, taps: FloatArray, padding: Literal["wrap", "constant"]
) -> FloatArray:
    from scipy.signal import resample_poly  # takes its time to import

    mean = values.mean(axis=0)
    low = resample_poly(  # type: ignore[call-overload]  # the stubs lack an array of taps
        values - mean, up, down, axis=0, window=taps, padtype=padding
    )
    return np.asarray(mean + low, dtype=np.float64)


def _fraction(factor: float) -> tuple[int, int]:
    if not (np.isfinite(factor) and 0 < factor <= 1):
        raise SettingError(
            message(
                "engine", "resampling factor {factor}: not in (0, 1]; use one such as 0.15"
            ).fill(factor=repr(factor))
        )
    fraction = Fraction(factor).limit_denominator(_FINEST)
    if abs(float(fraction) - factor) > 1e-9:
        raise SettingError(
            message(
                "engine",
                "resampling factor {factor}: not a fraction with a denominator up to "
                "{finest}; use {fraction}",
            ).fill(factor=repr(factor), finest=_FINEST, fraction=rounded(float(fraction), 9))
        )
    return fraction.numerator, fraction.denominator


def _low_pass(up: int, down: int) -> FloatArray:
    """Return the filter's odd number of taps at ``up`` times the old rate."""
    from scipy.signal import firwin, kaiserord

    count, beta = kaiserord(STOPBAND_DB, (1.0 - PASSBAND) / down)
    middle = (1.0 + PASSBAND) / 2.0 / down
    return np.asarray(firwin(count | 1, middle, window=("kaiser", beta)), dtype=np.float64)


def _stays_periodic(signals: Signals, up: int, down: int) -> bool:
    period = signals.period_samples
    return period is not None and signals.count % period == 0 and period * up % down == 0
