"""What parametric identification gives: a transfer function and how sure it is."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.errors import SettingError, TooShortError
from rotemina.sim.identification.experiment_signals import Signals, check_moving
from rotemina.sim.identification.transfer_function import TransferFunction, filtered, shifted
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

_ROWS_A_PARAMETER = 4


class Orders(NamedTuple):
    """Structure of a discrete transfer function.

    ``poles`` na coefficients of the denominator, ``coefficients`` nb of the numerator (one more
    than its zeros), ``delay`` in samples (1: the next sample is the first to answer).
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
    transfer_function : with its sampling rate.
    offset : of the output, its unit: ``y = H u + offset``.
    covariance : (nb + na, nb + na) of b0, b1, …, a1, a2, …
        For white residuals and a structure that holds the truth.
    fit_percent : 100 (1 − ‖y − ŷ‖ / ‖y − mean y‖) of the simulated output; −inf if unstable.
    prediction_percent : the same of the one-step prediction; None for output error.
    residual_rms : of the residuals that were minimised, in the unit of the output.
    iterations : of the search; 0 for a direct solution.
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
        bottom = float(np.sum(model.denominator))
        slope = np.r_[
            np.full(len(model.numerator), 1.0 / bottom),
            np.full(len(model.denominator) - 1, -model.static_gain / bottom),
        ]
        return float(np.sqrt(slope @ self.covariance @ slope))


class Simulation(NamedTuple):
    """A simulated output (n,) against the measured one.

    ``fit_percent`` as in :class:`IdentifiedModel`; ``relative_error`` = ‖y − ŷ‖ / ‖y‖.
    """

    output: FloatArray
    fit_percent: float
    relative_error: float


def simulate(model: TransferFunction, signals: Signals) -> Simulation:
    """Simulate an experiment that the model need not have seen.

    What came before the first sample and the output's offset are unknown: the free response and
    the offset that fit best are found by linear least squares (a few numbers, not the model).

    Raises
    ------
    SettingError
        If the sampling rates differ by more than 0.01 %.
    """
    if abs(signals.rate_hz / model.rate_hz - 1.0) > 1e-4:
        raise SettingError(
            message(
                "engine",
                "simulation: the model is sampled at {rate_hz} Hz, the record at {signals_rate_hz} "
                "Hz; resample the record",
            ).fill(rate_hz=rounded(model.rate_hz, 6), signals_rate_hz=rounded(signals.rate_hz, 6))
        )
    driven, measured = signals.single()
    return against(model, driven, measured)


def against(model: TransferFunction, driven: FloatArray, measured: FloatArray) -> Simulation:
    """Simulate an input (n,) with the best free response and offset for a measured output (n,)."""
    if not model.stable:
        return Simulation(np.full(len(measured), np.nan), -np.inf, np.inf)
    forced = model.simulate(driven)
    orders = Orders(len(model.denominator) - 1, len(model.numerator), model.delay)
    columns = np.column_stack(
        [*free_responses(model.denominator, orders, len(driven)), np.ones(len(driven))]
    )
    solution, *_ = np.linalg.lstsq(columns, measured - forced, rcond=None)
    output = forced + columns @ solution
    error = float(np.linalg.norm(measured - output))
    return Simulation(
        output, fit_percent(measured, output), error / max(float(np.linalg.norm(measured)), 1e-300)
    )


def free_responses(denominator: FloatArray, orders: Orders, count: int) -> list[FloatArray]:
    """Return the shifted impulse responses (count,) of ``1/A`` that span every past."""
    impulse = np.zeros(count)
    impulse[0] = 1.0
    answer = filtered(np.ones(1), denominator, impulse)
    return [shifted(answer, k) for k in range(past_length(orders))]


def past_length(orders: Orders) -> int:
    """Return how many numbers carry what came before the first sample."""
    return max(orders.poles, orders.delay + orders.coefficients - 1)


def fit_percent(measured: FloatArray, output: FloatArray) -> float:
    """Return 100 (1 − NRMSE) (L. Ljung, *System Identification*, 2nd ed., 1999, ch. 16)."""
    spread = float(np.linalg.norm(measured - measured.mean()))
    return 100.0 * (1.0 - float(np.linalg.norm(measured - output)) / max(spread, 1e-300))


def checked(signals: Signals, orders: Orders) -> tuple[FloatArray, FloatArray]:
    """Return input and output (n,) after checking that the orders can be fitted to them.

    Raises
    ------
    SettingError, TooShortError, ExcitationError
    """
    if orders.poles < 0 or orders.coefficients < 1 or orders.delay < 0:
        raise SettingError(
            message(
                "engine",
                "{orders}: poles and delay cannot be negative, and the numerator needs at least "
                "one coefficient",
            ).fill(orders=str(orders))
        )
    needed = past_length(orders) + _ROWS_A_PARAMETER * (orders.poles + orders.coefficients + 1)
    if signals.count < needed:
        raise TooShortError(
            message(
                "engine",
                "signals: {inputs} samples, but {orders} needs at least {needed}; record longer or "
                "choose lower orders",
            ).fill(inputs=signals.count, orders=str(orders), needed=needed)
        )
    driven, measured = signals.single()
    check_moving(driven, signals.input_names[0])
    check_moving(measured, signals.output_names[0])
    return driven, measured
