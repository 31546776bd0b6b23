"""The clock of a board: 32 bits of microseconds from an imperfect crystal."""

from math import ceil, floor

MASK = 0xFFFF_FFFF
_HALF = 1 << 31
_ATOM_US = 1e-3  # that a time may be off by rounding
_US = 1e6


def signed(difference_us: int) -> int:
    """Return a difference of two times of 32 bits, between -2^31 and 2^31 - 1."""
    return (difference_us + _HALF & MASK) - _HALF


class BoardClock:
    """Counts from ``offset_us`` at ``since_s``, and converts machine times to ticks.

    Parameters
    ----------
    tick_s : float
        Interval between ticks; tick number k is at k · tick_s.
    offset_us : int
    since_s : float
        Time of the process.
    ppm : float
        How much too fast the crystal is.
    """

    def __init__(
        self, tick_s: float, offset_us: int = 0, *, since_s: float = 0.0, ppm: float = 0.0
    ) -> None:
        self._offset_us = offset_us
        self._since_us = since_s * _US
        self._tick_us = tick_s * _US
        self._rate = 1.0 + 1e-6 * ppm

    def at_tick(self, tick: int) -> int:
        """Return the board's time at a tick."""
        elapsed_us = (tick * self._tick_us - self._since_us) * self._rate
        return self._offset_us + floor(elapsed_us + _ATOM_US) & MASK

    def tick_at(self, time_us: int, now: int) -> int:
        """Return the first tick that is not before a time of the board; ``now`` is a tick.

        The time is taken to be within 2^31 µs of the present, before or after it.
        """
        ahead_us = signed(time_us - self.at_tick(now))
        tick = now + floor(ahead_us / (self._tick_us * self._rate)) - 1  # rounding, at most
        while signed(self.at_tick(tick) - time_us) < 0:
            tick += 1
        return tick

    def ticks(self, duration_us: float) -> int:
        """Return how many ticks a duration takes, at least one."""
        return max(1, ceil(duration_us / (self._tick_us * self._rate) - 1e-6))
