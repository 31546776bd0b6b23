"""Delays of the window, counted in bins so that long runs need no more memory."""

from dataclasses import dataclass

_BIN_WIDTH_S = 0.001
# The last bin also counts all longer delays.
_BIN_COUNT = 4000
# At most this many missed beats are counted for one stall.
_MAX_MISSED_BEATS = 10_000


@dataclass(frozen=True, slots=True)
class LatenessSummary:
    """Delays of the window's thread.

    Attributes
    ----------
    percentile_99_s : float
        The 99th percentile: 99 of 100 requests to the window at random times wait no longer.
    worst_s : float
    duration_s : float
        Time over which the delays were measured.
    """

    percentile_99_s: float
    worst_s: float
    duration_s: float

    def as_json(self) -> dict[str, float]:
        """Return the delays for files, in milliseconds and seconds."""
        return {
            "late_99_percent_ms": round(1e3 * self.percentile_99_s, 1),
            "late_worst_ms": round(1e3 * self.worst_s, 1),
            "watched_s": round(self.duration_s, 1),
        }


class LatenessHistogram:
    """Histogram of the delays of beats that are due every ``period_s``.

    The beats that were missed during a stall are counted too, each with the delay that it would
    have had; otherwise a long stall would count as a single beat among many.
    """

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._bins = [0] * _BIN_COUNT
        self._beat_count = 0
        self._worst_s = 0.0
        self._watched_s = 0.0

    def add(self, interval_s: float) -> None:
        """Count a beat that came ``interval_s`` after the previous one."""
        delay_s = max(interval_s - self._period_s, 0.0)
        self._worst_s = max(self._worst_s, delay_s)
        self._watched_s += interval_s
        for missed_count in range(min(int(delay_s / self._period_s), _MAX_MISSED_BEATS) + 1):
            bin_index = min(
                int((delay_s - missed_count * self._period_s) / _BIN_WIDTH_S), _BIN_COUNT - 1
            )
            self._bins[bin_index] += 1
            self._beat_count += 1

    def find_percentile(self, share: float) -> float:
        """Return the delay, s, that is not exceeded by a share (0 to 1) of all beats."""
        needed, counted = share * self._beat_count, 0
        for bin_index, count in enumerate(self._bins):
            counted += count
            if counted and counted >= needed:
                return min((bin_index + 1) * _BIN_WIDTH_S, self._worst_s)
        return self._worst_s

    def summarise(self) -> LatenessSummary:
        """Return the delays measured so far."""
        return LatenessSummary(self.find_percentile(0.99), self._worst_s, self._watched_s)
