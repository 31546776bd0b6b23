"""The linear part of a sensor's model as columns, run by run, and its least squares.

Only sums of products are kept (Gram matrices), one of each run, so any choice of columns and of
runs is solved in no time.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor import SHARES, SensorModel, waves
from rotemina.sim.calibration.sensor_lag import Lag, lagged, slope_by_lag
from rotemina.sim.stops import stops

_TINY = 1e-9  # of the largest: a singular value that is none


class Run(NamedTuple):
    """A stretch of even rows: reading and reference (n,), m or rad, ``step_s`` apart.

    One row in ``every`` takes part in a fit, which sees the lag between all of them.
    """

    reading: FloatArray
    reference: FloatArray
    step_s: float
    every: int = 1


class Choice(NamedTuple):
    """Which columns a model has: coefficients of the bend, hysteresis, interpolation, lag."""

    bends: int = 0
    hysteresis: bool = False
    period: float = 0.0
    lag: Lag = Lag.NONE


def columns(
    run: Run, bounds: tuple[float, float], choice: Choice, lag_s: float
) -> tuple[FloatArray, FloatArray]:
    """Return columns (m, k) and what they are to explain, ``y − q̃`` (m,), of some of the rows.

    The columns are 1, q̃, bends, stops, waves, and ``d q̃/d T`` where there is a lag.
    """
    low, high = bounds
    kept = slice(None, None, run.every)
    whole = lagged(run.reference, choice.lag, lag_s, run.step_s)
    moved = whole[kept]
    place = SensorModel(low=low, high=high).place(moved)
    blocks = [np.ones((len(moved), 1)), moved[:, None]]
    if choice.bends:
        powers = np.vander(place, choice.bends, increasing=True)
        blocks.append((1.0 - place**2)[:, None] * powers)
    if choice.hysteresis:
        radii = np.array(SHARES) * (high - low)
        blocks.append(stops(whole, radii, np.full(len(radii), whole[0]))[kept])
    if choice.period:
        blocks.append(waves(moved, choice.period))
    if choice.lag is not Lag.NONE:
        slope = slope_by_lag(run.reference, choice.lag, lag_s, run.step_s)
        blocks.append(slope[kept, None])
    return np.concatenate(blocks, axis=1), run.reading[kept] - moved


def indices(choice: Choice, within: Choice) -> list[int]:
    """Return which of the columns of ``within`` are those of ``choice``."""
    at = 2 + within.bends
    found = list(range(2 + choice.bends))
    for has, wanted, count in (
        (within.hysteresis, choice.hysteresis, len(SHARES)),
        (within.period != 0.0, choice.period != 0.0, 4),
        (within.lag is not Lag.NONE, choice.lag is not Lag.NONE, 1),
    ):
        if has:
            found += range(at, at + count) if wanted else ()
            at += count
    return found


class Gram(NamedTuple):
    """Sums of products of columns (k, k), with the target (k,), of the target, and the rows."""

    matrix: FloatArray
    vector: FloatArray
    square: float
    rows: int

    @classmethod
    def of(cls, table: FloatArray, target: FloatArray) -> "Gram":
        """Return those of columns (n, k) and a target (n,)."""
        return cls(table.T @ table, table.T @ target, float(target @ target), len(target))

    @classmethod
    def total(cls, parts: Sequence["Gram"]) -> "Gram":
        """Return those of several runs together."""
        return cls(
            np.sum([part.matrix for part in parts], axis=0),
            np.sum([part.vector for part in parts], axis=0),
            sum(part.square for part in parts),
            sum(part.rows for part in parts),
        )

    def only(self, chosen: list[int]) -> "Gram":
        """Return those of some of the columns."""
        return Gram(
            self.matrix[np.ix_(chosen, chosen)], self.vector[chosen], self.square, self.rows
        )

    def solved(self) -> FloatArray:
        """Return the least-squares solution; undetermined parameters are 0."""
        scale, inverse = self._scaled_inverse()
        return np.asarray(inverse @ (self.vector / scale) / scale)

    def inverse(self) -> FloatArray:
        """Return the pseudo-inverse of the matrix."""
        scale, inverse = self._scaled_inverse()
        return np.asarray(inverse / np.outer(scale, scale))

    def _scaled_inverse(self) -> tuple[FloatArray, FloatArray]:
        """Return the sizes of the columns (k,), and the pseudo-inverse with all of size 1."""
        scale = np.sqrt(np.diag(self.matrix))
        scale = np.where(scale > 0.0, scale, 1.0)
        equal = self.matrix / np.outer(scale, scale)
        return scale, np.linalg.pinv(equal, rcond=_TINY, hermitian=True)

    def mean_square(self, parameters: FloatArray) -> float:
        """Return the mean square residual of parameters."""
        left = self.square - 2.0 * parameters @ self.vector + parameters @ self.matrix @ parameters
        return max(float(left), 0.0) / self.rows


def model_of(
    bounds: tuple[float, float], choice: Choice, parameters: FloatArray, lag_s: float
) -> SensorModel:
    """Return the model of parameters (k,) that were fitted to ``y − q``."""
    low, high = bounds
    at = 2 + choice.bends
    weights: tuple[float, ...] = ()
    if choice.hysteresis:
        weights = tuple(parameters[at : at + len(SHARES)].tolist())
        at += len(SHARES)
    harmonics = tuple(parameters[at : at + 4].tolist()) if choice.period else ()
    return SensorModel(
        low=low,
        high=high,
        offset=float(parameters[0]),
        gain_error=float(parameters[1]),
        bend=tuple(parameters[2 : 2 + choice.bends].tolist()),
        radii=tuple(share * (high - low) for share in SHARES) if choice.hysteresis else (),
        weights=weights,
        lag=choice.lag,
        lag_s=lag_s if choice.lag is not Lag.NONE else 0.0,
        period=choice.period,
        harmonics=harmonics,
    )
