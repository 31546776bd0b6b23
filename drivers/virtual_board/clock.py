"""The clock of a board: a 32-bit counter of microseconds, driven by an imperfect crystal."""

from math import ceil, floor

TIME_MASK = 0xFFFF_FFFF
_HALF_WRAP_US = 1 << 31
# Maximum rounding error of a computed time.
_ROUNDING_US = 1e-3
_US_PER_S = 1e6


def wrap_difference(difference_us: int) -> int:
    """Wrap the difference of two 32-bit times to the range -2^31 to 2^31 - 1."""
    return (difference_us + _HALF_WRAP_US & TIME_MASK) - _HALF_WRAP_US


class CrystalClock:
    """Clock of a board, driven by a crystal. It converts board times to ticks and back.

    Parameters
    ----------
    tick_s : float
        Interval between ticks. Tick number k occurs at the simulated time k · tick_s.
    offset_us : int
        Board time at ``since_s``.
    since_s : float
        Simulated time at which the clock starts.
    ppm : float
        Relative error of the crystal, ppm. A positive error makes the clock fast.
    """

    def __init__(
        self, tick_s: float, offset_us: int = 0, *, since_s: float = 0.0, ppm: float = 0.0
    ) -> None:
        self._offset_us = offset_us
        self._since_us = since_s * _US_PER_S
        self._tick_us = tick_s * _US_PER_S
        self._rate = 1.0 + 1e-6 * ppm

    def find_time_us(self, tick: int) -> int:
        """Return the board time at a tick."""
        elapsed_us = (tick * self._tick_us - self._since_us) * self._rate
        return self._offset_us + floor(elapsed_us + _ROUNDING_US) & TIME_MASK

    def find_tick(self, time_us: int, now: int) -> int:
        """Return the first tick at or after a board time.

        The time must be within 2^31 µs before or after the tick ``now``.
        """
        until_us = wrap_difference(time_us - self.find_time_us(now))
        # Start one tick earlier, because the quotient may be rounded up.
        tick = now + floor(until_us / (self._tick_us * self._rate)) - 1
        while wrap_difference(self.find_time_us(tick) - time_us) < 0:
            tick += 1
        return tick

    def count_ticks(self, duration_us: float) -> int:
        """Return the number of ticks that cover a duration, at least one."""
        return max(1, ceil(duration_us / (self._tick_us * self._rate) - 1e-6))
