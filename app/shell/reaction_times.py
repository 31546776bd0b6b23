"""How late the window reacts: what was measured, in bins, so that hours take no more room."""

from dataclasses import dataclass

_BIN_S = 0.001
_BINS = 4000  # what is later is in the last one
_MOST_MISSED = 10_000  # beats of one stall that count, however long it was


@dataclass(frozen=True, slots=True)
class Lateness:
    """How late the window's thread was.

    Attributes
    ----------
    usual_s : float
        The 99th percentile: what asks something of the window at any moment waits no longer, in
        99 of 100 cases.
    worst_s : float
    watched_s : float
        For how long it was measured.
    """

    usual_s: float
    worst_s: float
    watched_s: float

    def as_json(self) -> dict[str, float]:
        """Return it for files, in milliseconds and seconds."""
        return {
            "late_99_percent_ms": round(1e3 * self.usual_s, 1),
            "late_worst_ms": round(1e3 * self.worst_s, 1),
            "watched_s": round(self.watched_s, 1),
        }


class Latenesses:
    """Gathers beats that ought to come every ``period_s``, and how late each was.

    While the thread stood still, further beats would have been due: each of them counts as late as
    it would have been, else a long stall would be but one beat of many.
    """

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._bins = [0] * _BINS
        self._beats = 0
        self._worst_s = 0.0
        self._watched_s = 0.0

    def add(self, since_s: float) -> None:
        """Note a beat that came so long after the last one."""
        late_s = max(since_s - self._period_s, 0.0)
        self._worst_s = max(self._worst_s, late_s)
        self._watched_s += since_s
        for missed in range(min(int(late_s / self._period_s), _MOST_MISSED) + 1):
            number = min(int((late_s - missed * self._period_s) / _BIN_S), _BINS - 1)
            self._bins[number] += 1
            self._beats += 1

    def percentile(self, share: float) -> float:
        """Return the lateness, s, that a share of all beats (0 to 1) does not exceed."""
        wanted, seen = share * self._beats, 0
        for number, count in enumerate(self._bins):
            seen += count
            if seen and seen >= wanted:
                return min((number + 1) * _BIN_S, self._worst_s)
        return self._worst_s

    def summary(self) -> Lateness:
        """Return what was measured so far."""
        return Lateness(self.percentile(0.99), self._worst_s, self._watched_s)
