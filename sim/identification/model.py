"""Results of parametric identification: a transfer function and its uncertainty."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import IdentificationSettingError, TooShortError
from rotemina.sim.identification.experiment_signals import ExperimentSignals, check_moving
from rotemina.sim.identification.transfer_function import (
    TransferFunction,
    apply_filter,
    delay_signal,
)
from rotemina.sim.messages import format_rounded

_MIN_SAMPLES_PER_PARAMETER = 4


class ModelOrders(NamedTuple):
    """Structure of a discrete transfer function.

    Attributes
    ----------
    poles : int
        Number na of denominator coefficients.
    coefficients : int
        Number nb of numerator coefficients, one more than the number of zeros.
    delay : int
        Samples from input to output; 1 if the next sample is the first to respond.
    """

    poles: int
    coefficients: int
    delay: int = 1


@dataclass(frozen=True, slots=True, eq=False)
class IdentifiedModel:
    """A discrete transfer function fitted to one experiment.

    Attributes
    ----------
    method : "arx" or "oe"
    transfer_function : TransferFunction
        Includes the sampling rate.
    offset : float
        Output offset in the unit of the output: ``y = H u + offset``.
    covariance : (nb + na, nb + na)
        Covariance of b0, b1, …, a1, a2, … It holds for white residuals and a model structure
        that contains the true system.
    fit_percent : float
        100 (1 − ‖y − ŷ‖ / ‖y − mean y‖) of the simulated output; −inf if unstable.
    prediction_percent : float or None
        The same figure for the one-step prediction; None for output error.
    residual_rms : float
        RMS of the minimised residuals, in the unit of the output.
    iterations : int
        Iterations of the search; 0 for a direct solution.
    """

    method: Literal["arx", "oe"]
    transfer_function: TransferFunction
    offset: float
    covariance: FloatArray
    fit_percent: float
    prediction_percent: float | None
    residual_rms: float
    iterations: int

    @property
    def static_gain_deviation(self) -> float:
        """Standard deviation of the static gain, by linear propagation."""
        model = self.transfer_function
        denominator_sum = float(np.sum(model.denominator))
        gradient = np.r_[
            np.full(len(model.numerator), 1.0 / denominator_sum),
            np.full(len(model.denominator) - 1, -model.static_gain / denominator_sum),
        ]
        return float(np.sqrt(gradient @ self.covariance @ gradient))


class SimulatedOutput(NamedTuple):
    """A simulated output and its distance from the measured one.

    Attributes
    ----------
    output : (n,)
        Simulated output ŷ.
    fit_percent : float
        As in :class:`IdentifiedModel`.
    relative_error : float
        ‖y − ŷ‖ / ‖y‖.
    """

    output: FloatArray
    fit_percent: float
    relative_error: float


def simulate(model: TransferFunction, signals: ExperimentSignals) -> SimulatedOutput:
    """Simulate an experiment, which may differ from the one the model was fitted to.

    The inputs before the first sample and the offset of the output are unknown. Linear least
    squares finds the free response and the offset that fit best; the model itself remains
    unchanged.

    Raises
    ------
    IdentificationSettingError
        If the sampling rates differ by more than 0.01 %.
    """
    if abs(signals.rate_hz / model.rate_hz - 1.0) > 1e-4:
        raise IdentificationSettingError(
            "simulation: the model is sampled at {rate_hz} Hz, the record at {signals_rate_hz} "
            "Hz; resample the record",
            rate_hz=format_rounded(model.rate_hz, 6),
            signals_rate_hz=format_rounded(signals.rate_hz, 6),
        )
    input_signal, measured = signals.require_single_pair()
    return simulate_against(model, input_signal, measured)


def simulate_against(
    model: TransferFunction, input_signal: FloatArray, measured: FloatArray
) -> SimulatedOutput:
    """Simulate an input (n,); fit free response and offset to the measured output (n,)."""
    if not model.stable:
        return SimulatedOutput(np.full(len(measured), np.nan), -np.inf, np.inf)
    forced = model.simulate(input_signal)
    orders = ModelOrders(len(model.denominator) - 1, len(model.numerator), model.delay)
    columns = np.column_stack(
        [
            *make_free_responses(model.denominator, orders, len(input_signal)),
            np.ones(len(input_signal)),
        ]
    )
    solution, *_ = np.linalg.lstsq(columns, measured - forced, rcond=None)
    output = forced + columns @ solution
    error = float(np.linalg.norm(measured - output))
    return SimulatedOutput(
        output, fit_percent(measured, output), error / max(float(np.linalg.norm(measured)), 1e-300)
    )


def make_free_responses(
    denominator: FloatArray, orders: ModelOrders, count: int
) -> list[FloatArray]:
    """Return the delayed impulse responses (count,) of ``1/A`` that span all free responses."""
    impulse = np.zeros(count)
    impulse[0] = 1.0
    response = apply_filter(np.ones(1), denominator, impulse)
    return [delay_signal(response, k) for k in range(past_length(orders))]


def past_length(orders: ModelOrders) -> int:
    """Return the number of values that describe the inputs and outputs before the first sample."""
    return max(orders.poles, orders.delay + orders.coefficients - 1)


def fit_percent(measured: FloatArray, output: FloatArray) -> float:
    """Return 100 (1 − NRMSE) (L. Ljung, *System Identification*, 2nd ed., 1999, ch. 16)."""
    variation = float(np.linalg.norm(measured - measured.mean()))
    return 100.0 * (1.0 - float(np.linalg.norm(measured - output)) / max(variation, 1e-300))


def check_signals(signals: ExperimentSignals, orders: ModelOrders) -> tuple[FloatArray, FloatArray]:
    """Return input and output (n,) after checking that a model of these orders can be fitted.

    Raises
    ------
    IdentificationSettingError, TooShortError, InsufficientExcitationError
        If an order is negative, the signals are too short, or one of them is constant.
    """
    if orders.poles < 0 or orders.coefficients < 1 or orders.delay < 0:
        raise IdentificationSettingError(
            "{orders}: poles and delay cannot be negative, and the numerator needs at least "
            "one coefficient",
            orders=str(orders),
        )
    min_samples = past_length(orders) + _MIN_SAMPLES_PER_PARAMETER * (
        orders.poles + orders.coefficients + 1
    )
    if signals.count < min_samples:
        raise TooShortError(
            "signals: {inputs} samples, but {orders} needs at least {needed}; record longer or "
            "choose lower orders",
            inputs=signals.count,
            orders=str(orders),
            needed=min_samples,
        )
    input_signal, measured = signals.require_single_pair()
    check_moving(input_signal, signals.input_names[0])
    check_moving(measured, signals.output_names[0])
    return input_signal, measured
