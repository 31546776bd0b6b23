"""Frequency responses of several inputs and outputs, with their uncertainty."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import (
    ComplexArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.errors import IdentificationError, InsufficientExcitationError, TooShortError
from rotemina.sim.identification.experiment_signals import ExperimentSignals, check_moving
from rotemina.sim.messages import format_rounded

# Smallest input amplitude of an excited line, as a share of the largest input amplitude.
MIN_EXCITATION_RATIO = 1e-2


@dataclass(frozen=True, slots=True, eq=False)
class FrequencyResponse:
    """A frequency response on k lines, from m inputs to p outputs.

    Attributes
    ----------
    frequency_hz : (k,)
        Frequencies of the lines, increasing.
    response : (k, p, m) complex
        Response in output units per input unit.
    deviation : (k, p, m)
        Standard deviation ``sqrt(E|ΔH|²)`` of the complex value, caused by everything that is not
        a linear response to the inputs (noise, distortion, leakage).
    coherence : (k, p)
        Share of each output's power that is a linear response to the inputs, 0 to 1.
    degrees_of_freedom : float
        Degrees of freedom of ``deviation`` (complex residuals per line).
    rate_hz : float
        Sampling rate, Hz.
    input_names, output_names : tuple of str
        Names of the columns.
    """

    frequency_hz: FloatArray
    response: ComplexArray
    deviation: FloatArray
    coherence: FloatArray
    degrees_of_freedom: float
    rate_hz: float
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]

    def confidence_radius(self, probability: float = 0.95) -> FloatArray:
        """Return the radius (k, p, m) of the circle that holds the true value with ``probability``.

        For circular normal residuals ``|ΔH|²/σ̂²`` is F-distributed with 2 and 2ν degrees of
        freedom, whose quantile is ``ν ((1 − P)^(−1/ν) − 1)``. Source: R. Pintelon, J. Schoukens,
        *System Identification: A Frequency Domain Approach*, 2nd ed., 2012, ch. 2.
        """
        factor = self.degrees_of_freedom * (
            (1.0 - probability) ** (-1.0 / self.degrees_of_freedom) - 1.0
        )
        return np.asarray(self.deviation * np.sqrt(factor), dtype=np.float64)

    @property
    def magnitude(self) -> FloatArray:
        """``|H|`` (k, p, m)."""
        return np.abs(self.response)

    @property
    def phase_rad(self) -> FloatArray:
        """Phase (k, p, m) in rad, unwrapped along the lines."""
        return np.unwrap(np.angle(self.response), axis=0)


def check_comparable(experiments: tuple[ExperimentSignals, ...]) -> None:
    """Check that experiments have the same rate and columns, and that every input moves.

    Raises
    ------
    TooShortError
        If there is no experiment.
    IdentificationError
        If rates or columns differ.
    InsufficientExcitationError
        If an input is constant in all experiments.
    """
    if not experiments:
        raise TooShortError("experiments: none given; at least one is needed")
    first = experiments[0]
    for number, experiment in enumerate(experiments):
        same_columns = (experiment.input_names, experiment.output_names) == (
            first.input_names,
            first.output_names,
        )
        if not same_columns or abs(experiment.rate_hz / first.rate_hz - 1.0) > 1e-4:
            raise IdentificationError(
                "experiment {number}: {inputs} → {outputs} at {rate_hz} Hz, but the "
                "first has {first_inputs} → {first_outputs} at {first_rate_hz} Hz; all "
                "must be equal",
                number=number,
                inputs=", ".join(experiment.input_names),
                outputs=", ".join(experiment.output_names),
                rate_hz=format_rounded(experiment.rate_hz, 6),
                first_inputs=", ".join(first.input_names),
                first_outputs=", ".join(first.output_names),
                first_rate_hz=format_rounded(first.rate_hz, 6),
            )
    for column, name in enumerate(first.input_names):
        check_moving(
            np.concatenate([experiment.inputs[:, column] for experiment in experiments]), name
        )


def find_excited_lines(power: ComplexArray, excited_above: float) -> IntArray:
    """Return the lines on which all inputs are excited independently.

    Parameters
    ----------
    power : (k, m, m)
        Power of the inputs, Hermitian. Line 0 is the mean and never counts.
    excited_above : float
        Smallest amplitude of an excited line. Each input is scaled by its largest amplitude first.

    Raises
    ------
    InsufficientExcitationError
        If there is none: the inputs move together, or there are too few experiments.
    """
    largest_amplitude = np.sqrt(np.max(np.einsum("kii->ki", power[1:]).real, axis=0))
    smallest_eigenvalue = np.full(len(power), -np.inf)
    if largest_amplitude.all():
        smallest_eigenvalue[1:] = np.linalg.eigvalsh(
            power[1:] / np.outer(largest_amplitude, largest_amplitude)
        )[:, 0]
    lines = np.flatnonzero(smallest_eigenvalue >= excited_above**2)
    if len(lines) == 0:
        raise InsufficientExcitationError(
            "inputs: on no line are all {count} excited independently with at least "
            "{excited_above} of the largest amplitude; excite them one after another, with "
            "independent signals, or in as many experiments as there are inputs",
            count=len(largest_amplitude),
            excited_above=excited_above,
        )
    return lines


def coherence_of(explained: FloatArray, total: FloatArray) -> FloatArray:
    """Return the share ``explained / total`` (k, p), within 0 and 1; 0 for a zero output."""
    share = np.divide(explained, total, out=np.zeros_like(explained), where=total > 0)
    return np.clip(share, 0.0, 1.0)
