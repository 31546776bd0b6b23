"""Bounded nonlinear least squares for simulated models.

Gauss-Newton steps with Levenberg-Marquardt damping (Nocedal and Wright, Numerical Optimization, 2nd
ed., 10.3), cut off at the bounds; parameters pressed against a bound stay there. Derivatives are
forward differences with steps large enough for simulations with steps and dead bands; general
libraries choose far too small ones where a parameter is zero.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray

_STEP = 1e-3  # of a parameter, for its derivative
_DAMPING = 1e-3  # at first, of the diagonal
_LEAST_DAMPING = 1e-9
_TRIES = 5  # of damping a step until it goes down
_TRIES_CARRIED = 2  # the same with a jacobian that was carried along
_ENOUGH = 1e-3  # relative gain of a step below which no further one is worth its runs
_WORTH_CARRYING = 0.02  # relative gain of a step, below which the jacobian is taken anew
_TINY = 1e-12

Residual = Callable[[FloatArray], FloatArray]


class Descent(NamedTuple):
    """Where a descent is: ``x`` (p,), residual (n,) there and its jacobian (n, p).

    The jacobian is by differences at ``x`` if it is ``fresh``, and else carried along from where
    the sum of squares was ``since``.
    """

    x: FloatArray
    residual: FloatArray
    jacobian: FloatArray
    fresh: bool = True
    damping: float = _DAMPING
    since: float = np.inf


def begun(
    residual: Residual,
    start: FloatArray,
    low: FloatArray,
    high: FloatArray,
    known: Mapping[int, FloatArray] = MappingProxyType({}),
) -> Descent:
    """Return a descent before its first step from ``start`` (p,).

    Columns (n,) of the jacobian that are ``known`` from nearby are taken as they are.
    """
    x = np.clip(start, low, high)
    left = residual(x)
    slopes = _slopes(residual, x, left, high, known)
    return Descent(x, left, slopes, not known, since=np.inf if known else float(left @ left))


def descend(
    residual: Residual, at: Descent, low: FloatArray, high: FloatArray, most_steps: int
) -> Descent:
    """Reduce the sum of squares of ``residual(x)`` (n,) from the state of a descent, within bounds.

    Scale parameters to sizes of about one. Differences cost one run per parameter, so the Jacobian
    is recomputed only when the updated one makes no further progress.
    """
    for _ in range(most_steps):
        at, gain = _onwards(residual, at, low, high)
        if gain < _ENOUGH:
            break
    return at


def exact(residual: Residual, at: Descent, high: FloatArray, *, nearly: bool = False) -> Descent:
    """Return a descent with its Jacobian recomputed, if it was only updated.

    With ``nearly``, one taken close by is kept.
    """
    if at.fresh or (nearly and _is_near(at)):
        return at
    slopes = _slopes(residual, at.x, at.residual, high)
    return at._replace(jacobian=slopes, fresh=True, since=float(at.residual @ at.residual))


def _onwards(
    residual: Residual, at: Descent, low: FloatArray, high: FloatArray
) -> tuple[Descent, float]:
    """Return a descent one step on, and by what share the sum of squares went down."""
    before = float(at.residual @ at.residual)
    step = _step(residual, at, low, high)
    if step is not None:
        x, left, damping = step
        gain = 1.0 - float(left @ left) / before
        if gain >= (_ENOUGH if at.fresh else _WORTH_CARRYING):
            carried = _carried(at, x, left)
            return Descent(x, left, carried, False, damping, at.since), gain
        at = at._replace(x=x, residual=left, damping=damping)
    if at.fresh:
        return at._replace(fresh=step is None), 0.0
    return _onwards(residual, exact(residual, at, high)._replace(damping=_DAMPING), low, high)


def _is_near(at: Descent) -> bool:
    """Tell whether the sum of squares has hardly changed since the jacobian was computed."""
    return float(at.residual @ at.residual) > (1.0 - _WORTH_CARRYING) * at.since


def _carried(at: Descent, x: FloatArray, left: FloatArray) -> FloatArray:
    """Return the jacobian (n, p) carried along to ``x``: Broyden's rank-one update.

    Mathematics of Computation 19 (1965) 577-593, Eq. (4.5).
    """
    moved = x - at.x
    missed = left - at.residual - at.jacobian @ moved
    return np.asarray(at.jacobian + np.outer(missed, moved / (moved @ moved)))


def one_step(
    residual: Residual, start: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return where one step down from ``start`` (p,) leads, and the residual (n,) there."""
    at = begun(residual, start, low, high)
    step = _step(residual, at, low, high)
    return (at.x, at.residual) if step is None else step[:2]


def _step(
    residual: Residual, at: Descent, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray, float] | None:
    """Return x, residual and damping after a step that goes down; None where none does."""
    x, left, jacobian, fresh, damping, _ = at
    before = float(left @ left)
    slope = jacobian.T @ left
    free = _free(x, slope, low, high)
    hessian = (jacobian.T @ jacobian)[np.ix_(free, free)]
    diagonal = np.diag(hessian)
    still = _TINY * diagonal.max(initial=1.0)  # what no row speaks of stays
    for _ in range(_TRIES if fresh else _TRIES_CARRIED):
        after = x.copy()
        try:
            damped = hessian + np.diag(damping * diagonal + still)
            after[free] -= np.linalg.solve(damped, slope[free])
        except np.linalg.LinAlgError:  # columns that are parallel to the last digit
            damping *= 10.0
            continue
        after = np.clip(after, low, high)
        then = residual(after)
        if float(then @ then) < before:
            return after, then, max(damping / 10.0, _LEAST_DAMPING)
        damping *= 10.0
    return None


def _slopes(
    residual: Residual,
    x: FloatArray,
    left: FloatArray,
    high: FloatArray,
    known: Mapping[int, FloatArray] = MappingProxyType({}),
) -> FloatArray:
    """Return the jacobian (n, p) by differences, backward ones at the upper bound."""
    jacobian = np.empty((len(left), len(x)))
    for column in range(len(x)):
        if column in known:
            jacobian[:, column] = known[column]
            continue
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
