"""Recent samples of all axes, written by the session's worker and read by displays."""

import threading
from dataclasses import dataclass

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray, make_read_only


@dataclass(frozen=True, slots=True, eq=False)
class HistoryWindow:
    """A section of the history, oldest sample first, in contiguous read-only copies.

    Attributes
    ----------
    axes : tuple of str
        Names of the columns.
    device_time_s : (n,)
        Increasing times. They are not comparable with those of another connection.
    command, model, measured : (n, axes)
        Commands, outputs of the model in use for these commands, and readings; m or rad. Outputs
        that are not finite are NaN.
    nominal, doubt : (n, axes)
        Outputs of the nominal model, and the possible error of the model in use due to the unknown
        past of the machine.
    gap_since_s : float
        Device time since which the model has been in use. The gap is computed from then on.
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

    The buffer holds ``seconds`` at ``rate_hz``. If a device samples faster, it holds less time.
    """

    def __init__(self, axes: tuple[str, ...], *, seconds: float = 60.0, rate_hz: float = 1000.0):
        self.axes = axes
        self.capacity = max(1, round(seconds * rate_hz))
        self._time_s = np.empty(self.capacity)
        # The rings of command, model, measured, nominal and doubt. Each is contiguous, because
        # displays copy it at every frame.
        self._rings = np.empty((5, self.capacity, len(axes)))
        self._gap_since_s = float("-inf")
        self._written_count = 0
        self._lock = threading.Lock()

    def clear(self) -> None:
        """Forget everything when a new connection begins, since it has its own device time."""
        with self._lock:
            self._written_count = 0
            self._gap_since_s = float("-inf")

    def restart_gap(self) -> None:
        """Compute the gap from the next sample on, because another model is in use."""
        with self._lock:
            if self._written_count:
                self._gap_since_s = float(self._time_s[(self._written_count - 1) % self.capacity])

    def append(
        self,
        samples: DeviceSamples,
        model: FloatArray,
        nominal: FloatArray | None = None,
        doubt: FloatArray | None = None,
    ) -> None:
        """Add samples, with the outputs (n, axes) of the model in use and of the nominal model.

        Without ``nominal`` the model in use is the nominal one. ``doubt`` is 0 by default.
        """
        count = min(len(samples), self.capacity)
        if count == 0:
            return
        nominal = model if nominal is None else nominal
        doubt = np.zeros(model.shape) if doubt is None else doubt
        values = (samples.command, model, samples.measured, nominal, doubt)
        with self._lock:
            slots = (self._written_count + np.arange(count)) % self.capacity
            self._time_s[slots] = samples.device_time_s[-count:]
            for ring, new_values in zip(self._rings, values, strict=True):
                ring[slots] = new_values[-count:]
            self._written_count += count

    def tail(self, seconds: float | None = None) -> HistoryWindow:
        """Return the latest ``seconds`` of the history, or the whole history."""
        with self._lock:
            count = min(self._written_count, self.capacity)
            first = self._written_count - count
            if count and seconds is not None:
                times = self._copy_in_order(self._time_s, first)
                first += int(times.searchsorted(times[-1] - seconds))
            time_s = self._copy_in_order(self._time_s, first)
            values = [self._copy_in_order(ring, first) for ring in self._rings]
            gap_since_s = self._gap_since_s
        command, model, measured, nominal, doubt = map(make_read_only, values)
        columns = (command, model, measured, nominal, doubt, gap_since_s)
        return HistoryWindow(self.axes, make_read_only(time_s), *columns)

    def _copy_in_order(self, ring: FloatArray, first: int) -> FloatArray:
        start, end = first % self.capacity, self._written_count % self.capacity
        if first == self._written_count:
            return ring[:0].copy()
        if start < end:
            return ring[start:end].copy()
        return np.concatenate([ring[start:], ring[:end]])
