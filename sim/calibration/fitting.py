"""Fit of a sensor's model to runs: structure by held-out runs, figures with intervals.

A model is as rich as the runs bear out: each part is kept if the runs left out of the fit are
predicted better with it, by more than the standard error of that gain (Breiman et al.,
Classification and Regression Trees (1984), section 3.4.3: the one-standard-error rule).

The noise of a sensor is not white, so intervals come from the scores of blocks of rows, each far
longer than the noise remembers: the sandwich covariance ``G⁻¹ Σ_b s_b s_bᵀ G⁻¹`` (Liang and Zeger,
Biometrika 73 (1986) 13–22), with Student's t of as many degrees of freedom as blocks are left.
The lag's interval is wider by what ringing between two rows hides.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.regression_columns import (
    Choice,
    Gram,
    Run,
    columns,
    indices,
    model_of,
)
from rotemina.sim.calibration.sensor import BENDS, SensorModel
from rotemina.sim.calibration.sensor_lag import MOST_S, Lag

BLOCKS = 8  # of each run
PROBABILITY = 0.95
_ROUNDS = 12
_WORTH = 0.002  # relative: less is no gain of a richer model
_SAME_S = 2e-8


class Fitted(NamedTuple):
    """A model with the covariance (k, k) of its parameters and how many blocks it comes from."""

    model: SensorModel
    choice: Choice
    covariance: FloatArray
    blocks: int

    @property
    def quantile(self) -> float:
        """Half width of a 95 % interval over a standard deviation."""
        from scipy.stats import t as student  # only here: it takes a third of a second

        freedom = max(self.blocks - len(self.covariance), 2)
        return float(student.ppf(0.5 + PROBABILITY / 2.0, freedom))

    def half_width(self, weights: dict[int, float]) -> float:
        """Return that of a weighted sum of parameters."""
        vector = np.zeros(len(self.covariance))
        for at, weight in weights.items():
            vector[at] = weight
        return self.quantile * sqrt(max(float(vector @ self.covariance @ vector), 0.0))


def fit(
    runs: list[Run], bounds: tuple[float, float], choice: Choice, start_s: float = 0.0
) -> Fitted:
    """Fit a model of known structure, by least squares of ``y − q̃``; T by Gauss–Newton.

    ``start_s`` is where the search for T begins.
    """
    lag_s = found_lag(runs, bounds, choice, start_s)
    tables = [columns(run, bounds, choice, lag_s) for run in runs]
    total = Gram.total([Gram.of(*each) for each in tables])
    parameters = total.solved()
    scores = np.array(
        [
            table[block].T @ (target - table @ parameters)[block]
            for table, target in tables
            for block in np.array_split(np.arange(len(target)), BLOCKS)
        ]
    )
    inverse = total.inverse()
    share = len(scores) / max(len(scores) - 1, 1)
    covariance = share * inverse @ (scores.T @ scores) @ inverse
    return Fitted(model_of(bounds, choice, parameters, lag_s), choice, covariance, len(scores))


def found_lag(
    runs: list[Run], bounds: tuple[float, float], choice: Choice, start_s: float = 0.0
) -> float:
    """Return T, s; 0 where the choice has none, or the sensor is not late."""
    if choice.lag is Lag.NONE:
        return 0.0
    lag_s = start_s
    for _ in range(_ROUNDS):
        parts = [Gram.of(*columns(run, bounds, choice, lag_s)) for run in runs]
        before, lag_s = lag_s, lag_s + float(Gram.total(parts).solved()[-1])
        lag_s = min(max(lag_s, 0.0), MOST_S)
        if abs(lag_s - before) < _SAME_S:
            break
    return lag_s


def chosen(runs: list[Run], bounds: tuple[float, float], period: float, lags: bool) -> Choice:
    """Return the structure that the held-out runs bear out.

    Parameters
    ----------
    runs : list of Run
        Three at the least.
    bounds : (low, high)
        The range, m or rad.
    period : float
        Of an encoder's interpolation error that may be there; 0: none.
    lags : bool
        Whether both channels are on one clock, so that a lag can be told.
    """
    kinds = (Lag.FIRST_ORDER, Lag.DELAY) if lags else ()
    candidates = [_Candidate.of(runs, bounds, Choice(BENDS, True, period, kind)) for kind in kinds]
    candidates.append(_Candidate.of(runs, bounds, Choice(BENDS, True, period)))
    best = candidates[-1]
    for candidate in reversed(candidates[:-1]):
        if _gains(best.errors(best.whole), candidate.errors(candidate.whole)):
            best = candidate
    choice = best.whole
    less = choice._replace(hysteresis=False)
    if not _gains(best.errors(less), best.errors(choice)):
        choice = less
    for bends in range(choice.bends):
        fewer = choice._replace(bends=bends)
        if not _gains(best.errors(fewer), best.errors(choice)):
            return fewer
    return choice


class _Candidate(NamedTuple):
    """The runs' sums for the richest model of one kind of lag."""

    whole: Choice
    grams: list[Gram]

    @classmethod
    def of(cls, runs: list[Run], bounds: tuple[float, float], whole: Choice) -> "_Candidate":
        lag_s = found_lag(runs, bounds, whole)
        return cls(whole, [Gram.of(*columns(run, bounds, whole, lag_s)) for run in runs])

    def errors(self, choice: Choice) -> FloatArray:
        """Return the mean square error at each run of a model that was fitted to the others."""
        kept = indices(choice, self.whole)
        parts = [gram.only(kept) for gram in self.grams]
        return np.array(
            [
                part.mean_square(Gram.total(parts[:held] + parts[held + 1 :]).solved())
                for held, part in enumerate(parts)
            ]
        )


def _gains(before: FloatArray, after: FloatArray) -> bool:
    """Return whether errors (runs,) fell by more than chance, and by enough to matter."""
    fall = before - after
    error = float(fall.std(ddof=1)) / np.sqrt(len(fall))
    return bool(fall.mean() > max(error, _WORTH * float(before.mean())))
