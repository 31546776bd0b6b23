"""Captures of the simulated machine, taken from its samples."""

import numpy as np

from rotemina.drivers.abilities import CapturedSamples
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray

# Because of rounding, a sample may be early by this fraction of the interval.
_INTERVAL_TOLERANCE = 1e-6


class SimulatedCapture:
    """A capture. For each of its instants it takes the first sample at or after the instant.

    Parameters
    ----------
    axes : tuple of str
    columns : tuple of int
        Columns of the axes in the samples.
    rate_hz : float
        Rate of the instants; at most the sample rate, so that no sample is taken twice.
    count : int
        Number of samples to take.
    begin_s : float
        Only samples after this device time are taken.
    """

    def __init__(
        self,
        axes: tuple[str, ...],
        columns: tuple[int, ...],
        rate_hz: float,
        count: int,
        begin_s: float,
    ) -> None:
        self._axes, self._columns = axes, list(columns)
        self._interval_s = 1.0 / rate_hz
        self._count = count
        self._begin_s = begin_s
        self._first_s: float | None = None
        self._taken_count = 0
        self._parts: list[tuple[FloatArray, FloatArray]] = []

    def take_samples(self, samples: DeviceSamples) -> None:
        """Take the due samples from consecutive samples of the machine."""
        rows = [
            row for row, time_s in enumerate(samples.device_time_s) if self._take_if_due(time_s)
        ]
        if rows:
            measured = samples.measured[rows][:, self._columns]
            self._parts.append((samples.device_time_s[rows], measured))

    def _take_if_due(self, time_s: float) -> bool:
        if self._taken_count >= self._count or time_s <= self._begin_s:
            return False
        if self._first_s is None:
            self._first_s = time_s
        due_s = self._first_s + (self._taken_count - _INTERVAL_TOLERANCE) * self._interval_s
        if time_s < due_s:
            return False
        self._taken_count += 1
        return True

    def read_captured(self) -> CapturedSamples | None:
        """Return the samples taken since the previous call, or None."""
        if not self._parts:
            return None
        times, readings = zip(*self._parts, strict=True)
        self._parts.clear()
        return CapturedSamples(
            self._axes,
            np.concatenate(times),
            np.concatenate(readings),
            complete=self._taken_count >= self._count,
        )
