"""Least squares with Jacobians that are updated instead of recomputed."""

import numpy as np
import pytest

from rotemina.sim.gap.fit import begun, descend
from rotemina.sim.gap.fit.descent import exact

WIDE_BOUNDS = np.full(2, -10.0), np.full(2, 10.0)


def rosenbrock(x):
    return np.array([10.0 * (x[1] - x[0] ** 2), 1.0 - x[0]])


class CountedResidual:
    def __init__(self, residual):
        self.residual, self.runs = residual, 0

    def __call__(self, x):
        self.runs += 1
        return self.residual(x)


def run_descent(residual, start, low, high, steps):
    return descend(residual, begun(residual, np.array(start), low, high), low, high, steps)


def test_a_curved_valley_is_followed_to_its_minimum():
    result = run_descent(rosenbrock, [-1.2, 1.0], *WIDE_BOUNDS, 200)
    np.testing.assert_allclose(result.x, [1.0, 1.0], atol=1e-3)


def test_a_minimum_beyond_the_bounds_ends_at_them():
    result = run_descent(lambda x: x - np.array([3.0, -20.0]), [0.0, 0.0], *WIDE_BOUNDS, 10)
    np.testing.assert_allclose(result.x, [3.0, -10.0], atol=1e-9)


def test_a_linear_problem_takes_one_jacobian():
    rng = np.random.default_rng(0)
    matrix, solution = rng.standard_normal((40, 6)), rng.standard_normal(6)
    low, high = np.full(6, -9.0), np.full(6, 9.0)
    residual = CountedResidual(lambda x: matrix @ (x - solution) + 1e-3)
    result = run_descent(residual, np.zeros(6), low, high, 10)
    np.testing.assert_allclose(result.x, solution, atol=1e-3)
    assert residual.runs < 3 * 7 + 6


def test_the_jacobian_at_the_end_is_exact_on_request():
    residual = CountedResidual(lambda x: np.array([x[0] ** 3 - 8.0, x[1] - 1.0]))
    result = run_descent(residual, [1.0, 0.0], *WIDE_BOUNDS, 3)
    assert exact(residual, result, WIDE_BOUNDS[1]).jacobian[0, 0] == pytest.approx(
        3.0 * result.x[0] ** 2, rel=0.01
    )


def test_wrong_initial_slopes_do_not_mislead_the_descent():
    """Wrong slopes are recomputed as soon as they bring no improvement."""
    rng = np.random.default_rng(0)
    matrix, solution = rng.standard_normal((40, 6)), rng.standard_normal(6)
    residual = CountedResidual(lambda x: matrix @ (x - solution))
    low, high = np.full(6, -10.0), np.full(6, 10.0)
    for slopes in (matrix, -matrix):
        residual.runs = 0
        start = begun(residual, np.zeros(6), low, high, {n: slopes[:, n] for n in range(6)})
        assert residual.runs == 1
        assert not start.fresh
        result = descend(residual, start, low, high, 20)
        np.testing.assert_allclose(result.x, solution, atol=1e-3)
