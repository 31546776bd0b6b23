"""Notices that this program did not run for a while: the computer slept, or the desktop froze."""

import time

from rotemina.drivers.clock import Clock

#: After so long without a cycle nothing that was under way may go on, s.
MAX_PAUSE_S = 1.0


def read_boot_clock() -> float:
    """Return the seconds since the computer was started, those that it slept included."""
    # time.monotonic stands still on Linux and macOS while the computer sleeps.
    clock = getattr(time, "CLOCK_BOOTTIME", getattr(time, "CLOCK_MONOTONIC", None))
    return time.monotonic() if clock is None else time.clock_gettime(clock)


class PauseWatch:
    """Measures the time between two cycles of a loop.

    Parameters
    ----------
    clock : callable
        The loop's host time, s; the system's own is replaced by one that counts sleep too.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = read_boot_clock if clock is time.monotonic else clock
        self.restart()

    def restart(self) -> None:
        """Let the time since the latest cycle not count: something long was done on purpose."""
        self._last_s = self._clock()

    def measure_pause(self) -> float:
        """Return how long the latest cycle ago was, s, and begin anew."""
        last_s, self._last_s = self._last_s, self._clock()
        return self._last_s - last_s
