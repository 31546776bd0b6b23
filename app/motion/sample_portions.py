"""Batches of samples: read in every cycle, processed at the display rate."""

from rotemina.drivers.samples import Samples

_PORTION_S = 0.016  # between two times that samples are worked up
_LATEST_S = 0.019


class SamplePortions:
    """Collects a device's samples until they are due for processing."""

    def __init__(self) -> None:
        #: Host time, s, of the latest samples.
        self.received_s = float("-inf")
        self._unread: list[Samples] = []
        self._worked_up_s = float("-inf")
        self._since_s = float("inf")
        self._fresh = False

    def restart(self) -> None:
        """Discard unprocessed samples; the next portion is due at once."""
        self._unread.clear()
        self._worked_up_s = float("-inf")

    def add(self, samples: Samples, now_s: float) -> None:
        """Add what one cycle has read, which may be nothing."""
        self._since_s, self._fresh = now_s - self._worked_up_s, len(samples) > 0
        if self._fresh:
            self._unread.append(samples)
            self.received_s = now_s

    @property
    def idle(self) -> bool:
        """Whether the cycle has read nothing, and no portion is due."""
        return not self._fresh and self._since_s < _PORTION_S

    def due(self, *, news: bool) -> bool:
        """Return whether to process the portion now; ``news`` cannot wait.

        A cycle that has just read samples leaves the work to the next one, which has the time.
        """
        return news or self._since_s >= (_LATEST_S if self._fresh else _PORTION_S)

    def take(self, now_s: float, axes: int) -> Samples:
        """Return the portion, of so many axes, and begin the next one."""
        self._worked_up_s = now_s
        parts, self._unread = self._unread, []
        return Samples.joined(parts, axes)
