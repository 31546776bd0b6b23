"""ARX models by least squares, and their refinement by instrumental variables."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.errors import ExcitationError
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.model import (
    IdentifiedModel,
    Orders,
    against,
    checked,
    fit_percent,
    past_length,
)
from rotemina.sim.identification.transfer_function import (
    TransferFunction,
    filtered,
    shifted,
    stabilised,
)
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

LEAST_RANK = 1e-11  # smallest over largest singular value of scaled regressors that still counts


class Solution(NamedTuple):
    """Least squares: ``parameters`` (k,), ``inverse`` (k, k) of XᵀX, ``residual`` (n,)."""

    parameters: FloatArray
    inverse: FloatArray
    residual: FloatArray


def identify_arx(signals: Signals, orders: Orders) -> IdentifiedModel:
    """Fit ``A(q) y = q^-delay B(q) u + c + e`` by least squares.

    The estimate is unbiased only where the disturbance is white noise through ``1/A``; noise on
    the sensor biases it (towards too much damping): use :func:`identify_oe` then. Source:
    L. Ljung, *System Identification: Theory for the User*, 2nd ed., 1999, sections 4.2 and 7.3.

    Raises
    ------
    IdentificationError
        If the signals are too short, constant, or do not determine every parameter.
    """
    driven, measured = checked(signals, orders)
    scales = Scales.of(driven, measured)
    u, y = scales.scaled(driven, measured)
    start = past_length(orders)
    matrix = np.column_stack([*regressors(u, y, orders), np.ones(len(y))])[start:]
    solution = least_squares(matrix, y[start:], str(orders))
    b, a = split(solution.parameters, orders)
    at_one = float(np.sum(a))
    offset = float(solution.parameters[-1]) / at_one if at_one else np.nan
    variance = float(solution.residual @ solution.residual) / max(len(matrix) - matrix.shape[1], 1)
    model = scales.unscaled(b, a, orders.delay, signals.rate_hz)
    kept = orders.coefficients + orders.poles
    return IdentifiedModel(
        "arx",
        model,
        scales.offset(model, offset),
        scales.covariance(variance * solution.inverse[:kept, :kept], orders),
        against(model, driven, measured).fit_percent,
        fit_percent(y[start:], y[start:] - solution.residual),
        float(np.sqrt(variance)) * scales.output,
        0,
    )


def instrumental_variable(
    u: FloatArray, y: FloatArray, orders: Orders, denominator: FloatArray, rounds: int = 12
) -> tuple[FloatArray, FloatArray]:
    """Refine an ARX estimate so that noise on the output does not bias it.

    Input and output are filtered by ``1/A`` of the round before, and the simulated output serves
    as the instrument (simplified refined instrumental variable, P. C. Young, *Recursive Estimation
    and Time-Series Analysis*, 2nd ed., 2011, ch. 7).

    Parameters
    ----------
    u, y : (n,) scaled input and output.
    denominator : (na + 1,) to start from.

    Returns
    -------
    numerator : (nb,)
    denominator : (na + 1,), stable
    """
    start = past_length(orders)
    a = stabilised(denominator)
    b = np.zeros(orders.coefficients)
    quiet = y
    for _ in range(rounds):
        low_u, low_y, low_quiet = (filtered(np.ones(1), a, each) for each in (u, y, quiet))
        constant = np.ones((len(y), 1))
        matrix = np.column_stack([*regressors(low_u, low_y, orders), constant])[start:]
        instruments = np.column_stack([*regressors(low_u, low_quiet, orders), constant])[start:]
        solution, *_ = np.linalg.lstsq(
            instruments.T @ matrix, instruments.T @ low_y[start:], rcond=None
        )
        b, a = split(solution, orders)
        a = stabilised(a)
        quiet = filtered(np.r_[np.zeros(orders.delay), b], a, u)
    return b, a


class Scales(NamedTuple):
    """Means and spreads that bring signals to the size of 1, so that volts and nm are alike."""

    input_mean: float
    output_mean: float
    input: float
    output: float

    @classmethod
    def of(cls, driven: FloatArray, measured: FloatArray) -> "Scales":
        """Take the scales of an input and an output (n,) that move."""
        return cls(
            float(driven.mean()), float(measured.mean()), float(driven.std()), float(measured.std())
        )

    def scaled(self, driven: FloatArray, measured: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return both signals (n,) with mean 0 and spread 1."""
        return (driven - self.input_mean) / self.input, (measured - self.output_mean) / self.output

    def unscaled(
        self, b: FloatArray, a: FloatArray, delay: int, rate_hz: float
    ) -> TransferFunction:
        """Return the transfer function between the signals as they were."""
        return TransferFunction(b * (self.output / self.input), a, delay, rate_hz)

    def offset(self, model: TransferFunction, scaled_offset: float) -> float:
        """Return the output's offset in its own unit; not finite for a pole at 1."""
        at_mean = model.static_gain * self.input_mean if self.input_mean else 0.0
        return float(self.output_mean + self.output * scaled_offset - at_mean)

    def covariance(self, scaled: FloatArray, orders: Orders) -> FloatArray:
        """Return the covariance (nb + na, nb + na) of b, a between the signals as they were."""
        factor = np.r_[
            np.full(orders.coefficients, self.output / self.input), np.ones(orders.poles)
        ]
        return np.asarray(scaled * np.outer(factor, factor), dtype=np.float64)


def regressors(u: FloatArray, y: FloatArray, orders: Orders) -> list[FloatArray]:
    """Return one column (n,) for each of b0, b1, … and a1, a2, … in turn."""
    inputs = [shifted(u, orders.delay + k) for k in range(orders.coefficients)]
    return inputs + [-shifted(y, k + 1) for k in range(orders.poles)]


def split(parameters: FloatArray, orders: Orders) -> tuple[FloatArray, FloatArray]:
    """Return numerator (nb,) and denominator (na + 1,) of parameters that begin with b, a."""
    kept = orders.coefficients + orders.poles
    return parameters[: orders.coefficients], np.r_[1.0, parameters[orders.coefficients : kept]]


def least_squares(matrix: FloatArray, target: FloatArray, what: str) -> Solution:
    """Solve ``matrix @ parameters ≈ target`` with columns brought to length 1.

    Raises
    ------
    ExcitationError
        If the columns (n, k) are dependent to 1e-11.
    """
    length = np.linalg.norm(matrix, axis=0)
    length[length == 0.0] = 1.0
    left, sizes, right = np.linalg.svd(matrix / length, full_matrices=False)
    if sizes[-1] <= LEAST_RANK * sizes[0]:
        raise ExcitationError(
            message(
                "engine",
                "{what}: the record does not determine all {count} parameters (singular values "
                "{least} to {most}, bound {bound}); choose lower orders or excite more "
                "frequencies",
            ).fill(
                what=what,
                count=len(sizes),
                least=rounded(sizes[-1], 2),
                most=rounded(sizes[0], 2),
                bound=LEAST_RANK,
            )
        )
    inverse = (right.T / sizes**2) @ right
    parameters = right.T @ ((left.T @ target) / sizes) / length
    return Solution(parameters, inverse / np.outer(length, length), target - matrix @ parameters)
