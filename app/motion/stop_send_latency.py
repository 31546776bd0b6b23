"""Latency of stops until they are sent, measured continuously."""

import threading
from collections import deque
from dataclasses import dataclass

import numpy as np

_KEPT = 4096


@dataclass(frozen=True, slots=True)
class Latency:
    """Times from the call of a stop to its last byte on the line, s.

    ``latest`` and the ``worst`` of all; ``most`` is the 99.9th percentile of the latest ones.
    """

    latest: float
    most: float
    worst: float


class StopLatency:
    """Gathers latencies; any thread."""

    def __init__(self) -> None:
        self._recent: deque[float] = deque(maxlen=_KEPT)
        self._worst = 0.0
        self._lock = threading.Lock()

    def add(self, seconds: float) -> None:
        """Note one."""
        with self._lock:
            self._recent.append(seconds)
            self._worst = max(self._worst, seconds)

    def figures(self) -> Latency | None:
        """Return the statistics, or None before the first stop."""
        with self._lock:
            recent, worst = list(self._recent), self._worst
        if not recent:
            return None
        return Latency(recent[-1], float(np.percentile(recent, 99.9)), worst)
