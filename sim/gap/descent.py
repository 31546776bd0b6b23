"""Bounded nonlinear least squares for models that are simulated.

Gauss-Newton steps damped as by Levenberg and Marquardt (Nocedal and Wright, Numerical
Optimization, 2nd ed., 10.3), cut off at the bounds; parameters that press against a bound stand
still. Derivatives are forward differences with steps that a simulation with steps and dead bands
in it can feel, which the solvers of general libraries choose far too small where a parameter is
zero.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_STEP = 1e-3  # of a parameter, for its derivative
_DAMPING = 1e-3  # at first, of the diagonal
_LEAST_DAMPING = 1e-9
_TRIES = 5  # of damping a step until it goes down
_ENOUGH = 1e-3  # relative gain of a step below which no further one is worth its runs
_TINY = 1e-12

Residual = Callable[[FloatArray], FloatArray]


class Descent(NamedTuple):
    """Where a descent ended: ``x`` (p,), residual (n,) and its jacobian (n, p) nearby."""

    x: FloatArray
    residual: FloatArray
    jacobian: FloatArray


def descend(
    residual: Residual, start: FloatArray, low: FloatArray, high: FloatArray, most_steps: int
) -> Descent:
    """Lessen the sum of squares of ``residual(x)`` (n,) from ``start`` (p,) on, within bounds.

    Parameters should be scaled to sizes of about one.
    """
    x = np.clip(start, low, high)
    left = residual(x)
    jacobian = _slopes(residual, x, left, high)
    damping = _DAMPING
    for _ in range(most_steps):
        before = float(left @ left)
        step = _step(residual, x, left, jacobian, low, high, damping)
        if step is None:
            break
        x, left, damping = step
        jacobian = _slopes(residual, x, left, high)
        if float(left @ left) > before * (1.0 - _ENOUGH):
            break
    return Descent(x, left, jacobian)


def one_step(
    residual: Residual, start: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return where one step down from ``start`` (p,) leads, and the residual (n,) there."""
    x = np.clip(start, low, high)
    left = residual(x)
    step = _step(residual, x, left, _slopes(residual, x, left, high), low, high, _DAMPING)
    return (x, left) if step is None else step[:2]


def _step(
    residual: Residual,
    x: FloatArray,
    left: FloatArray,
    jacobian: FloatArray,
    low: FloatArray,
    high: FloatArray,
    damping: float,
) -> tuple[FloatArray, FloatArray, float] | None:
    """Return x, residual and damping after a step that goes down; None where none does."""
    before = float(left @ left)
    slope = jacobian.T @ left
    free = _free(x, slope, low, high)
    hessian = (jacobian.T @ jacobian)[np.ix_(free, free)]
    diagonal = np.diag(hessian)
    still = _TINY * diagonal.max(initial=1.0)  # what no row speaks of stays
    for _ in range(_TRIES):
        after = x.copy()
        after[free] -= np.linalg.solve(hessian + np.diag(damping * diagonal + still), slope[free])
        after = np.clip(after, low, high)
        then = residual(after)
        if float(then @ then) < before:
            return after, then, max(damping / 10.0, _LEAST_DAMPING)
        damping *= 10.0
    return None


def _slopes(residual: Residual, x: FloatArray, left: FloatArray, high: FloatArray) -> FloatArray:
    """Return the jacobian (n, p) by differences, backward ones at the upper bound."""
    jacobian = np.empty((len(left), len(x)))
    for column in range(len(x)):
        step = _STEP * max(1.0, abs(x[column]))
        if x[column] + step > high[column]:
            step = -step
        aside = x.copy()
        aside[column] += step
        jacobian[:, column] = (residual(aside) - left) / step
    return jacobian


def _free(x: FloatArray, slope: FloatArray, low: FloatArray, high: FloatArray) -> BoolArray:
    """Return which parameters (p,) may move: those at a bound that want to leave it, and others."""
    held = ((x <= low) & (slope > 0.0)) | ((x >= high) & (slope < 0.0))
    return np.asarray(~held)
