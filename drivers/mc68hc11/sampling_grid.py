"""Sampling instants of one board. Instants with the same number are simultaneous on all boards."""

# A board takes its samples at its control ticks, whose period is at most this.
_MAX_TICK_US = 1000


class SamplingGrid:
    """Numbered instants, equally spaced on a board's clock.

    Parameters
    ----------
    period_us : int
        Time between two instants.
    begin_us : int
        Unwrapped board time of the instant with the number ``number``.
    number : int
    """

    def __init__(self, period_us: int, begin_us: int, number: int = 0) -> None:
        self.period_us = period_us
        self._begin_us, self._number = begin_us, number
        self._previous: tuple[int, int] | None = None

    def shift(self, begin_us: int, number: int) -> None:
        """Move the instant ``number`` to another time, together with all later instants."""
        self._previous = (self._begin_us, self._number)
        self._begin_us, self._number = begin_us, number

    def find_time_us(self, number: int) -> int:
        """Return the unwrapped time of an instant."""
        begin_us, first_number = self._begin_us, self._number
        if number < first_number and self._previous is not None:
            begin_us, first_number = self._previous
        return begin_us + (number - first_number) * self.period_us

    def find_number(self, time_us: int) -> int | None:
        """Return the number of the instant at a sample's time, or None if there is none."""
        begin_us, first_number = self._begin_us, self._number
        if time_us < begin_us - self.period_us // 2:
            if self._previous is None:
                return None
            begin_us, first_number = self._previous
        number = round((time_us - begin_us) / self.period_us)
        if abs(begin_us + number * self.period_us - time_us) > min(
            self.period_us // 4, _MAX_TICK_US
        ):
            return None
        number += first_number
        if self._previous is not None and (time_us < self._begin_us) != (number < self._number):
            # The instant at this time has been moved away.
            return None
        return number

    def find_latest_number(self, time_us: int) -> int:
        """Return the number of the latest instant up to a time."""
        number = self._number + (time_us - self._begin_us) // self.period_us
        if number < self._number and self._previous is not None:
            begin_us, first_number = self._previous
            return min(first_number + (time_us - begin_us) // self.period_us, self._number - 1)
        return number
