"""Frequency response by Welch's method (H1), for any kind of excitation."""

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import IdentificationSettingError, TooShortError
from rotemina.sim.identification.experiment_signals import ExperimentSignals
from rotemina.sim.identification.frequency_response import (
    MIN_EXCITATION_RATIO,
    FrequencyResponse,
    check_comparable,
    coherence_of,
    find_excited_lines,
)
from rotemina.sim.messages import format_rounded

_MIN_SEGMENT_SAMPLES = 8


def estimate_welch_response(
    *experiments: ExperimentSignals,
    segment: int,
    overlap: float = 0.5,
    excited_above: float = MIN_EXCITATION_RATIO,
) -> FrequencyResponse:
    """Estimate ``H1 = S_yu S_uu⁻¹`` over Hann-windowed segments of one or more experiments.

    Noise on the outputs averages out; noise on the inputs makes H1 too small. The frequency
    resolution is ``rate / segment``. Leakage flattens resonances narrower than about four lines.
    Sources: P. D. Welch, *IEEE Trans. Audio Electroacoust.* 15 (1967) 70; J. S. Bendat,
    A. G. Piersol, *Random Data*, 4th ed., 2010, ch. 9 (deviation ``|H| sqrt((1−γ²)/(γ² K))``).

    Parameters
    ----------
    experiments : ExperimentSignals
        All with the same columns and rate.
    segment : int
        Samples in one segment. The mean of each segment is removed.
    overlap : float
        Overlap of neighbouring segments, 0 to below 1.
    excited_above : float
        Lines whose input amplitude is a smaller share of the largest one are left out.

    Raises
    ------
    IdentificationSettingError
        If the segment is too short or the overlap is out of range.
    TooShortError
        If there are fewer independent segments than inputs + 1.
    InsufficientExcitationError
        If the inputs do not move.
    """
    check_comparable(experiments)
    hop = _compute_hop_samples(segment, overlap)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(segment) / segment)
    counts = [max((experiment.count - segment) // hop + 1, 0) for experiment in experiments]
    averages = sum(_count_independent(count, window, hop) for count in counts)
    inputs, outputs = experiments[0].inputs.shape[1], experiments[0].outputs.shape[1]
    if averages < inputs + 1:
        raise TooShortError(
            "Welch: {averages} independent segments of {segment} samples for {inputs} inputs; "
            "at least {least} are needed, use shorter segments or longer records",
            averages=format_rounded(averages, 2),
            segment=segment,
            inputs=inputs,
            least=inputs + 1,
        )
    spectrum = np.concatenate(
        [_compute_segment_spectra(experiment, window, hop) for experiment in experiments]
    )
    power = np.einsum("ska,skb->kab", spectrum, spectrum.conj()) / len(spectrum)
    lines = find_excited_lines(power[:, :inputs, :inputs], excited_above)
    frequency_hz = lines.astype(np.float64) * (experiments[0].rate_hz / segment)
    power = power[lines]
    input_power, cross_power = power[:, :inputs, :inputs], power[:, inputs:, :inputs]
    inverse = np.linalg.inv(input_power)
    response = cross_power @ inverse
    total = np.einsum("kii->ki", power[:, inputs:, inputs:]).real
    explained = np.einsum("kpm,kpm->kp", response, cross_power.conj()).real
    degrees_of_freedom = averages - inputs
    # Unbiased residual power: each input takes one degree of freedom from the averages.
    residual = np.maximum(total - explained, 0.0) * averages / degrees_of_freedom
    variance_factors = np.einsum("kii->ki", inverse).real / averages
    return FrequencyResponse(
        frequency_hz,
        response,
        np.sqrt(residual[:, :outputs, None] * variance_factors[:, None, :]),
        coherence_of(explained, total),
        degrees_of_freedom,
        experiments[0].rate_hz,
        experiments[0].input_names,
        experiments[0].output_names,
    )


def _compute_hop_samples(segment: int, overlap: float) -> int:
    if segment < _MIN_SEGMENT_SAMPLES:
        raise IdentificationSettingError(
            "Welch: segments of {segment} samples; use {shortest} or more",
            segment=segment,
            shortest=_MIN_SEGMENT_SAMPLES,
        )
    if not 0.0 <= overlap < 1.0:
        raise IdentificationSettingError(
            "Welch: overlap {overlap} is not in [0, 1); use 0.5", overlap=repr(overlap)
        )
    return max(round(segment * (1.0 - overlap)), 1)


def _compute_segment_spectra(
    signals: ExperimentSignals, window: FloatArray, hop: int
) -> ComplexArray:
    """Return the spectra (segments, lines, inputs + outputs) of an experiment."""
    columns = np.hstack([signals.inputs, signals.outputs])
    if len(columns) < len(window):
        return np.empty((0, len(window) // 2 + 1, columns.shape[1]), dtype=np.complex128)
    views = np.lib.stride_tricks.sliding_window_view(columns, len(window), axis=0)[::hop]
    pieces = (views - views.mean(axis=2, keepdims=True)) * window
    return np.fft.rfft(pieces, axis=2).swapaxes(1, 2)


def _count_independent(count: int, window: FloatArray, hop: int) -> float:
    """Return the number of independent segments that are equivalent to ``count`` overlapping ones.

    Source: P. D. Welch 1967, see :func:`estimate_welch_response`.
    """
    if count == 0:
        return 0.0
    window_power = float(window @ window)
    correlation_sum = 1.0
    for distance in range(1, count):
        shift = distance * hop
        if shift >= len(window):
            break
        correlation = float(window[shift:] @ window[:-shift]) / window_power
        correlation_sum += 2.0 * (count - distance) / count * correlation**2
    return count / correlation_sum
