"""The commands since the connection, from which a model derives its memory."""

import threading
from collections import deque

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray

MOST_ROWS = 150_000  # two and a half minutes of motion at 1 kHz; rests take two rows each
_AFTER_S = 0.1  # of a motion that is kept as it was sampled


class CommandMemory:
    """Keeps commands as sampled while anything moves, and of a rest its two ends.

    The worker adds; another thread may read. The oldest portions go first.
    """

    def __init__(self, most_rows: int = MOST_ROWS) -> None:
        self._most_rows = most_rows
        self._parts: deque[tuple[FloatArray, FloatArray]] = deque()
        self._latest: tuple[FloatArray, FloatArray] | None = None  # of a rest, not kept yet
        self._moved_s = float("-inf")
        self._rows = 0
        self._lock = threading.Lock()
        #: Counts up whenever the memory starts anew: device times are of one of them.
        self.number = 0

    def clear(self) -> None:
        """Forget everything: a new connection has its own device time."""
        with self._lock:
            self.number += 1
            self._parts.clear()
            self._latest, self._moved_s, self._rows = None, float("-inf"), 0

    def add(self, samples: Samples) -> None:
        """Take consecutive samples."""
        if not len(samples):
            return
        time_s, command = samples.device_time_s, samples.command
        with self._lock:
            before = self._latest if self._latest is not None else (time_s[:1], command[:1])
            first = self._rows == 0
            stirred = (np.diff(command, axis=0, prepend=before[1]) != 0.0).any(axis=1)
            if stirred.any():
                self._moved_s = float(time_s[stirred][-1])
            if first or time_s[0] - self._moved_s <= _AFTER_S:
                if self._latest is not None:
                    self._keep(*self._latest)
                self._keep(time_s, command)
            self._latest = (time_s[-1:], command[-1:])

    def history(self) -> tuple[FloatArray, FloatArray]:
        """Return times (n,) and commands (n, axes) up to the latest sample, oldest first."""
        with self._lock:
            parts = [*self._parts, *([self._latest] if self._latest is not None else [])]
        if not parts:
            return np.empty(0), np.empty((0, 0))
        times, commands = zip(*parts, strict=True)
        time_s, command = np.concatenate(times), np.concatenate(commands)
        later = np.concatenate([[True], np.diff(time_s) > 0.0])
        return time_s[later], command[later]

    def _keep(self, time_s: FloatArray, command: FloatArray) -> None:
        self._parts.append((time_s, command))
        self._rows += len(time_s)
        while self._rows > self._most_rows and len(self._parts) > 1:
            self._rows -= len(self._parts.popleft()[0])
