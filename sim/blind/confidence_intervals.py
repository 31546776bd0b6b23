"""95 % intervals: Wilson's interval of a share, and the bootstrap of any other statistic."""

from collections.abc import Callable
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray

# Quantile of the normal distribution for a two-sided 95 % interval.
_NORMAL_QUANTILE = 1.959964
_BOOTSTRAP_COUNT = 1000


class IntervalEstimate(NamedTuple):
    """A measured figure with its 95 % interval and the number of cases."""

    value: float | None
    low: float | None
    high: float | None
    case_count: int

    def as_json(self) -> dict[str, Any]:
        """Return the figure as JSON, with null where there was no case."""
        return {"value": self.value, "interval": [self.low, self.high], "n": self.case_count}


NO_ESTIMATE = IntervalEstimate(None, None, None, 0)


def estimate_share(hits: list[bool]) -> IntervalEstimate:
    """Return the share of hits with Wilson's interval (Wilson 1927)."""
    n = len(hits)
    if n == 0:
        return NO_ESTIMATE
    p = sum(hits) / n
    middle = (p + _NORMAL_QUANTILE**2 / (2 * n)) / (1 + _NORMAL_QUANTILE**2 / n)
    half = (
        _NORMAL_QUANTILE
        / (1 + _NORMAL_QUANTILE**2 / n)
        * sqrt(p * (1 - p) / n + _NORMAL_QUANTILE**2 / (4 * n**2))
    )
    low, high = max(middle - half, 0.0), min(middle + half, 1.0)
    return IntervalEstimate(p, round(low, 12), round(high, 12), n)


def estimate_by_bootstrap(
    values: FloatArray, statistic: Callable[[FloatArray], float]
) -> IntervalEstimate:
    """Return a statistic of ``values`` (n, …) with its percentile bootstrap over rows."""
    values = np.asarray(values, dtype=np.float64)
    if len(values) == 0:
        return NO_ESTIMATE
    rng = np.random.default_rng(len(values))
    draws = [
        statistic(values[rng.integers(0, len(values), len(values))])
        for _ in range(_BOOTSTRAP_COUNT)
    ]
    low, high = np.percentile(draws, [2.5, 97.5])
    return IntervalEstimate(float(statistic(values)), float(low), float(high), len(values))
