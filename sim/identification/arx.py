"""ARX models by least squares, and their refinement by instrumental variables."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InsufficientExcitationError
from rotemina.sim.identification.experiment_signals import ExperimentSignals
from rotemina.sim.identification.model import (
    IdentifiedModel,
    ModelOrders,
    check_signals,
    fit_percent,
    past_length,
    simulate_against,
)
from rotemina.sim.identification.transfer_function import (
    TransferFunction,
    apply_filter,
    delay_signal,
    stabilise,
)
from rotemina.sim.messages import format_rounded

# The parameters are not determined if the ratio of the smallest to the largest singular value of
# the scaled regressors is below this bound.
MIN_SINGULAR_VALUE_RATIO = 1e-11


class LeastSquaresSolution(NamedTuple):
    """Solution of a least-squares problem with the matrix X (n, k).

    Attributes
    ----------
    parameters : (k,)
    inverse : (k, k)
        Inverse of XᵀX.
    residual : (n,)
    """

    parameters: FloatArray
    inverse: FloatArray
    residual: FloatArray


def identify_arx(signals: ExperimentSignals, orders: ModelOrders) -> IdentifiedModel:
    """Fit ``A(q) y = q^-delay B(q) u + c + e`` by least squares.

    The estimate is unbiased only if the disturbance is white noise filtered by ``1/A``. Sensor
    noise biases it towards too much damping; use :func:`identify_oe` in that case. Source:
    L. Ljung, *System Identification: Theory for the User*, 2nd ed., 1999, sections 4.2 and 7.3.

    Raises
    ------
    IdentificationError
        If the signals are too short, constant, or do not determine every parameter.
    """
    input_signal, measured = check_signals(signals, orders)
    scales = SignalScales.of(input_signal, measured)
    u, y = scales.scale(input_signal, measured)
    start = past_length(orders)
    matrix = np.column_stack([*make_regressors(u, y, orders), np.ones(len(y))])[start:]
    solution = least_squares(matrix, y[start:], str(orders))
    b, a = split_parameters(solution.parameters, orders)
    denominator_sum = float(np.sum(a))
    offset = float(solution.parameters[-1]) / denominator_sum if denominator_sum else np.nan
    variance = float(solution.residual @ solution.residual) / max(len(matrix) - matrix.shape[1], 1)
    model = scales.to_transfer_function(b, a, orders.delay, signals.rate_hz)
    parameter_count = orders.coefficients + orders.poles
    return IdentifiedModel(
        "arx",
        model,
        scales.unscale_offset(model, offset),
        scales.unscale_covariance(
            variance * solution.inverse[:parameter_count, :parameter_count], orders
        ),
        simulate_against(model, input_signal, measured).fit_percent,
        fit_percent(y[start:], y[start:] - solution.residual),
        float(np.sqrt(variance)) * scales.output_spread,
        0,
    )


def refine_by_instrumental_variables(
    u: FloatArray, y: FloatArray, orders: ModelOrders, denominator: FloatArray, rounds: int = 12
) -> tuple[FloatArray, FloatArray]:
    """Refine an ARX estimate so that noise on the output does not bias it.

    Input and output are filtered by ``1/A`` of the previous round, and the simulated output serves
    as the instrument (simplified refined instrumental variable, P. C. Young, *Recursive Estimation
    and Time-Series Analysis*, 2nd ed., 2011, ch. 7).

    Parameters
    ----------
    u, y : (n,)
        Scaled input and output.
    orders : ModelOrders
    denominator : (na + 1,)
        Denominator of the estimate to refine.
    rounds : int
        Number of refinements.

    Returns
    -------
    numerator : (nb,)
    denominator : (na + 1,)
        Stable.
    """
    start = past_length(orders)
    a = stabilise(denominator)
    b = np.zeros(orders.coefficients)
    simulated = y
    for _ in range(rounds):
        filtered_u, filtered_y, filtered_simulated = (
            apply_filter(np.ones(1), a, signal) for signal in (u, y, simulated)
        )
        constant = np.ones((len(y), 1))
        matrix = np.column_stack([*make_regressors(filtered_u, filtered_y, orders), constant])[
            start:
        ]
        instruments = np.column_stack(
            [*make_regressors(filtered_u, filtered_simulated, orders), constant]
        )[start:]
        solution, *_ = np.linalg.lstsq(
            instruments.T @ matrix, instruments.T @ filtered_y[start:], rcond=None
        )
        b, a = split_parameters(solution, orders)
        a = stabilise(a)
        simulated = apply_filter(np.r_[np.zeros(orders.delay), b], a, u)
    return b, a


class SignalScales(NamedTuple):
    """Means and standard deviations by which an input and an output are normalised.

    Normalised signals have similar sizes whatever their units, which keeps the least-squares
    problem well conditioned.
    """

    input_mean: float
    output_mean: float
    input_spread: float
    output_spread: float

    @classmethod
    def of(cls, driven: FloatArray, measured: FloatArray) -> "SignalScales":
        """Return the scales of an input and an output (n,), neither of them constant."""
        return cls(
            float(driven.mean()), float(measured.mean()), float(driven.std()), float(measured.std())
        )

    def scale(self, driven: FloatArray, measured: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return both signals (n,) with mean 0 and standard deviation 1."""
        return (driven - self.input_mean) / self.input_spread, (
            measured - self.output_mean
        ) / self.output_spread

    def to_transfer_function(
        self, b: FloatArray, a: FloatArray, delay: int, rate_hz: float
    ) -> TransferFunction:
        """Return the transfer function between the unscaled signals."""
        return TransferFunction(b * (self.output_spread / self.input_spread), a, delay, rate_hz)

    def unscale_offset(self, model: TransferFunction, scaled_offset: float) -> float:
        """Return the offset in the unit of the output; not finite for a pole at 1."""
        mean_response = model.static_gain * self.input_mean if self.input_mean else 0.0
        return float(self.output_mean + self.output_spread * scaled_offset - mean_response)

    def unscale_covariance(self, scaled: FloatArray, orders: ModelOrders) -> FloatArray:
        """Return the covariance (nb + na, nb + na) of b, a between the unscaled signals."""
        factor = np.r_[
            np.full(orders.coefficients, self.output_spread / self.input_spread),
            np.ones(orders.poles),
        ]
        return np.asarray(scaled * np.outer(factor, factor), dtype=np.float64)


