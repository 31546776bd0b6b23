"""Signs of life: heartbeats of threads, and pauses in which the whole program did not run."""

import time

from rotemina.drivers.contract import Clock

# Period of the beats.
BEAT_PERIOD_S = 0.25
# A thread counts as hung after a longer time without a beat.
MAX_SILENCE_S = 1.0
#: After a longer pause than this, running motions must not continue.
MAX_PAUSE_S = 1.0


class Heartbeat:
    """Monitors the sign of life of one thread; every method may be called from any thread.

    No beat is expected before the first one, or after :meth:`end`.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._last_beat_s: float | None = None

    def beat(self) -> None:
        """Record that the thread is alive."""
        self._last_beat_s = self._clock()

    def end(self) -> None:
        """Expect no further beat."""
        self._last_beat_s = None

    @property
    def age_s(self) -> float | None:
        """Time since the latest beat, s; None while no beat is expected."""
        last_beat_s = self._last_beat_s
        return None if last_beat_s is None else self._clock() - last_beat_s

    @property
    def is_silent(self) -> bool:
        """Whether a beat is overdue."""
        age_s = self.age_s
        return age_s is not None and age_s > MAX_SILENCE_S


def read_boot_clock() -> float:
    """Return the seconds since the computer was started, including those it slept."""
    # time.monotonic stands still on Linux and macOS while the computer sleeps.
    clock = getattr(time, "CLOCK_BOOTTIME", getattr(time, "CLOCK_MONOTONIC", None))
    return time.monotonic() if clock is None else time.clock_gettime(clock)


class PauseWatch:
    """Measures the time between two cycles of a loop.

    Parameters
    ----------
    clock : callable
        Clock of the loop, s. ``time.monotonic`` is replaced by a clock that includes sleep.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = read_boot_clock if clock is time.monotonic else clock
        self.restart()

    def restart(self) -> None:
        """Ignore the time since the latest cycle, for example after a call that may be slow."""
        self._last_cycle_s = self._clock()

    def measure_pause(self) -> float:
        """Return the time since the latest cycle, s, and begin a new measurement."""
        last_cycle_s, self._last_cycle_s = self._last_cycle_s, self._clock()
        return self._last_cycle_s - last_cycle_s
