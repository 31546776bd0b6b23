"""The linear part of a sensor's model as columns of a least-squares problem.

Only the Gram matrix of each run is kept, so that any selection of columns and runs can be solved
quickly.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor import STOP_RADIUS_SHARES, SensorModel, compute_waves
from rotemina.sim.calibration.sensor_lag import SensorLag, apply_lag, compute_lag_slope
from rotemina.sim.compensate import compute_stops

# Singular values below this share of the largest one count as 0.
_SINGULAR_VALUE_CUTOFF = 1e-9


class SensorRun(NamedTuple):
    """Evenly spaced rows: reading and reference (n,), m or rad, ``step_s`` apart.

    A fit uses only each ``every``-th row, but the lag is computed from all rows.
    """

    reading: FloatArray
    reference: FloatArray
    step_s: float
    stride: int = 1


class SensorModelStructure(NamedTuple):
    """The terms of a sensor model, which determine its columns.

    Attributes
    ----------
    bends : number of coefficients of the bend.
    hysteresis : whether there are stops.
    period : of the interpolation error, m or rad; 0 without any.
    lag : kind of lag.
    """

    bends: int = 0
    hysteresis: bool = False
    period: float = 0.0
    lag: SensorLag = SensorLag.NONE


def make_columns(
    run: SensorRun, bounds: tuple[float, float], structure: SensorModelStructure, lag_s: float
) -> tuple[FloatArray, FloatArray]:
    """Return the columns (m, k) and their target ``y − q̃`` (m,), for the rows used in a fit.

    The columns are 1, q̃, bends, stops, waves, and ``d q̃/d T`` if there is a lag.
    """
    low, high = bounds
    fit_rows = slice(None, None, run.stride)
    lagged_reference = apply_lag(run.reference, structure.lag, lag_s, run.step_s)
    position = lagged_reference[fit_rows]
    place = SensorModel(low=low, high=high).normalise_position(position)
    blocks = [np.ones((len(position), 1)), position[:, None]]
    if structure.bends:
        powers = np.vander(place, structure.bends, increasing=True)
        blocks.append((1.0 - place**2)[:, None] * powers)
    if structure.hysteresis:
        radii = np.array(STOP_RADIUS_SHARES) * (high - low)
        blocks.append(
            compute_stops(lagged_reference, radii, np.full(len(radii), lagged_reference[0]))[
                fit_rows
            ]
        )
    if structure.period:
        blocks.append(compute_waves(position, structure.period))
    if structure.lag is not SensorLag.NONE:
        slope = compute_lag_slope(run.reference, structure.lag, lag_s, run.step_s)
        blocks.append(slope[fit_rows, None])
    return np.concatenate(blocks, axis=1), run.reading[fit_rows] - position


def find_column_indices(choice: SensorModelStructure, available: SensorModelStructure) -> list[int]:
    """Return the indices of the columns of ``choice`` among those of ``available``."""
    next_index = 2 + available.bends
    indices = list(range(2 + choice.bends))
    for is_available, is_chosen, count in (
        (available.hysteresis, choice.hysteresis, len(STOP_RADIUS_SHARES)),
        (available.period != 0.0, choice.period != 0.0, 4),
        (available.lag is not SensorLag.NONE, choice.lag is not SensorLag.NONE, 1),
    ):
        if is_available:
            indices += range(next_index, next_index + count) if is_chosen else ()
            next_index += count
    return indices


class GramMatrix(NamedTuple):
    """Sums of products of columns and target.

    Attributes
    ----------
    matrix : (k, k) of the columns.
    vector : (k,) of columns and target.
    square : of the target with itself.
    rows : number of rows.
    """

    matrix: FloatArray
    vector: FloatArray
    square: float
    rows: int

    @classmethod
    def of(cls, table: FloatArray, target: FloatArray) -> "GramMatrix":
        """Return the sums for columns (n, k) and a target (n,)."""
        return cls(table.T @ table, table.T @ target, float(target @ target), len(target))

    @classmethod
    def total(cls, parts: Sequence["GramMatrix"]) -> "GramMatrix":
        """Return the sums over several runs."""
        return cls(
            np.sum([part.matrix for part in parts], axis=0),
            np.sum([part.vector for part in parts], axis=0),
            sum(part.square for part in parts),
            sum(part.rows for part in parts),
        )

    def select_columns(self, selected: list[int]) -> "GramMatrix":
        """Return the sums for some of the columns."""
        return GramMatrix(
            self.matrix[np.ix_(selected, selected)], self.vector[selected], self.square, self.rows
        )

    def solve(self) -> FloatArray:
        """Return the least-squares solution; undetermined parameters are 0."""
        scale, inverse = self._invert_scaled()
        return np.asarray(inverse @ (self.vector / scale) / scale)

    def compute_inverse(self) -> FloatArray:
        """Return the pseudo-inverse of the matrix."""
        scale, inverse = self._invert_scaled()
        return np.asarray(inverse / np.outer(scale, scale))

    def _invert_scaled(self) -> tuple[FloatArray, FloatArray]:
        """Return the norms of the columns (k,), and the pseudo-inverse of the normalised matrix."""
        scale = np.sqrt(np.diag(self.matrix))
        scale = np.where(scale > 0.0, scale, 1.0)
        normalised = self.matrix / np.outer(scale, scale)
        return scale, np.linalg.pinv(normalised, rcond=_SINGULAR_VALUE_CUTOFF, hermitian=True)

    def compute_mean_square(self, parameters: FloatArray) -> float:
        """Return the mean square residual for given parameters."""
        square_sum = (
            self.square - 2.0 * parameters @ self.vector + parameters @ self.matrix @ parameters
        )
        return max(float(square_sum), 0.0) / self.rows


def make_model(
    bounds: tuple[float, float],
    structure: SensorModelStructure,
    parameters: FloatArray,
    lag_s: float,
) -> SensorModel:
    """Return the sensor model with the parameters (k,), which were fitted to ``y − q̃``."""
    low, high = bounds
    next_index = 2 + structure.bends
    weights: tuple[float, ...] = ()
    if structure.hysteresis:
        weights = tuple(parameters[next_index : next_index + len(STOP_RADIUS_SHARES)].tolist())
        next_index += len(STOP_RADIUS_SHARES)
    harmonics = tuple(parameters[next_index : next_index + 4].tolist()) if structure.period else ()
    return SensorModel(
        low=low,
        high=high,
        offset=float(parameters[0]),
        gain_error=float(parameters[1]),
        bend=tuple(parameters[2 : 2 + structure.bends].tolist()),
        radii=tuple(share * (high - low) for share in STOP_RADIUS_SHARES)
        if structure.hysteresis
        else (),
        weights=weights,
        lag=structure.lag,
        lag_s=lag_s if structure.lag is not SensorLag.NONE else 0.0,
        period=structure.period,
        harmonics=harmonics,
    )
