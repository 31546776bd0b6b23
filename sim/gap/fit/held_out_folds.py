"""What a fit leaves of records that it did not see: each is held out in turn.

A single record is held out by quarters.
"""

import numpy as np
import scipy

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.output_error import NUMERICAL, Fit, bounds, lost, residual_of

_DOUBT = 0.02  # of all that is known, which a fit to some records may keep of the others
_SHARES = (1.0, 0.5, 0.25, 0.1)  # of a step, that are tried
_PIECES = 4  # of a single record
_ASTRAY = 1.02  # times what was left of the rows that were fitted


def held_out(evidence: Evidence, fitted: Fit, shown: Evidence | None = None) -> FloatArray:
    """Return the remainder (rows,) of each record after a fit to all the others.

    Each fit is one Gauss-Newton step away from the fit to all. Directions in which the other
    records say hardly anything stay where they are. A single record is left out by quarters.
    What is left counts as in the evidence that was fitted to, or as in what is ``shown`` instead.
    """
    shown = shown or evidence
    if not fitted.free:
        return fitted.residual if shown is evidence else residual_of(shown, fitted.effects)
    low, high, _ = bounds(fitted.free)
    left = fitted.residual.copy()
    hessian = fitted.jacobian.T @ fitted.jacobian
    slope = fitted.jacobian.T @ fitted.residual
    for rows in folds(evidence):
        jacobian, residual = fitted.jacobian[rows], fitted.residual[rows]
        # What the others know, and a little of all: it keeps blind directions in place.
        known = (1.0 + _DOUBT) * hessian - jacobian.T @ jacobian
        try:
            x = _bounded_minimum(known, slope - jacobian.T @ residual, fitted.x, low, high)
        except NUMERICAL as error:
            return lost(evidence, fitted.effects, error).residual
        x, then = _kept_down(evidence, fitted, x, rows)
        if shown is not evidence:
            then = residual_of(shown, fitted.effects, fitted.free, x)
        left[rows] = then[rows]
    return left


def _kept_down(
    evidence: Evidence, fitted: Fit, x: FloatArray, out: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Return ``x`` and the residual (rows,) there, or nearer the fit where ``x`` went astray.

    A step is one towards a better fit of the rows that are not ``out``, which it must not make
    much worse: what is far from linear does not lie where its tangent points.
    """
    known = float(np.sum(fitted.residual[~out] ** 2))
    for share in _SHARES:
        there = fitted.x + share * (x - fitted.x)
        then = residual_of(evidence, fitted.effects, fitted.free, there)
        if float(np.sum(then[~out] ** 2)) <= _ASTRAY * known:
            return there, then
    return fitted.x, fitted.residual


def _bounded_minimum(
    hessian: FloatArray, slope: FloatArray, x: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Return where the quadratic about ``x`` with this slope is least, within bounds."""
    scale = np.sqrt(np.maximum(np.diag(hessian), 1e-300))
    values, vectors = np.linalg.eigh(hessian / np.outer(scale, scale))
    if values.max() <= 0.0:
        return np.asarray(np.clip(x, low, high))  # no row speaks of any parameter
    roots = np.sqrt(np.maximum(values, 1e-12 * values.max()))
    rows = roots[:, None] * vectors.T  # rowsᵀ rows is the scaled hessian
    target = -(vectors.T @ (slope / scale)) / roots
    lows, highs = (low - x) * scale, (high - x) * scale
    step = scipy.optimize.lsq_linear(
        rows, target, (np.minimum(lows, 0.0) - 1e-9, np.maximum(highs, 0.0) + 1e-9)
    )
    return np.asarray(np.clip(x + step.x / scale, low, high))


def folds(evidence: Evidence) -> list[BoolArray]:
    """Return which rows (rows,) are left out together: each record, or quarters of a single one."""
    parts = evidence.parts
    rows = parts[-1].rows.stop
    several = len(evidence.observations) > 1
    found = []
    for number in range(len(evidence.observations)):
        for piece in range(1 if several else _PIECES):
            out = np.zeros(rows, dtype=np.bool_)
            for part in parts:
                if part.record == number:
                    begin, size = part.rows.start, part.rows.stop - part.rows.start
                    pieces = 1 if several else _PIECES
                    out[begin + size * piece // pieces : begin + size * (piece + 1) // pieces] = (
                        True
                    )
            found.append(out)
    return found
