"""Least squares by jacobians that are carried along."""

import numpy as np
import pytest

from rotemina.sim.gap.fit.descent import begun, descend, exact

WIDE = np.full(2, -10.0), np.full(2, 10.0)


def rosenbrock(x):
    return np.array([10.0 * (x[1] - x[0] ** 2), 1.0 - x[0]])


class Counted:
    def __init__(self, residual):
        self.residual, self.runs = residual, 0

    def __call__(self, x):
        self.runs += 1
        return self.residual(x)


def descended(residual, start, low, high, steps):
    return descend(residual, begun(residual, np.array(start), low, high), low, high, steps)


def test_a_curved_valley_is_followed_to_its_end():
    found = descended(rosenbrock, [-1.2, 1.0], *WIDE, 200)
    np.testing.assert_allclose(found.x, [1.0, 1.0], atol=1e-3)


def test_what_lies_beyond_a_bound_ends_at_it():
    found = descended(lambda x: x - np.array([3.0, -20.0]), [0.0, 0.0], *WIDE, 10)
    np.testing.assert_allclose(found.x, [3.0, -10.0], atol=1e-9)


def test_a_linear_problem_takes_one_jacobian():
    rng = np.random.default_rng(0)
    matrix, wanted = rng.standard_normal((40, 6)), rng.standard_normal(6)
    low, high = np.full(6, -9.0), np.full(6, 9.0)
    residual = Counted(lambda x: matrix @ (x - wanted) + 1e-3)
    found = descended(residual, np.zeros(6), low, high, 10)
    np.testing.assert_allclose(found.x, wanted, atol=1e-3)
    assert residual.runs < 3 * 7 + 6


def test_the_jacobian_of_an_end_is_its_own_once_it_is_asked_for():
    bowl = Counted(lambda x: np.array([x[0] ** 3 - 8.0, x[1] - 1.0]))
    found = descended(bowl, [1.0, 0.0], *WIDE, 3)
    assert exact(bowl, found, WIDE[1]).jacobian[0, 0] == pytest.approx(
        3.0 * found.x[0] ** 2, rel=0.01
    )


def test_slopes_that_are_lent_mislead_nobody():
    """Wrong ones are taken anew as soon as they lead no further."""
    rng = np.random.default_rng(0)
    matrix, wanted = rng.standard_normal((40, 6)), rng.standard_normal(6)
    residual = Counted(lambda x: matrix @ (x - wanted))
    low, high = np.full(6, -10.0), np.full(6, 10.0)
    for lent in (matrix, -matrix):
        residual.runs = 0
        start = begun(residual, np.zeros(6), low, high, {n: lent[:, n] for n in range(6)})
        assert residual.runs == 1
        assert not start.fresh
        found = descend(residual, start, low, high, 20)
        np.testing.assert_allclose(found.x, wanted, atol=1e-3)
