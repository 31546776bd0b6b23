"""Latency of stops, from the request until the stop is sent, measured continuously."""

import threading
from collections import deque
from dataclasses import dataclass

import numpy as np

# The percentile covers at most this many of the latest values.
_MAX_LATENCY_COUNT = 4096


@dataclass(frozen=True, slots=True)
class LatencyStatistics:
    """Statistics of the time from the call of a stop until its last byte is on the line, s.

    Attributes
    ----------
    latest : float
    most : float
        99.9th percentile of the recent values.
    worst : float
        Largest value since the start.
    """

    latest: float
    p99_9_s: float
    worst: float


class StopLatency:
    """Collects latencies of stops, from any thread."""

    def __init__(self) -> None:
        self._recent: deque[float] = deque(maxlen=_MAX_LATENCY_COUNT)
        self._worst = 0.0
        self._lock = threading.Lock()

    def add(self, seconds: float) -> None:
        """Add a latency, s."""
        with self._lock:
            self._recent.append(seconds)
            self._worst = max(self._worst, seconds)

    def compute_statistics(self) -> LatencyStatistics | None:
        """Return the statistics, or None before the first stop."""
        with self._lock:
            recent, worst = list(self._recent), self._worst
        if not recent:
            return None
        return LatencyStatistics(recent[-1], float(np.percentile(recent, 99.9)), worst)
