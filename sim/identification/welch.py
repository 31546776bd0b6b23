"""Frequency response by Welch's method (H1), for any excitation."""

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.identification.errors import SettingError, TooShortError
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.frequency_response import (
    EXCITED_ABOVE,
    FrequencyResponse,
    check_alike,
    coherence_of,
    excited_lines,
)
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

_SHORTEST = 8


def welch_response(
    *experiments: Signals,
    segment: int,
    overlap: float = 0.5,
    excited_above: float = EXCITED_ABOVE,
) -> FrequencyResponse:
    """Estimate ``H1 = S_yu S_uu⁻¹`` over Hann-windowed segments of one or more experiments.

    Noise on the outputs averages out; noise on the inputs makes H1 too small. Frequencies are
    resolved to ``rate / segment``; resonances narrower than about four lines are flattened by
    leakage. Sources: P. D. Welch, *IEEE Trans. Audio Electroacoust.* 15 (1967) 70; J. S. Bendat,
    A. G. Piersol, *Random Data*, 4th ed., 2010, ch. 9 (deviation ``|H| sqrt((1−γ²)/(γ² K))``).

    Parameters
    ----------
    experiments : of the same columns and rate.
    segment : samples in one segment; the mean of each is taken out.
    overlap : of neighbours, 0 to below 1.
    excited_above : lines with less input amplitude, over the largest, are left out.

    Raises
    ------
    SettingError, TooShortError, ExcitationError
        If fewer independent segments than inputs + 1 remain, or the inputs do not move.
    """
    check_alike(experiments)
    hop = _hop(segment, overlap)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(segment) / segment)
    counts = [max((each.count - segment) // hop + 1, 0) for each in experiments]
    averages = sum(_independent(count, window, hop) for count in counts)
    inputs, outputs = experiments[0].inputs.shape[1], experiments[0].outputs.shape[1]
    if averages < inputs + 1:
        raise TooShortError(
            message(
                "engine",
                "Welch: {averages} independent segments of {segment} samples for {inputs} inputs; "
                "at least {least} are needed, use shorter segments or longer records",
            ).fill(averages=rounded(averages, 2), segment=segment, inputs=inputs, least=inputs + 1)
        )
    spectrum = np.concatenate([_spectra(each, window, hop) for each in experiments])
    power = np.einsum("ska,skb->kab", spectrum, spectrum.conj()) / len(spectrum)
    lines = excited_lines(power[:, :inputs, :inputs], excited_above)
    frequency_hz = lines.astype(np.float64) * (experiments[0].rate_hz / segment)
    power = power[lines]
    driven, cross = power[:, :inputs, :inputs], power[:, inputs:, :inputs]
    inverse = np.linalg.inv(driven)
    response = cross @ inverse
    total = np.einsum("kii->ki", power[:, inputs:, inputs:]).real
    explained = np.einsum("kpm,kpm->kp", response, cross.conj()).real
    degrees = averages - inputs
    rest = np.maximum(total - explained, 0.0) * averages / degrees
    spread = np.einsum("kii->ki", inverse).real / averages
    return FrequencyResponse(
        frequency_hz,
        response,
        np.sqrt(rest[:, :outputs, None] * spread[:, None, :]),
        coherence_of(explained, total),
        degrees,
        experiments[0].rate_hz,
        experiments[0].input_names,
        experiments[0].output_names,
    )


def _hop(segment: int, overlap: float) -> int:
    if segment < _SHORTEST:
        raise SettingError(
            message("engine", "Welch: segments of {segment} samples; use {shortest} or more").fill(
                segment=segment, shortest=_SHORTEST
            )
        )
    if not 0.0 <= overlap < 1.0:
        raise SettingError(
            message("engine", "Welch: overlap {overlap} is not in [0, 1); use 0.5").fill(
                overlap=repr(overlap)
            )
        )
    return max(round(segment * (1.0 - overlap)), 1)


def _spectra(signals: Signals, window: FloatArray, hop: int) -> ComplexArray:
    """Return the spectra (segments, lines, inputs + outputs) of an experiment."""
    columns = np.hstack([signals.inputs, signals.outputs])
    if len(columns) < len(window):
        return np.empty((0, len(window) // 2 + 1, columns.shape[1]), dtype=np.complex128)
    views = np.lib.stride_tricks.sliding_window_view(columns, len(window), axis=0)[::hop]
    pieces = (views - views.mean(axis=2, keepdims=True)) * window
    return np.fft.rfft(pieces, axis=2).swapaxes(1, 2)


def _independent(count: int, window: FloatArray, hop: int) -> float:
    """Return how many independent segments as many overlapping ones are worth (Welch 1967)."""
    if count == 0:
        return 0.0
    whole = float(window @ window)
    shared = 1.0
    for number in range(1, count):
        later = number * hop
        if later >= len(window):
            break
        alike = float(window[later:] @ window[:-later]) / whole
        shared += 2.0 * (count - number) / count * alike**2
    return count / shared