def make_regressors(u: FloatArray, y: FloatArray, orders: ModelOrders) -> list[FloatArray]:
    """Return one column of regressors (n,) for each of b0, b1, … and of a1, a2, … in turn."""
    inputs = [delay_signal(u, orders.delay + k) for k in range(orders.coefficients)]
    return inputs + [-delay_signal(y, k + 1) for k in range(orders.poles)]


def split_parameters(parameters: FloatArray, orders: ModelOrders) -> tuple[FloatArray, FloatArray]:
    """Return numerator (nb,) and denominator (na + 1,) from parameters that begin with b, a."""
    end = orders.coefficients + orders.poles
    return parameters[: orders.coefficients], np.r_[1.0, parameters[orders.coefficients : end]]


def least_squares(matrix: FloatArray, target: FloatArray, what: str) -> LeastSquaresSolution:
    """Solve ``matrix @ parameters ≈ target`` with columns normalised to length 1.

    Parameters
    ----------
    matrix : (n, k)
    target : (n,)
    what : str
        Name of the problem in error messages.

    Raises
    ------
    InsufficientExcitationError
        If the columns are linearly dependent to 1e-11.
    """
    column_norms = np.linalg.norm(matrix, axis=0)
    column_norms[column_norms == 0.0] = 1.0
    left, singular_values, right = np.linalg.svd(matrix / column_norms, full_matrices=False)
    if singular_values[-1] <= MIN_SINGULAR_VALUE_RATIO * singular_values[0]:
        raise InsufficientExcitationError(
            "{what}: the record does not determine all {count} parameters (singular values "
            "{least} to {most}, bound {bound}); choose lower orders or excite more "
            "frequencies",
            what=what,
            count=len(singular_values),
            least=format_rounded(singular_values[-1], 2),
            most=format_rounded(singular_values[0], 2),
            bound=MIN_SINGULAR_VALUE_RATIO,
        )
    inverse = (right.T / singular_values**2) @ right
    parameters = right.T @ ((left.T @ target) / singular_values) / column_norms
    return LeastSquaresSolution(
        parameters, inverse / np.outer(column_norms, column_norms), target - matrix @ parameters
    )
