"""The frame rate of a camera that generates its own pictures."""

from rotemina.drivers.cameras.camera import Wait
from rotemina.drivers.clock import Clock


class Pace:
    """Steady beats by the clock; beats without a waiter are counted."""

    def __init__(self, rate_hz: float, *, clock: Clock, wait: Wait) -> None:
        self._clock = clock
        self._wait = wait
        self._next_s = clock()
        self.period_s = 1.0 / rate_hz

    def beats(self, timeout_s: float) -> int:
        """Wait for the next beat; return how many there were since the last one, 0 for none yet."""
        left_s = self._next_s - self._clock()
        if left_s > 0.0:
            self._wait(min(left_s, timeout_s))
            left_s = self._next_s - self._clock()
        if left_s > 1e-9:
            return 0
        count = 1 + int(-left_s / self.period_s)
        self._next_s += count * self.period_s
        return count

    def change(self, period_s: float) -> None:
        """Beat at another period from the last beat on."""
        self._next_s += period_s - self.period_s
        self.period_s = period_s
