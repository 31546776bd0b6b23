"""Mapping of device time to host time, estimated from the arrival of samples."""

from collections import deque
from statistics import median
from typing import NamedTuple

_PORTIONS = 512  # eight seconds of them: a clock that is 50 ppm off drifts by 0.4 ms meanwhile


class ClockFit(NamedTuple):
    """``host_time_s`` = device time + ``offset_s``.

    ``uncertainty_s`` is how much later than the soonest samples typically come in. A delay that
    all of them share cannot be told from the offset: it is not in there.
    """

    offset_s: float
    uncertainty_s: float


class DeviceClock:
    """Follows the clock of a device through one connection.

    No sample comes in before it was taken, so the least of (host time of arrival) − (device time)
    over the last seconds is the best guess of the offset.
    """

    def __init__(self) -> None:
        self._delays_s: deque[float] = deque(maxlen=_PORTIONS)

    def observe(self, received_s: float, device_time_s: float) -> ClockFit:
        """Take in that the sample of a device time came in at a host time; return the fit."""
        self._delays_s.append(received_s - device_time_s)
        least_s = min(self._delays_s)
        return ClockFit(least_s, median(self._delays_s) - least_s)
