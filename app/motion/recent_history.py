"""The recent past of all axes, written by the session's worker, read by displays."""

import threading
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray, read_only


@dataclass(frozen=True, slots=True, eq=False)
class LiveWindow:
    """A section of the history, oldest first; contiguous, read-only copies.

    Attributes
    ----------
    axes : tuple of str
        What the columns are.
    device_time_s : (n,)
        Increasing; not to be compared with times of another connection to the device.
    command, model, measured : (n, axes)
        What was commanded, what the model in use answers to it, what the sensors said; m or rad.
        The model is NaN where it has no finite answer.
    nominal, doubt : (n, axes)
        What the nominal model answers, and by how much the model in use may be off, as the
        machine's past is unknown.
    gap_since_s : float
        Device time from which on the model was in use: the gap begins there.
    """

    axes: tuple[str, ...]
    device_time_s: FloatArray
    command: FloatArray
    model: FloatArray
    measured: FloatArray
    nominal: FloatArray
    doubt: FloatArray
    gap_since_s: float = float("-inf")

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
        # Command, model, measured, nominal, doubt: each whole, as it is copied at every frame.
        self._values = np.empty((5, self.capacity, len(axes)))
        self._gap_since_s = float("-inf")
        self._written = 0
        self._lock = threading.Lock()

    def clear(self) -> None:
        """Forget everything: a new connection has its own device time."""
        with self._lock:
            self._written = 0
            self._gap_since_s = float("-inf")

    def restart_gap(self) -> None:
        """Let the gap begin behind the latest sample: another model is in use from there on."""
        with self._lock:
            if self._written:
                self._gap_since_s = float(self._time_s[(self._written - 1) % self.capacity])

    def append(
        self,
        samples: Samples,
        model: FloatArray,
        nominal: FloatArray | None = None,
        doubt: FloatArray | None = None,
    ) -> None:
        """Add samples and the answers (n, axes) to them of the model in use and the nominal one.

        Without ``nominal`` that is the one in use; ``doubt`` is 0 where it is left out.
        """
        count = min(len(samples), self.capacity)
        if count == 0:
            return
        nominal = model if nominal is None else nominal
        doubt = np.zeros(model.shape) if doubt is None else doubt
        values = (samples.command, model, samples.measured, nominal, doubt)
        with self._lock:
            slots = (self._written + np.arange(count)) % self.capacity
            self._time_s[slots] = samples.device_time_s[-count:]
            for ring, part in zip(self._values, values, strict=True):
                ring[slots] = part[-count:]
            self._written += count

    def tail(self, seconds: float | None = None) -> LiveWindow:
        """Return the latest ``seconds``, or all."""
        with self._lock:
            count = min(self._written, self.capacity)
            first = self._written - count
            if count and seconds is not None:
                times = self._ordered(self._time_s, first)
                first += int(times.searchsorted(times[-1] - seconds))
            time_s = self._ordered(self._time_s, first)
            values = [self._ordered(ring, first) for ring in self._values]
            gap_since_s = self._gap_since_s
        command, model, measured, nominal, doubt = map(read_only, values)
        parts = (command, model, measured, nominal, doubt, gap_since_s)
        return LiveWindow(self.axes, read_only(time_s), *parts)

    def _ordered(self, ring: FloatArray, first: int) -> FloatArray:
        """Copy a ring from sample number ``first`` to the latest, oldest first."""
        begin, end = first % self.capacity, self._written % self.capacity
        if first == self._written:
            return ring[:0].copy()
        if begin < end:
            return ring[begin:end].copy()
        return np.concatenate([ring[begin:], ring[:end]])
