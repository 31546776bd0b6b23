"""95 % intervals: Wilson's of a share, bootstrap of anything else."""

from collections.abc import Callable
from math import sqrt
from typing import Any, NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray

_Z = 1.959964
_DRAWS = 1000


class Figure(NamedTuple):
    """A measured figure with its 95 % interval, and from how many cases it comes."""

    value: float | None
    low: float | None
    high: float | None
    number: int

    def as_json(self) -> dict[str, Any]:
        """Return it as JSON; null where there was no case."""
        return {"value": self.value, "interval": [self.low, self.high], "n": self.number}


NOTHING = Figure(None, None, None, 0)


def share(hits: list[bool]) -> Figure:
    """Return the share of hits with Wilson's interval (Wilson 1927)."""
    n = len(hits)
    if n == 0:
        return NOTHING
    p = sum(hits) / n
    middle = (p + _Z**2 / (2 * n)) / (1 + _Z**2 / n)
    half = _Z / (1 + _Z**2 / n) * sqrt(p * (1 - p) / n + _Z**2 / (4 * n**2))
    low, high = max(middle - half, 0.0), min(middle + half, 1.0)
    return Figure(p, round(low, 12), round(high, 12), n)


def resampled(values: FloatArray, statistic: Callable[[FloatArray], float]) -> Figure:
    """Return a statistic of ``values`` (n, …) with its percentile bootstrap over rows."""
    values = np.asarray(values, dtype=np.float64)
    if len(values) == 0:
        return NOTHING
    rng = np.random.default_rng(len(values))
    draws = [statistic(values[rng.integers(0, len(values), len(values))]) for _ in range(_DRAWS)]
    low, high = np.percentile(draws, [2.5, 97.5])
    return Figure(float(statistic(values)), float(low), float(high), len(values))
