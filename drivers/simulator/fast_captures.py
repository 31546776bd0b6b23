"""Captures of the simulated machine: readings picked from its samples."""

import numpy as np

from rotemina.drivers.capture import Captured
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray

_ON_TIME = 1e-6  # of the interval: what is early by less is on time


class Capturing:
    """One capture: the first sample that is not before each of its instants.

    Parameters
    ----------
    axes : tuple of str
    columns : tuple of int
        Which columns of the samples they are.
    rate_hz : float
        No more than the rate of the samples, so that no sample serves two instants.
    count : int
    begin_s : float
        Device time before which nothing is taken.
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
        self._taken = 0
        self._parts: list[tuple[FloatArray, FloatArray]] = []

    def take(self, samples: Samples) -> None:
        """Pick from consecutive samples what the capture asks for."""
        rows = [row for row, time_s in enumerate(samples.device_time_s) if self._wants(time_s)]
        if rows:
            measured = samples.measured[rows][:, self._columns]
            self._parts.append((samples.device_time_s[rows], measured))

    def _wants(self, time_s: float) -> bool:
        if self._taken >= self._count or time_s <= self._begin_s:
            return False
        if self._first_s is None:
            self._first_s = time_s
        due_s = self._first_s + (self._taken - _ON_TIME) * self._interval_s
        if time_s < due_s:
            return False
        self._taken += 1
        return True

    def handed_out(self) -> Captured | None:
        """Return what was taken since the last time, or None if that is nothing."""
        if not self._parts:
            return None
        times, readings = zip(*self._parts, strict=True)
        self._parts.clear()
        return Captured(
            self._axes,
            np.concatenate(times),
            np.concatenate(readings),
            complete=self._taken >= self._count,
        )
