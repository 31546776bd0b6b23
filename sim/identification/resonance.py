"""Fit of one resonance to a frequency response: frequency, damping, gain."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import (
    IdentificationSettingError,
    InsufficientExcitationError,
    TooShortError,
)
from rotemina.sim.messages import format_rounded

_MIN_LINES = 4
# A mode of this damping ratio or more has no peak.
_MAX_DAMPING_RATIO = 0.5**0.5
# Smallest ratio of the half-width of a mode to the spacing of the lines. In a narrower fit a single
# line would count as a mode.
_MIN_HALF_WIDTH_RATIO = 0.05
_MAX_ITERATIONS = 60
# Smallest relative change of the cost. The fit has converged if an iteration changes it less.
_MIN_COST_CHANGE_RATIO = 1e-13


class FittedResonance(NamedTuple):
    """A mode ``H(ω) = gain e^(jφ) ω0² / (ω0² − ω² + 2jζω0ω) + rest`` within a band.

    Attributes
    ----------
    frequency_hz : float
        ω0 / 2π.
    damping_ratio : float
        ζ.
    gain : float
        At least 0, in the unit of the response.
    phase_rad : float
        φ, caused by a delay or a lag at the frequency of the mode. About π if the mode has a
        negative sign.
    rest : complex
        Contribution of other modes, constant over the band, in the unit of the response.
    frequency_deviation, damping_deviation : float
        Standard deviations. They follow from the residual, or from the standard deviations of the
        lines if these were given and are larger.
    misfit : float
        ‖H − model‖ / ‖H‖. It is large if the band contains another mode.
    """

    frequency_hz: float
    damping_ratio: float
    gain: float
    phase_rad: float
    rest: complex
    frequency_deviation: float
    damping_deviation: float
    misfit: float


def fit_resonance(
    frequency_hz: FloatArray,
    response: ComplexArray,
    *,
    band_hz: tuple[float, float],
    deviation: FloatArray | None = None,
    held_at_hz: float | None = None,
) -> FittedResonance:
    """Fit a single mode to the lines of a band.

    A linear fit (E. C. Levy, *IRE Trans. Autom. Control* 4 (1959) 37) gives the start values.
    Gauss–Newton iteration on the weighted complex error refines them (R. Pintelon, J. Schoukens,
    *System Identification: A Frequency Domain Approach*, 2nd ed., 2012, ch. 8).

    Parameters
    ----------
    frequency_hz, response : (k,)
        Response of one output to one input.
    band_hz : (float, float)
        Lowest and highest frequency used.
    deviation : (k,), optional
        Standard deviation of each line. Without it, all lines have the same weight.
    held_at_hz : float, optional
        Sampling rate of commands that are held between samples. The response is then divided by
        that of the hold, ``sinc(f/rate) e^(−jπf/rate)``; aliasing is not corrected.

    Raises
    ------
    IdentificationSettingError
        If the band is empty.
    TooShortError
        If the band has too few lines.
    InsufficientExcitationError
        If the band contains no resonance.
    """
    in_band = (frequency_hz >= band_hz[0]) & (frequency_hz <= band_hz[1])
    if not 0.0 <= band_hz[0] < band_hz[1]:
        raise IdentificationSettingError(
            "resonance: band {band_hz} Hz; the lower frequency must come first",
            band_hz=str(band_hz),
        )
    if in_band.sum() < _MIN_LINES:
        raise TooShortError(
            "resonance: {count} lines from {low_hz} to {high_hz} Hz; at least {least_lines}"
            " are needed, widen the band or increase the resolution",
            count=in_band.sum(),
            low_hz=band_hz[0],
            high_hz=band_hz[1],
            least_lines=_MIN_LINES,
        )
    line_hz, target = frequency_hz[in_band], response[in_band]
    if held_at_hz is not None:
        relative_frequency = line_hz / held_at_hz
        target = target / (np.sinc(relative_frequency) * np.exp(-1j * np.pi * relative_frequency))
    weight = np.ones(len(line_hz))
    if deviation is not None:
        weight = 1.0 / np.maximum(deviation[in_band], 1e-12 * float(np.abs(target).max()))
    return _fit(line_hz, target, weight, deviation is not None)


def _fit(
    line_hz: FloatArray, target: ComplexArray, weight: FloatArray, has_deviation: bool
) -> FittedResonance:
    """Fit frequencies relative to the band centre and responses relative to the largest one."""
    mid_hz, max_magnitude = float(line_hz.mean()), float(np.abs(target).max())
    if max_magnitude == 0.0:
        raise InsufficientExcitationError("resonance: the response is zero over the band")
    frequency, target_ratio = line_hz / mid_hz, target / max_magnitude
    parameters = _fit_start_values(frequency, target_ratio)
    cost = np.inf
    for _ in range(_MAX_ITERATIONS):
        model, jacobian = _evaluate_model(frequency, parameters)
        error = _stack_parts(weight * (target_ratio - model))
        new_cost = float(error @ error)
        if new_cost >= cost * (1.0 - _MIN_COST_CHANGE_RATIO):
            break
        cost = new_cost
        step, *_ = np.linalg.lstsq(_stack_parts(weight[:, None] * jacobian), error, rcond=None)
        step_vector = np.asarray(step, dtype=np.float64)
        parameters = _limit_step(frequency, target_ratio, weight, parameters, step_vector)
    model, jacobian = _evaluate_model(frequency, parameters)
    real_jacobian = _stack_parts(weight[:, None] * jacobian)
    error = _stack_parts(weight * (target_ratio - model))
    variance = float(error @ error) / max(len(error) - len(parameters), 1)
    if has_deviation:
        # The real and the imaginary part each have half of the variance of a line. A poor fit has a
        # larger variance.
        variance = max(variance, 1.0 / max_magnitude**2 / 2.0)
    covariance = variance * np.linalg.pinv(real_jacobian.T @ real_jacobian)
    deviations = np.sqrt(np.diag(covariance))
    omega0, damping = float(parameters[0]), float(parameters[1])
    gain = complex(parameters[2], parameters[3])
    is_resolved = damping * omega0 >= _MIN_HALF_WIDTH_RATIO * float(np.diff(frequency).max())
    if not (frequency[0] < omega0 < frequency[-1] and is_resolved and damping < _MAX_DAMPING_RATIO):
        raise InsufficientExcitationError(
            "resonance: the best fit lies at {frequency_hz} Hz with damping {damping}, no peak "
            "inside the band {low_hz} to {high_hz} Hz; choose a band around a peak",
            frequency_hz=format_rounded(omega0 * mid_hz, 6),
            damping=format_rounded(damping, 3),
            low_hz=line_hz[0],
            high_hz=line_hz[-1],
        )
    return FittedResonance(
        omega0 * mid_hz,
        damping,
        abs(gain) * max_magnitude,
        float(np.angle(gain)),
        complex(parameters[4], parameters[5]) * max_magnitude,
        float(deviations[0]) * mid_hz,
        float(deviations[1]),
        float(np.linalg.norm(target_ratio - model) / np.linalg.norm(target_ratio)),
    )


def _fit_start_values(omega: FloatArray, target: ComplexArray) -> FloatArray:
    """Return start values of ω0, ζ, gain and rest from ``H (a − ω² + jbω) = c + r (…)``.

    Gain and rest are given by their real and imaginary parts.
    """
    ones, complex_frequency = np.ones_like(target), omega.astype(np.complex128)
    # The last columns stand for the rest times the denominator, with independent coefficients.
    columns = [
        -target,
        -1j * omega * target,
        ones,
        1j * ones,
        complex_frequency,
        1j * complex_frequency,
        complex_frequency**2,
        1j * complex_frequency**2,
    ]
    solution, *_ = np.linalg.lstsq(
        _stack_parts(np.column_stack(columns)), _stack_parts(-target * omega**2), rcond=None
    )
    omega0 = float(np.sqrt(max(solution[0], float(omega[0]) ** 2)))
    damping = abs(float(solution[1])) / (2.0 * omega0)
    peak = int(np.argmax(np.abs(target)))
    if not omega[0] < omega0 < omega[-1] or damping == 0.0:
        omega0, damping = float(omega[peak]), 0.02
    mode = _compute_mode_response(omega, omega0, damping)
    basis = [mode, 1j * mode, ones, 1j * ones]
    coefficients, *_ = np.linalg.lstsq(
        _stack_parts(np.column_stack(basis)), _stack_parts(target), rcond=None
    )
    return np.concatenate([[omega0, damping], coefficients])


def _compute_mode_response(omega: FloatArray, omega0: float, damping: float) -> ComplexArray:
    return np.asarray(
        omega0**2 / (omega0**2 - omega**2 + 2j * damping * omega0 * omega),
        dtype=np.complex128,
    )


def _evaluate_model(omega: FloatArray, parameters: FloatArray) -> tuple[ComplexArray, ComplexArray]:
    """Return the response (k,) of the model and its derivatives (k, 6) by the parameters."""
    omega0, damping = parameters[:2]
    gain = parameters[2] + 1j * parameters[3]
    mode = _compute_mode_response(omega, omega0, damping)
    frequency_derivative = gain * (
        2.0 * mode / omega0 - mode**2 / omega0**2 * (2.0 * omega0 + 2j * damping * omega)
    )
    damping_derivative = -gain * mode**2 / omega0**2 * 2j * omega0 * omega
    ones = np.ones_like(mode)
    model = gain * mode + parameters[4] + 1j * parameters[5]
    return model, np.column_stack(
        [frequency_derivative, damping_derivative, mode, 1j * mode, ones, 1j * ones]
    )


def _limit_step(
    omega: FloatArray,
    target: ComplexArray,
    weight: FloatArray,
    parameters: FloatArray,
    step: FloatArray,
) -> FloatArray:
    """Return the parameters after a step, halved until it lowers the error, or the old ones."""

    def compute_cost(values: FloatArray) -> float:
        return float(np.sum(np.abs(weight * (target - _evaluate_model(omega, values)[0])) ** 2))

    previous_cost = compute_cost(parameters)
    for _ in range(30):
        candidate = parameters + step
        if candidate[0] > 0.0 and candidate[1] > 0.0 and compute_cost(candidate) < previous_cost:
            return candidate
        step = 0.5 * step
    return parameters


def _stack_parts(values: ComplexArray) -> FloatArray:
    return np.concatenate([values.real, values.imag]).astype(np.float64)
