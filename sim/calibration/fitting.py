"""Fit of a sensor model to runs: structure, parameters and confidence intervals.

A term is kept in the model if it improves the prediction of held-out runs by more than the
standard error of that improvement (Breiman et al., Classification and Regression Trees (1984),
section 3.4.3: the one-standard-error rule).

The noise of a sensor is not white. So the confidence intervals come from the scores of blocks of
rows, each far longer than the correlation time of the noise. The covariance of the parameters is
the sandwich ``G⁻¹ Σ_b s_b s_bᵀ G⁻¹`` (Liang and Zeger, Biometrika 73 (1986) 13–22). The quantile is
that of Student's t, with as many degrees of freedom as blocks less parameters. The interval of the
lag is widened by the effect of oscillations between two rows, which are not recorded.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.regression_columns import (
    GramMatrix,
    SensorModelStructure,
    SensorRun,
    find_column_indices,
    make_columns,
    make_model,
)
from rotemina.sim.calibration.sensor import MAX_BEND_COEFFICIENTS, SensorModel
from rotemina.sim.calibration.sensor_lag import MAX_LAG_S, SensorLag

BLOCKS_PER_RUN = 8
INTERVAL_PROBABILITY = 0.95
_MAX_ITERATIONS = 12
# A richer model must reduce the error by at least this share.
_MIN_RELATIVE_GAIN = 0.002
_LAG_TOLERANCE_S = 2e-8


class FittedSensorModel(NamedTuple):
    """A fitted model, the covariance (k, k) of its parameters, and the number of blocks used."""

    model: SensorModel
    structure: SensorModelStructure
    covariance: FloatArray
    blocks: int

    @property
    def quantile(self) -> float:
        """Ratio of the half width of the 95 % interval to the standard deviation."""
        # Imported here because the import takes a third of a second.
        from scipy.stats import t as student

        degrees_of_freedom = max(self.blocks - len(self.covariance), 2)
        return float(student.ppf(0.5 + INTERVAL_PROBABILITY / 2.0, degrees_of_freedom))

    def compute_half_width(self, weights: dict[int, float]) -> float:
        """Return the half width of the interval of a weighted sum of parameters."""
        vector = np.zeros(len(self.covariance))
        for index, weight in weights.items():
            vector[index] = weight
        return self.quantile * sqrt(max(float(vector @ self.covariance @ vector), 0.0))


def fit(
    runs: list[SensorRun],
    bounds: tuple[float, float],
    structure: SensorModelStructure,
    start_s: float = 0.0,
) -> FittedSensorModel:
    """Fit a model of known structure by least squares of ``y − q̃``, and the lag T by Gauss–Newton.

    ``start_s`` is the initial value of T.
    """
    lag_s = find_lag(runs, bounds, structure, start_s)
    systems = [make_columns(run, bounds, structure, lag_s) for run in runs]
    gram_total = GramMatrix.total([GramMatrix.of(*system) for system in systems])
    parameters = gram_total.solve()
    scores = np.array(
        [
            table[block].T @ (target - table @ parameters)[block]
            for table, target in systems
            for block in np.array_split(np.arange(len(target)), BLOCKS_PER_RUN)
        ]
    )
    gram_inverse = gram_total.compute_inverse()
    small_sample_factor = len(scores) / max(len(scores) - 1, 1)
    covariance = small_sample_factor * gram_inverse @ (scores.T @ scores) @ gram_inverse
    return FittedSensorModel(
        make_model(bounds, structure, parameters, lag_s), structure, covariance, len(scores)
    )


def find_lag(
    runs: list[SensorRun],
    bounds: tuple[float, float],
    structure: SensorModelStructure,
    start_s: float = 0.0,
) -> float:
    """Return the lag T, s, or 0 if the structure has no lag or the sensor does not lag."""
    if structure.lag is SensorLag.NONE:
        return 0.0
    lag_s = start_s
    for _ in range(_MAX_ITERATIONS):
        grams = [GramMatrix.of(*make_columns(run, bounds, structure, lag_s)) for run in runs]
        previous_s, lag_s = lag_s, lag_s + float(GramMatrix.total(grams).solve()[-1])
        lag_s = min(max(lag_s, 0.0), MAX_LAG_S)
        if abs(lag_s - previous_s) < _LAG_TOLERANCE_S:
            break
    return lag_s


def choose_structure(
    runs: list[SensorRun], bounds: tuple[float, float], period: float, lags: bool
) -> SensorModelStructure:
    """Choose the structure that the held-out runs support.

    Parameters
    ----------
    runs : list of SensorRun
        At least three.
    bounds : (low, high)
        The range, m or rad.
    period : float
        Possible period of an encoder's interpolation error; 0 for none.
    lags : bool
        Whether both channels have the same clock, so that a lag can be identified.
    """
    lag_kinds = (SensorLag.FIRST_ORDER, SensorLag.DELAY) if lags else ()
    candidates = [
        _Candidate.of(runs, bounds, SensorModelStructure(MAX_BEND_COEFFICIENTS, True, period, kind))
        for kind in lag_kinds
    ]
    candidates.append(
        _Candidate.of(runs, bounds, SensorModelStructure(MAX_BEND_COEFFICIENTS, True, period))
    )
    best = candidates[-1]
    for candidate in reversed(candidates[:-1]):
        if _is_improvement(
            best.compute_errors(best.structure), candidate.compute_errors(candidate.structure)
        ):
            best = candidate
    choice = best.structure
    without_hysteresis = choice._replace(hysteresis=False)
    if not _is_improvement(best.compute_errors(without_hysteresis), best.compute_errors(choice)):
        choice = without_hysteresis
    for bends in range(choice.bends):
        with_fewer_bends = choice._replace(bends=bends)
        if not _is_improvement(best.compute_errors(with_fewer_bends), best.compute_errors(choice)):
            return with_fewer_bends
    return choice


class _Candidate(NamedTuple):
    """The Gram matrices of all runs, for the richest model with one kind of lag."""

    structure: SensorModelStructure
    grams: list[GramMatrix]

    @classmethod
    def of(
        cls, runs: list[SensorRun], bounds: tuple[float, float], structure: SensorModelStructure
    ) -> "_Candidate":
        lag_s = find_lag(runs, bounds, structure)
        return cls(
            structure, [GramMatrix.of(*make_columns(run, bounds, structure, lag_s)) for run in runs]
        )

    def compute_errors(self, choice: SensorModelStructure) -> FloatArray:
        """Return the mean square errors (runs,), each run predicted by a fit to the others."""
        columns = find_column_indices(choice, self.structure)
        parts = [gram.select_columns(columns) for gram in self.grams]
        return np.array(
            [
                part.compute_mean_square(
                    GramMatrix.total(parts[:number] + parts[number + 1 :]).solve()
                )
                for number, part in enumerate(parts)
            ]
        )


def _is_improvement(before: FloatArray, after: FloatArray) -> bool:
    """Return whether errors (runs,) fell by more than chance, and by a relevant amount."""
    reductions = before - after
    standard_error = float(reductions.std(ddof=1)) / np.sqrt(len(reductions))
    return bool(reductions.mean() > max(standard_error, _MIN_RELATIVE_GAIN * float(before.mean())))
