"""The recent past of all axes, written by the session's worker and read by screens."""

import threading
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True, eq=False)
class LiveWindow:
    """A stretch of the history, oldest first; contiguous, read-only copies.

    Attributes
    ----------
    axes : tuple of str
        What the columns are.
    device_time_s : (n,)
        Increasing; not to be compared with times of another ``connection``.
    command, model, measured : (n, axes)
        What was commanded, what the nominal model answers to it, what the sensors said; m or rad.
        The model is NaN where it has no finite answer.
    connection : int
        Counts up whenever the history starts anew, after each connection to the device.
    """

    axes: tuple[str, ...]
    device_time_s: FloatArray
    command: FloatArray
    model: FloatArray
    measured: FloatArray
    connection: int

    def __len__(self) -> int:
        return len(self.device_time_s)


class LiveHistory:
    """A ring buffer of samples; ``append`` and ``tail`` may be called from different threads.

    It holds ``seconds`` at ``rate_hz``; a device that samples faster fills it sooner.
    """

    def __init__(self, axes: tuple[str, ...], *, seconds: float = 60.0, rate_hz: float = 1000.0):
        self.axes = axes
        self.capacity = max(1, round(seconds * rate_hz))
        self._time_s = np.empty(self.capacity)
        # Per sample: command, model, measured.
        self._values = np.empty((self.capacity, 3, len(axes)))
        self._written = 0
        self._connection = 0
        self._lock = threading.Lock()

    def clear(self) -> None:
        """Forget everything: a new connection has a time of its own."""
        with self._lock:
            self._written = 0
            self._connection += 1

    def append(self, samples: Samples, model: FloatArray) -> None:
        """Add samples and the model's answers (n, axes) to them."""
        count = min(len(samples), self.capacity)
        if count == 0:
            return
        values = np.stack([samples.command, model, samples.measured], axis=1)
        with self._lock:
            slots = (self._written + np.arange(count)) % self.capacity
            self._time_s[slots] = samples.device_time_s[-count:]
            self._values[slots] = values[-count:]
            self._written += count

    def tail(self, seconds: float | None = None, *, since_s: float | None = None) -> LiveWindow:
        """Return the latest ``seconds``, or what is later than ``since_s``, or everything held.

        ``since_s`` is a device time; with both, the shorter stretch counts.
        """
        with self._lock:
            count = min(self._written, self.capacity)
            first = self._written - count
            if count and (seconds is not None or since_s is not None):
                first += self._skipped(first, count, seconds, since_s)
            time_s = self._ordered(self._time_s, first)
            values = self._ordered(self._values, first)
            connection = self._connection
        command, model, measured = (
            read_only(np.ascontiguousarray(values[:, part])) for part in range(3)
        )
        return LiveWindow(self.axes, read_only(time_s), command, model, measured, connection)

    def _skipped(self, first: int, count: int, seconds: float | None, since_s: float | None) -> int:
        """Return how many of the oldest samples are too old."""
        time_s = self._ordered(self._time_s, first)
        oldest = float("-inf") if since_s is None else since_s
        skipped = int(np.searchsorted(time_s, oldest, side="right"))
        if seconds is not None:
            begin = float(time_s[-1]) - seconds
            skipped = max(skipped, int(np.searchsorted(time_s, begin, side="left")))
        return min(skipped, count)

    def _ordered(self, ring: FloatArray, first: int) -> FloatArray:
        """Copy a ring from sample number ``first`` to the latest, oldest first."""
        begin, end = first % self.capacity, self._written % self.capacity
        if first == self._written:
            return ring[:0].copy()
        if begin < end:
            return ring[begin:end].copy()
        return np.concatenate([ring[begin:], ring[:end]])
