"""Responses to periodic excitation: exact averages on each line, with noise and distortion."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import (
    ComplexArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.errors import IdentificationSettingError, TooShortError
from rotemina.sim.identification.experiment_signals import ExperimentSignals
from rotemina.sim.identification.frequency_response import (
    MIN_EXCITATION_RATIO,
    FrequencyResponse,
    check_comparable,
    coherence_of,
    find_excited_lines,
)


@dataclass(frozen=True, slots=True, eq=False)
class PeriodicResponse:
    """The response on the excited lines of periodic experiments.

    Attributes
    ----------
    lines : (k,)
        Excited lines, in multiples of rate / period.
    total : FrequencyResponse
        Response, whose deviation is that from experiment to experiment, which includes everything
        that is not linear. With only as many experiments as inputs, it is the deviation by noise.
    noise_deviation : (k, p, m)
        Standard deviation of the response by noise alone, from period to period.
    output_rms, noise_rms : (p,)
        RMS of the averaged output on the excited lines, and of its noise.
    distortion_rms : (p,) or None
        Stochastic non-linear distortion above the noise on those lines, in one experiment. None
        with only as many experiments as inputs.
    period_samples, periods : int
        Length of a period, and number of periods averaged in each experiment.
    """

    lines: IntArray
    total: FrequencyResponse
    noise_deviation: FloatArray
    output_rms: FloatArray
    noise_rms: FloatArray
    distortion_rms: FloatArray | None
    period_samples: int
    periods: int


@dataclass(frozen=True, slots=True, eq=False)
class PeriodSpectra:
    """Complex amplitudes of one experiment's lines, averaged over its periods.

    Attributes
    ----------
    inputs : (lines, m)
        Mean peak amplitudes of the inputs, in their units.
    outputs : (lines, p)
        Mean peak amplitudes of the outputs, in their units.
    noise : (lines, p)
        Variance of the averaged outputs.
    periods : int
        Number of averaged periods.
    period_samples : int
        Length of a period.
    """

    inputs: ComplexArray
    outputs: ComplexArray
    noise: FloatArray
    periods: int
    period_samples: int


def average_periods(signals: ExperimentSignals, skip_periods: int = 0) -> PeriodSpectra:
    """Average an experiment line by line over its whole periods.

    Parameters
    ----------
    signals : ExperimentSignals
        A periodic experiment with at least two whole periods after the skipped ones.
    skip_periods : int
        Number of periods to skip at the beginning, because of transients.

    Raises
    ------
    IdentificationSettingError
        If the period is not known.
    TooShortError
        If fewer than two periods are left.
    """
    period = signals.period_samples
    if period is None or period < 2 or skip_periods < 0:
        raise IdentificationSettingError(
            "periodic response: a period of {period} samples, {skip_periods} periods skipped; "
            "the record needs '# history: periodic' and '# period_samples: N'",
            period=str(period),
            skip_periods=skip_periods,
        )
    periods = signals.count // period - skip_periods
    if periods < 2:
        raise TooShortError(
            "periodic response: {periods} whole periods of {period} samples after "
            "{skip_periods} skipped; the noise needs at least 2",
            periods=max(periods, 0),
            period=period,
            skip_periods=skip_periods,
        )
    rows = slice(skip_periods * period, (skip_periods + periods) * period)
    inputs, outputs = (
        np.fft.rfft(values[rows].reshape(periods, period, -1), axis=1) * (2.0 / period)
        for values in (signals.inputs, signals.outputs)
    )
    noise = np.var(outputs, axis=0, ddof=1) / periods
    return PeriodSpectra(inputs.mean(axis=0), outputs.mean(axis=0), noise, periods, period)


def estimate_periodic_response(
    *experiments: ExperimentSignals,
    excited_above: float = MIN_EXCITATION_RATIO,
    skip_periods: int = 0,
) -> PeriodicResponse:
    """Estimate the response on the excited lines of multisines in steady state.

    There is no leakage and no window: on each line ``H = Y Uᴴ (U Uᴴ)⁻¹`` over the experiments,
    which must be at least as many as the inputs. The spread from experiment to experiment contains
    noise and non-linear distortion. The spread from period to period contains noise alone (the
    robust method). Source: R. Pintelon, J. Schoukens, *System Identification: A Frequency Domain
    Approach*, 2nd ed., 2012, ch. 2-4.

    Raises
    ------
    IdentificationError
        If periods differ, are unknown or too few, or the inputs do not move independently.
    """
    check_comparable(experiments)
    spectra = [average_periods(experiment, skip_periods) for experiment in experiments]
    if len({spectrum.period_samples for spectrum in spectra}) > 1:
        raise IdentificationSettingError(
            "experiments: periods of {periods} samples; all must be equal",
            periods=str(sorted({spectrum.period_samples for spectrum in spectra})),
        )
    inputs = np.stack([spectrum.inputs for spectrum in spectra], axis=2)
    lines = find_excited_lines(inputs @ inputs.conj().swapaxes(1, 2), excited_above)
    inputs = inputs[lines]
    outputs = np.stack([spectrum.outputs[lines] for spectrum in spectra], axis=2)
    noise = np.mean([spectrum.noise[lines] for spectrum in spectra], axis=0)
    return _solve_lines(experiments[0], spectra[0], lines, inputs, outputs, noise)


def _solve_lines(
    first: ExperimentSignals,
    spectra: PeriodSpectra,
    lines: IntArray,
    inputs: ComplexArray,
    outputs: ComplexArray,
    noise: FloatArray,
) -> PeriodicResponse:
    """Solve each line from ``inputs`` (k, m, e), ``outputs`` (k, p, e) and ``noise`` (k, p)."""
    experiment_count, input_count = inputs.shape[2], inputs.shape[1]
    inverse = np.linalg.inv(inputs @ inputs.conj().swapaxes(1, 2))
    response = outputs @ inputs.conj().swapaxes(1, 2) @ inverse
    residual_power = np.sum(np.abs(outputs - response @ inputs) ** 2, axis=2)
    variance_factors = np.einsum("kii->ki", inverse).real[:, None, :]
    spare_experiments = experiment_count - input_count
    total_variance = residual_power / spare_experiments if spare_experiments else noise
    output_power = np.sum(np.abs(outputs) ** 2, axis=2)
    explained = (
        output_power - residual_power
        if spare_experiments
        else output_power - experiment_count * noise
    )
    linear = FrequencyResponse(
        lines.astype(np.float64) * (first.rate_hz / spectra.period_samples),
        response,
        np.sqrt(total_variance[:, :, None] * variance_factors),
        coherence_of(explained, output_power),
        float(spare_experiments or experiment_count * (spectra.periods - 1)),
        first.rate_hz,
        first.input_names,
        first.output_names,
    )
    distortion_power = np.sum(total_variance - noise, axis=0)
    return PeriodicResponse(
        lines,
        linear,
        np.sqrt(noise[:, :, None] * variance_factors),
        np.sqrt(np.sum(output_power, axis=0) / experiment_count / 2.0),
        np.sqrt(np.sum(noise, axis=0) / 2.0),
        np.sqrt(np.maximum(distortion_power, 0.0) / 2.0) if spare_experiments else None,
        spectra.period_samples,
        spectra.periods,
    )
