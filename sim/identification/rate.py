"""Resampling to a lower rate for identification, with an anti-aliasing filter."""

from dataclasses import replace
from fractions import Fraction
from typing import Literal

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import IdentificationSettingError, TooShortError
from rotemina.sim.identification.experiment_signals import ExperimentSignals
from rotemina.sim.messages import format_rounded

# Edge of the passband, as a share of the new Nyquist frequency.
PASSBAND_NYQUIST_RATIO = 0.8
STOPBAND_DB = 80.0
# Largest denominator of the resampling factor as a fraction.
_MAX_DENOMINATOR = 1000
_MIN_SAMPLES = 8


def resample(signals: ExperimentSignals, factor: float) -> ExperimentSignals:
    """Return the experiment at ``factor`` times its rate, such as 0.15 in the paper.

    All signals pass the same linear-phase low-pass filter in polyphase form (Kaiser window, 80 dB;
    flat up to 0.8 of the new Nyquist frequency, blocking above it). Its delay is compensated. See
    Crochiere and Rabiner, *Multirate Digital Signal Processing*, 1983. Linear relations between
    the signals remain valid in the passband.

    A record of whole periods stays periodic if the new period is a whole number of samples.
    Otherwise the transients of the filter are cut off at both ends.

    Raises
    ------
    IdentificationSettingError
        If the factor is not in (0, 1], or is not a fraction with a denominator up to 1000.
    TooShortError
        If fewer than 8 samples are left.
    """
    up, down = _find_fraction(factor)
    if up == down:
        return signals
    taps = _design_low_pass(up, down)
    is_periodic = _stays_periodic(signals, up, down)
    cut_samples = 0 if is_periodic else -(-(len(taps) // 2) // down)
    inputs, outputs = (
        _resample_columns(values, up, down, taps, "wrap" if is_periodic else "constant")
        for values in (signals.inputs, signals.outputs)
    )
    sample_count = len(inputs) - 2 * cut_samples
    if sample_count < _MIN_SAMPLES:
        raise TooShortError(
            "resampling by {factor}: of {count} samples {left} remain after filtering, "
            "fewer than {shortest}; record longer or use a larger factor",
            factor=factor,
            count=signals.count,
            left=max(sample_count, 0),
            shortest=_MIN_SAMPLES,
        )
    rows = slice(cut_samples, cut_samples + sample_count)
    period = signals.period_samples * up // down if is_periodic and signals.period_samples else None
    return replace(
        signals,
        rate_hz=signals.rate_hz * up / down,
        inputs=inputs[rows],
        outputs=outputs[rows],
        period_samples=period,
    )


def _resample_columns(
    values: FloatArray, up: int, down: int, taps: FloatArray, padding: Literal["wrap", "constant"]
) -> FloatArray:
    # Imported here because the import is slow.
    from scipy.signal import resample_poly

    # Without its mean, the signal has no jumps at the padded ends.
    mean = values.mean(axis=0)
    resampled = resample_poly(  # type: ignore[call-overload]  # the stubs lack an array of taps
        values - mean, up, down, axis=0, window=taps, padtype=padding
    )
    return np.asarray(mean + resampled, dtype=np.float64)


def _find_fraction(factor: float) -> tuple[int, int]:
    if not (np.isfinite(factor) and 0 < factor <= 1):
        raise IdentificationSettingError(
            "resampling factor {factor}: not in (0, 1]; use one such as 0.15", factor=repr(factor)
        )
    fraction = Fraction(factor).limit_denominator(_MAX_DENOMINATOR)
    if abs(float(fraction) - factor) > 1e-9:
        raise IdentificationSettingError(
            "resampling factor {factor}: not a fraction with a denominator up to "
            "{finest}; use {fraction}",
            factor=repr(factor),
            finest=_MAX_DENOMINATOR,
            fraction=format_rounded(float(fraction), 9),
        )
    return fraction.numerator, fraction.denominator


def _design_low_pass(up: int, down: int) -> FloatArray:
    """Return the taps of the filter, an odd number, at ``up`` times the old rate."""
    from scipy.signal import firwin, kaiserord

    tap_count, beta = kaiserord(STOPBAND_DB, (1.0 - PASSBAND_NYQUIST_RATIO) / down)
    cutoff = (1.0 + PASSBAND_NYQUIST_RATIO) / 2.0 / down
    return np.asarray(firwin(tap_count | 1, cutoff, window=("kaiser", beta)), dtype=np.float64)


def _stays_periodic(signals: ExperimentSignals, up: int, down: int) -> bool:
    period = signals.period_samples
    return period is not None and signals.count % period == 0 and period * up % down == 0
