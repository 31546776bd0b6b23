"""Periodic excitation: exact averages on each line, noise from period to period, distortion."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray, IntArray
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


@dataclass(frozen=True, slots=True, eq=False)
class PeriodicResponse:
    """The response on the excited lines of periodic experiments.

    Attributes
    ----------
    lines : (k,) excited lines, in multiples of rate / period.
    total : response with the deviation of everything that is not linear, from experiment to
        experiment; with as many experiments as inputs it equals the noise's.
    noise_deviation : (k, p, m) standard deviation of the response by noise alone, from period to
        period.
    output_rms, noise_rms : (p,) of the averaged output on the excited lines, and of its noise.
    distortion_rms : (p,) stochastic non-linear distortion on those lines in one experiment, above
        the noise; None with as many experiments as inputs.
    period_samples, periods : length of a period, and how many were averaged in each experiment.
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
    """Mean amplitudes of one experiment's lines, complex, in signal units (peak, not rms).

    ``inputs`` (lines, m), ``outputs`` (lines, p) averaged over the periods; ``noise`` (lines, p)
    variance of the averaged outputs; ``periods`` averaged; ``period_samples``.
    """

    inputs: ComplexArray
    outputs: ComplexArray
    noise: FloatArray
    periods: int
    period_samples: int


def period_spectra(signals: Signals, skip_periods: int = 0) -> PeriodSpectra:
    """Average an experiment line by line over its whole periods.

    Parameters
    ----------
    signals : periodic, at least two whole periods after those skipped.
    skip_periods : at the beginning, for transients.

    Raises
    ------
    SettingError, TooShortError
        If the period is not known, or fewer than two are left.
    """
    period = signals.period_samples
    if period is None or period < 2 or skip_periods < 0:
        raise SettingError(
            message(
                "engine",
                "periodic response: a period of {period} samples, {skip_periods} periods skipped; "
                "the record needs '# history: periodic' and '# period_samples: N'",
            ).fill(period=str(period), skip_periods=skip_periods)
        )
    periods = signals.count // period - skip_periods
    if periods < 2:
        raise TooShortError(
            message(
                "engine",
                "periodic response: {periods} whole periods of {period} samples after "
                "{skip_periods} skipped; the noise needs at least 2",
            ).fill(periods=max(periods, 0), period=period, skip_periods=skip_periods)
        )
    used = slice(skip_periods * period, (skip_periods + periods) * period)
    driven, answer = (
        np.fft.rfft(values[used].reshape(periods, period, -1), axis=1) * (2.0 / period)
        for values in (signals.inputs, signals.outputs)
    )
    noise = np.var(answer, axis=0, ddof=1) / periods
    return PeriodSpectra(driven.mean(axis=0), answer.mean(axis=0), noise, periods, period)


def periodic_response(
    *experiments: Signals, excited_above: float = EXCITED_ABOVE, skip_periods: int = 0
) -> PeriodicResponse:
    """Estimate the response exactly on the excited lines of multisines in steady state.

    Without leakage or window: on each line ``H = Y Uᴴ (U Uᴴ)⁻¹`` over the experiments, as many as
    inputs or more. The spread from experiment to experiment holds noise and non-linear distortion,
    that from period to period noise alone (the robust method). Source: R. Pintelon,
    J. Schoukens, *System Identification: A Frequency Domain Approach*, 2nd ed., 2012, ch. 2-4.

    Raises
    ------
    IdentificationError
        If periods differ, are unknown or too few, or the inputs do not move independently.
    """
    check_alike(experiments)
    spectra = [period_spectra(each, skip_periods) for each in experiments]
    if len({each.period_samples for each in spectra}) > 1:
        raise SettingError(
            message("engine", "experiments: periods of {periods} samples; all must be equal").fill(
                periods=str(sorted({each.period_samples for each in spectra}))
            )
        )
    driven = np.stack([each.inputs for each in spectra], axis=2)
    lines = excited_lines(driven @ driven.conj().swapaxes(1, 2), excited_above)
    driven = driven[lines]
    answer = np.stack([each.outputs[lines] for each in spectra], axis=2)
    noise = np.mean([each.noise[lines] for each in spectra], axis=0)
    return _estimate(experiments[0], spectra[0], lines, driven, answer, noise)


def _estimate(
    first: Signals,
    spectra: PeriodSpectra,
    lines: IntArray,
    driven: ComplexArray,
    answer: ComplexArray,
    noise: FloatArray,
) -> PeriodicResponse:
    """Solve each line; ``driven`` (k, m, e), ``answer`` (k, p, e), ``noise`` (k, p)."""
    count, inputs = driven.shape[2], driven.shape[1]
    inverse = np.linalg.inv(driven @ driven.conj().swapaxes(1, 2))
    response = answer @ driven.conj().swapaxes(1, 2) @ inverse
    rest = np.sum(np.abs(answer - response @ driven) ** 2, axis=2)
    spread = np.einsum("kii->ki", inverse).real[:, None, :]
    spare = count - inputs
    total = rest / spare if spare else noise
    power = np.sum(np.abs(answer) ** 2, axis=2)
    explained = power - rest if spare else power - count * noise
    linear = FrequencyResponse(
        lines.astype(np.float64) * (first.rate_hz / spectra.period_samples),
        response,
        np.sqrt(total[:, :, None] * spread),
        coherence_of(explained, power),
        float(spare or count * (spectra.periods - 1)),
        first.rate_hz,
        first.input_names,
        first.output_names,
    )
    above = np.sum(total - noise, axis=0)
    return PeriodicResponse(
        lines,
        linear,
        np.sqrt(noise[:, :, None] * spread),
        np.sqrt(np.sum(power, axis=0) / count / 2.0),
        np.sqrt(np.sum(noise, axis=0) / 2.0),
        np.sqrt(np.maximum(above, 0.0) / 2.0) if spare else None,
        spectra.period_samples,
        spectra.periods,
    )
