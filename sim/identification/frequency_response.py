"""Frequency responses of several inputs and outputs, with their uncertainty."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray, IntArray
from rotemina.sim.identification.errors import (
    ExcitationError,
    IdentificationError,
    TooShortError,
)
from rotemina.sim.identification.experiment_signals import Signals, check_moving
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

EXCITED_ABOVE = 1e-2  # of the largest input amplitude, from which a line counts as excited


@dataclass(frozen=True, slots=True, eq=False)
class FrequencyResponse:
    """A frequency response on k lines, from m inputs to p outputs.

    Attributes
    ----------
    frequency_hz : (k,) increasing.
    response : (k, p, m) complex, output unit over input unit.
    deviation : (k, p, m) standard deviation ``sqrt(E|ΔH|²)`` of the complex value, from all that
        is not a linear answer to the inputs (noise, distortion, leakage).
    coherence : (k, p) share of each output's power that is a linear answer to the inputs, 0 to 1.
    degrees : of freedom behind ``deviation`` (complex residuals a line).
    rate_hz : of the samples.
    input_names, output_names : of the columns.
    """

    frequency_hz: FloatArray
    response: ComplexArray
    deviation: FloatArray
    coherence: FloatArray
    degrees: float
    rate_hz: float
    input_names: tuple[str, ...]
    output_names: tuple[str, ...]

    def confidence_radius(self, probability: float = 0.95) -> FloatArray:
        """Return the radius (k, p, m) of the circle that holds the true value so probably.

        For circular normal residuals ``|ΔH|²/σ̂²`` is F-distributed with 2 and 2ν degrees of
        freedom, whose quantile is ``ν ((1 − P)^(−1/ν) − 1)``. Source: R. Pintelon, J. Schoukens,
        *System Identification: A Frequency Domain Approach*, 2nd ed., 2012, ch. 2.
        """
        factor = self.degrees * ((1.0 - probability) ** (-1.0 / self.degrees) - 1.0)
        return np.asarray(self.deviation * np.sqrt(factor), dtype=np.float64)

    @property
    def magnitude(self) -> FloatArray:
        """``|H|`` (k, p, m)."""
        return np.abs(self.response)

    @property
    def phase_rad(self) -> FloatArray:
        """Phase (k, p, m) in rad, unwrapped along the lines."""
        return np.unwrap(np.angle(self.response), axis=0)


def check_alike(experiments: tuple[Signals, ...]) -> None:
    """Refuse experiments that differ in rate or columns, or in which an input never moves.

    Raises
    ------
    TooShortError, IdentificationError, ExcitationError
    """
    if not experiments:
        raise TooShortError(message("engine", "experiments: none given; at least one is needed"))
    first = experiments[0]
    for number, each in enumerate(experiments):
        same_columns = (each.input_names, each.output_names) == (
            first.input_names,
            first.output_names,
        )
        if not same_columns or abs(each.rate_hz / first.rate_hz - 1.0) > 1e-4:
            raise IdentificationError(
                message(
                    "engine",
                    "experiment {number}: {inputs} → {outputs} at {rate_hz} Hz, but the "
                    "first has {first_inputs} → {first_outputs} at {first_rate_hz} Hz; all "
                    "must be equal",
                ).fill(
                    number=number,
                    inputs=", ".join(each.input_names),
                    outputs=", ".join(each.output_names),
                    rate_hz=rounded(each.rate_hz, 6),
                    first_inputs=", ".join(first.input_names),
                    first_outputs=", ".join(first.output_names),
                    first_rate_hz=rounded(first.rate_hz, 6),
                )
            )
    for column, name in enumerate(first.input_names):
        check_moving(np.concatenate([each.inputs[:, column] for each in experiments]), name)


def excited_lines(power: ComplexArray, excited_above: float) -> IntArray:
    """Return the lines on which the inputs move in every direction.

    Parameters
    ----------
    power : (k, m, m) input power, Hermitian; line 0 is the mean and never counts.
    excited_above : of the largest amplitude, each input taken by its own size.

    Raises
    ------
    ExcitationError
        If there is none: the inputs move together, or there are too few experiments.
    """
    size = np.sqrt(np.max(np.einsum("kii->ki", power[1:]).real, axis=0))
    least = np.full(len(power), -np.inf)
    if size.all():
        least[1:] = np.linalg.eigvalsh(power[1:] / np.outer(size, size))[:, 0]
    lines = np.flatnonzero(least >= excited_above**2)
    if len(lines) == 0:
        raise ExcitationError(
            message(
                "engine",
                "inputs: on no line do all {count} move independently at {excited_above} of the "
                "largest amplitude or more; excite them one after another, with independent "
                "signals, or in as many experiments as there are inputs",
            ).fill(count=len(size), excited_above=excited_above)
        )
    return lines


def coherence_of(explained: FloatArray, total: FloatArray) -> FloatArray:
    """Return the share ``explained / total`` (k, p), within 0 and 1; 0 for a silent output."""
    share = np.divide(explained, total, out=np.zeros_like(explained), where=total > 0)
    return np.clip(share, 0.0, 1.0)
