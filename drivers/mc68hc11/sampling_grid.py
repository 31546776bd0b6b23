"""The sampling instants of one board, counted so that all boards' are the same."""

_TICK_US = 1000  # a board samples at its own ticks, which are no longer


class Grid:
    """Instants of a board's clock, a whole period apart, and their numbers.

    Parameters
    ----------
    period_us : int
        Between two numbers.
    begin_us : int
        The board's unwrapped time of instant ``number``.
    """

    def __init__(self, period_us: int, begin_us: int, number: int = 0) -> None:
        self.period_us = period_us
        self._begin_us, self._number = begin_us, number
        self._before: tuple[int, int] | None = None

    def move(self, begin_us: int, number: int) -> None:
        """Let the numbers from ``number`` on begin at another time; those before stay."""
        self._before = (self._begin_us, self._number)
        self._begin_us, self._number = begin_us, number

    def time_us(self, number: int) -> int:
        """Return the unwrapped time of an instant."""
        begin_us, first = self._begin_us, self._number
        if number < first and self._before is not None:
            begin_us, first = self._before
        return begin_us + (number - first) * self.period_us

    def number(self, time_us: int) -> int | None:
        """Return the number of a sample taken at a time, None if it belongs to no instant."""
        begin_us, first = self._begin_us, self._number
        if time_us < begin_us - self.period_us // 2:
            if self._before is None:
                return None
            begin_us, first = self._before
        number = round((time_us - begin_us) / self.period_us)
        if abs(begin_us + number * self.period_us - time_us) > min(self.period_us // 4, _TICK_US):
            return None
        number += first
        if self._before is not None and (time_us < self._begin_us) != (number < self._number):
            return None  # of the numbers before, but beyond their end
        return number

    def latest(self, time_us: int) -> int:
        """Return the number of the latest instant at a time."""
        number = self._number + (time_us - self._begin_us) // self.period_us
        if number < self._number and self._before is not None:
            begin_us, first = self._before
            return min(first + (time_us - begin_us) // self.period_us, self._number - 1)
        return number
