"""Output-error models, which fit the simulated output, so that sensor noise causes no bias."""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.identification.arx import (
    SignalScales,
    least_squares,
    make_regressors,
    refine_by_instrumental_variables,
    split_parameters,
)
from rotemina.sim.identification.experiment_signals import ExperimentSignals
from rotemina.sim.identification.model import (
    IdentifiedModel,
    ModelOrders,
    check_signals,
    fit_percent,
    make_free_responses,
    past_length,
)
from rotemina.sim.identification.transfer_function import (
    apply_filter,
    is_stable,
    stabilise,
)

_MAX_ITERATIONS = 100
# Smallest relative change of the cost. The search has converged if an iteration changes it less.
_MIN_COST_CHANGE_RATIO = 1e-10
# Relative rms error of the output at which the fit is exact to rounding.
_MIN_ERROR_RATIO = 1e-13
# Levenberg–Marquardt damping at which the search for a better step ends.
_MAX_DAMPING = 1e12


@dataclass(frozen=True, slots=True, eq=False)
class _SearchPoint:
    """A point of the search: parameters (k,), output (n,) and residual (n,)."""

    parameters: FloatArray
    output: FloatArray
    residual: FloatArray

    @property
    def cost(self) -> float:
        return float(self.residual @ self.residual)


def identify_oe(signals: ExperimentSignals, orders: ModelOrders) -> IdentifiedModel:
    """Fit ``y = q^-delay B(q)/A(q) u + c + e`` with white e, by prediction-error iteration.

    The search (Levenberg–Marquardt with exact gradients) starts from the ARX estimate or from
    instrumental variables, whichever simulates better. The response to the inputs before the first
    sample and the offset c are fitted too. Source: L. Ljung, *System Identification*, 2nd ed.,
    1999, sections 4.2, 10.2.

    Raises
    ------
    IdentificationError
        If the signals are too short, constant, or do not determine every parameter.
    """
    input_signal, measured = check_signals(signals, orders)
    scales = SignalScales.of(input_signal, measured)
    u, y = scales.scale(input_signal, measured)
    point, iterations = _search(u, y, orders)
    jacobian = _compute_jacobian(u, point, orders)
    # The nuisance parameters are projected out before the rank is checked. Their effect may be too
    # weak to determine them, which does not matter.
    parameter_count = orders.coefficients + orders.poles
    nuisance, _ = np.linalg.qr(jacobian[:, parameter_count:])
    columns = jacobian[:, :parameter_count] - nuisance @ (
        nuisance.T @ jacobian[:, :parameter_count]
    )
    inverse = least_squares(columns, point.residual, str(orders)).inverse
    variance = point.cost / max(len(y) - jacobian.shape[1], 1)
    b, a = split_parameters(point.parameters, orders)
    model = scales.to_transfer_function(b, a, orders.delay, signals.rate_hz)
    return IdentifiedModel(
        "oe",
        model,
        scales.unscale_offset(model, float(point.parameters[-1])),
        scales.unscale_covariance(variance * inverse, orders),
        fit_percent(y, point.output),
        None,
        float(np.sqrt(variance)) * scales.output_spread,
        iterations,
    )


def _search(u: FloatArray, y: FloatArray, orders: ModelOrders) -> tuple[_SearchPoint, int]:
    point = min(_make_start_points(u, y, orders), key=lambda candidate: candidate.cost)
    damping = 1e-3
    for iteration in range(1, _MAX_ITERATIONS + 1):
        if point.cost <= _MIN_ERROR_RATIO**2 * len(y):
            return point, iteration - 1
        jacobian = _compute_jacobian(u, point, orders)
        previous_cost = point.cost
        point, damping = _improve(u, y, orders, point, jacobian, damping)
        if previous_cost - point.cost <= _MIN_COST_CHANGE_RATIO * previous_cost:
            return point, iteration
    return point, _MAX_ITERATIONS


def _improve(
    u: FloatArray,
    y: FloatArray,
    orders: ModelOrders,
    point: _SearchPoint,
    jacobian: FloatArray,
    damping: float,
) -> tuple[_SearchPoint, float]:
    """Return a stable point of lower cost, or the same point, and the next damping."""
    column_norms = np.linalg.norm(jacobian, axis=0)
    column_norms[column_norms == 0.0] = 1.0
    left_vectors, singular_values, right_vectors = np.linalg.svd(
        jacobian / column_norms, full_matrices=False
    )
    projected = left_vectors.T @ point.residual
    while damping <= _MAX_DAMPING:
        step = (
            right_vectors.T
            @ (
                projected
                * singular_values
                / (singular_values**2 + damping * singular_values[0] ** 2)
            )
            / column_norms
        )
        parameters = point.parameters + step
        if is_stable(split_parameters(parameters, orders)[1]):
            candidate = _evaluate(u, y, orders, parameters)
            if candidate.cost < point.cost:
                return candidate, max(damping / 10.0, 1e-18)
        damping = 10.0 * damping
    return point, damping


def _make_start_points(u: FloatArray, y: FloatArray, orders: ModelOrders) -> list[_SearchPoint]:
    start = past_length(orders)
    matrix = np.column_stack([*make_regressors(u, y, orders), np.ones(len(y))])[start:]
    solution = least_squares(matrix, y[start:], str(orders))
    b, a = split_parameters(solution.parameters, orders)
    candidates = [(b, stabilise(a)), refine_by_instrumental_variables(u, y, orders, a)]
    return [_fit_nuisances(u, y, orders, *candidate) for candidate in candidates]


def _fit_nuisances(
    u: FloatArray, y: FloatArray, orders: ModelOrders, b: FloatArray, a: FloatArray
) -> _SearchPoint:
    """Return the point with the free response and offset that fit best by least squares."""
    forced = apply_filter(np.r_[np.zeros(orders.delay), b], a, u)
    columns = np.column_stack([*make_free_responses(a, orders, len(u)), np.ones(len(u))])
    nuisances, *_ = np.linalg.lstsq(columns, y - forced, rcond=None)
    return _evaluate(u, y, orders, np.r_[b, a[1:], nuisances])


def _evaluate(
    u: FloatArray, y: FloatArray, orders: ModelOrders, parameters: FloatArray
) -> _SearchPoint:
    b, a = split_parameters(parameters, orders)
    free_response = parameters[orders.coefficients + orders.poles : -1]
    source = apply_filter(np.r_[np.zeros(orders.delay), b], np.ones(1), u)
    source[: len(free_response)] += free_response
    output = apply_filter(np.ones(1), a, source) + parameters[-1]
    return _SearchPoint(parameters, output, y - output)


def _compute_jacobian(u: FloatArray, point: _SearchPoint, orders: ModelOrders) -> FloatArray:
    """Return ∂output/∂(b, a, free response, c), (n, k)."""
    _, a = split_parameters(point.parameters, orders)
    filtered_u = apply_filter(np.ones(1), a, u)
    filtered_output = apply_filter(np.ones(1), a, point.output - point.parameters[-1])
    return np.column_stack(
        [
            *make_regressors(filtered_u, filtered_output, orders),
            *make_free_responses(a, orders, len(u)),
            np.ones(len(u)),
        ]
    )
