"""The commands since the connection, from which a model reconstructs its memory."""

import threading
from collections import deque
from typing import NamedTuple

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray

# This is two and a half minutes of motion at 1 kHz; a rest takes two rows.
MAX_ROWS = 150_000
# Every sample is kept until this long after a motion, while the axes settle.
_SETTLING_TIME_S = 0.1


class _CommandRows(NamedTuple):
    """Consecutive commands (n, axes), and their device times (n,)."""

    time_s: FloatArray
    command: FloatArray


class CommandMemory:
    """Keeps every sampled command while an axis moves, but only the first and last of a rest.

    The worker adds samples; another thread may read. When the memory is full, the oldest batches
    are dropped first.
    """

    def __init__(self, max_rows: int = MAX_ROWS) -> None:
        self._max_rows = max_rows
        self._parts: deque[_CommandRows] = deque()
        # The latest sample of a rest, which is appended only when the rest ends.
        self._latest: _CommandRows | None = None
        self._last_motion_s = float("-inf")
        self._row_count = 0
        self._lock = threading.Lock()
        #: Number of the connection. Device times are comparable only within one connection.
        self.number = 0

    def clear(self) -> None:
        """Forget everything when a new connection begins, since it has its own device time."""
        with self._lock:
            self.number += 1
            self._parts.clear()
            self._latest, self._last_motion_s, self._row_count = None, float("-inf"), 0

    def add(self, samples: DeviceSamples) -> None:
        """Add consecutive samples."""
        if not len(samples):
            return
        time_s, command = samples.device_time_s, samples.command
        with self._lock:
            previous = command[:1] if self._latest is None else self._latest.command
            is_first = self._row_count == 0
            has_changed = (np.diff(command, axis=0, prepend=previous) != 0.0).any(axis=1)
            if has_changed.any():
                self._last_motion_s = float(time_s[has_changed][-1])
            if is_first or time_s[0] - self._last_motion_s <= _SETTLING_TIME_S:
                # A motion begins: first append the end of the rest before it.
                if self._latest is not None:
                    self._append(self._latest)
                self._append(_CommandRows(time_s, command))
            self._latest = _CommandRows(time_s[-1:], command[-1:])

    def read_history(self) -> tuple[FloatArray, FloatArray]:
        """Return times (n,) and commands (n, axes) up to the latest sample, oldest first."""
        with self._lock:
            parts = [*self._parts, *([self._latest] if self._latest is not None else [])]
        if not parts:
            return np.empty(0), np.empty((0, 0))
        times, commands = zip(*parts, strict=True)
        time_s, command = np.concatenate(times), np.concatenate(commands)
        # The latest sample may also be the last row of the parts.
        is_new = np.concatenate([[True], np.diff(time_s) > 0.0])
        return time_s[is_new], command[is_new]

    def _append(self, rows: _CommandRows) -> None:
        self._parts.append(rows)
        self._row_count += len(rows.time_s)
        while self._row_count > self._max_rows and len(self._parts) > 1:
            self._row_count -= len(self._parts.popleft().time_s)
