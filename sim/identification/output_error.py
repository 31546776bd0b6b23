"""Output-error models: the simulated output is fitted, so sensor noise does not bias them."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.arx import (
    Scales,
    instrumental_variable,
    least_squares,
    regressors,
    split,
)
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.model import (
    IdentifiedModel,
    Orders,
    checked,
    fit_percent,
    free_responses,
    past_length,
)
from rotemina.sim.identification.transfer_function import (
    filtered,
    is_stable,
    stabilised,
)

_MOST_ITERATIONS = 100
_CONVERGED = 1e-10  # relative change of the cost
_EXACT = 1e-13  # relative error of the output at which nothing is left to gain
_LARGEST_DAMPING = 1e12


@dataclass(frozen=True, slots=True, eq=False)
class _Point:
    """A point of the search: parameters, residual (n,) and output (n,)."""

    parameters: FloatArray
    output: FloatArray
    residual: FloatArray

    @property
    def cost(self) -> float:
        return float(self.residual @ self.residual)


def identify_oe(signals: Signals, orders: Orders) -> IdentifiedModel:
    """Fit ``y = q^-delay B(q)/A(q) u + c + e`` with white e, by prediction-error iteration.

    The search (Levenberg–Marquardt with exact gradients) starts from ARX or, where it simulates
    better, from instrumental variables. What came before the first sample and the offset c are
    fitted with it. Source: L. Ljung, *System Identification*, 2nd ed., 1999, sections 4.2, 10.2.

    Raises
    ------
    IdentificationError
        If the signals are too short, constant, or do not determine every parameter.
    """
    driven, measured = checked(signals, orders)
    scales = Scales.of(driven, measured)
    u, y = scales.scaled(driven, measured)
    point, iterations = _search(u, y, orders)
    jacobian = _jacobian(u, point, orders)
    # The nuisances are projected out before the rank is judged: they may be faint.
    kept = orders.coefficients + orders.poles
    nuisance, _ = np.linalg.qr(jacobian[:, kept:])
    wanted = jacobian[:, :kept] - nuisance @ (nuisance.T @ jacobian[:, :kept])
    inverse = least_squares(wanted, point.residual, str(orders)).inverse
    variance = point.cost / max(len(y) - jacobian.shape[1], 1)
    b, a = split(point.parameters, orders)
    model = scales.unscaled(b, a, orders.delay, signals.rate_hz)
    return IdentifiedModel(
        "oe",
        model,
        scales.offset(model, float(point.parameters[-1])),
        scales.covariance(variance * inverse, orders),
        fit_percent(y, point.output),
        None,
        float(np.sqrt(variance)) * scales.output,
        iterations,
    )


def _search(u: FloatArray, y: FloatArray, orders: Orders) -> tuple[_Point, int]:
    point = min(_starts(u, y, orders), key=lambda each: each.cost)
    damping = 1e-3
    for iteration in range(1, _MOST_ITERATIONS + 1):
        if point.cost <= _EXACT**2 * len(y):
            return point, iteration - 1
        jacobian = _jacobian(u, point, orders)
        before = point.cost
        point, damping = _improved(u, y, orders, point, jacobian, damping)
        if before - point.cost <= _CONVERGED * before:
            return point, iteration
    return point, _MOST_ITERATIONS


def _improved(
    u: FloatArray,
    y: FloatArray,
    orders: Orders,
    point: _Point,
    jacobian: FloatArray,
    damping: float,
) -> tuple[_Point, float]:
    """Take one step that lowers the cost and stays stable, or none; return the next damping."""
    length = np.linalg.norm(jacobian, axis=0)
    length[length == 0.0] = 1.0
    left, sizes, right = np.linalg.svd(jacobian / length, full_matrices=False)
    projected = left.T @ point.residual
    while damping <= _LARGEST_DAMPING:
        step = right.T @ (projected * sizes / (sizes**2 + damping * sizes[0] ** 2)) / length
        tried = point.parameters + step
        if is_stable(split(tried, orders)[1]):
            candidate = _at(u, y, orders, tried)
            if candidate.cost < point.cost:
                return candidate, max(damping / 10.0, 1e-18)
        damping = 10.0 * damping
    return point, damping


def _starts(u: FloatArray, y: FloatArray, orders: Orders) -> list[_Point]:
    begin = past_length(orders)
    matrix = np.column_stack([*regressors(u, y, orders), np.ones(len(y))])[begin:]
    solution = least_squares(matrix, y[begin:], str(orders))
    b, a = split(solution.parameters, orders)
    candidates = [(b, stabilised(a)), instrumental_variable(u, y, orders, a)]
    return [_with_nuisances(u, y, orders, *candidate) for candidate in candidates]


def _with_nuisances(
    u: FloatArray, y: FloatArray, orders: Orders, b: FloatArray, a: FloatArray
) -> _Point:
    """Return the point whose past and offset fit best by linear least squares."""
    forced = filtered(np.r_[np.zeros(orders.delay), b], a, u)
    columns = np.column_stack([*free_responses(a, orders, len(u)), np.ones(len(u))])
    nuisances, *_ = np.linalg.lstsq(columns, y - forced, rcond=None)
    return _at(u, y, orders, np.r_[b, a[1:], nuisances])


def _at(u: FloatArray, y: FloatArray, orders: Orders, parameters: FloatArray) -> _Point:
    b, a = split(parameters, orders)
    past = parameters[orders.coefficients + orders.poles : -1]
    source = filtered(np.r_[np.zeros(orders.delay), b], np.ones(1), u)
    source[: len(past)] += past
    output = filtered(np.ones(1), a, source) + parameters[-1]
    return _Point(parameters, output, y - output)


def _jacobian(u: FloatArray, point: _Point, orders: Orders) -> FloatArray:
    """Return ∂output/∂(b, a, past, c), (n, k)."""
    _, a = split(point.parameters, orders)
    low_u = filtered(np.ones(1), a, u)
    low_output = filtered(np.ones(1), a, point.output - point.parameters[-1])
    return np.column_stack(
        [
            *regressors(low_u, low_output, orders),
            *free_responses(a, orders, len(u)),
            np.ones(len(u)),
        ]
    )
