"""Estimate of the offset and drift between a board's clock and the host's clock.

The board's clock is a 32-bit counter of microseconds. Messages arrive late, but never early. So the
message with the shortest delay shows the offset between the clocks, and the change of this offset
over time shows their drift.
"""

from collections import deque

# The board's counter wraps to 0 after this time.
_WRAP_US = 1 << 32
_HALF_WRAP_US = _WRAP_US >> 1
# Of all messages within a window, only the one with the shortest delay is kept.
_WINDOW_S = 1.0
_MAX_WINDOWS = 32
_MIN_WINDOWS_FOR_DRIFT = 16
# Quartz crystals drift at least ten times less.
_MAX_DRIFT_RATIO = 5e-4
# A board whose time jumps by more than this has been reset.
_MIN_RESET_JUMP_S = 0.5


class BoardClockEstimator:
    """Estimator of one board's clock, from the times in its messages and their arrival times.

    Unwrapped board times are whole microseconds since an arbitrary origin. Unlike the board's
    counter, they do not wrap to 0.

    Attributes
    ----------
    follows_drift : bool
        Whether to estimate the drift. False for a board that sends only when it is polled, because
        its delay of up to a period would look like a drift.
    """

    def __init__(self) -> None:
        self.follows_drift = True
        self._latest_us: int | None = None
        self._origin_us = 0
        # Start of each window in board time, and offset of its message with the shortest delay, s.
        self._windows: deque[tuple[float, float]] = deque(maxlen=_MAX_WINDOWS)
        self._drift = 0.0
        self._offset_s = 0.0

    @property
    def is_known(self) -> bool:
        """Whether a time of the board has been received."""
        return self._latest_us is not None

    def unwrap(self, time_us: int) -> int:
        """Return the unwrapped time of a board time that is nearest to the latest one."""
        if self._latest_us is None:
            return time_us
        return (
            self._latest_us + (time_us - self._latest_us + _HALF_WRAP_US) % _WRAP_US - _HALF_WRAP_US
        )

    def has_jumped(self, time_us: int, host_time_s: float) -> bool:
        """Return whether an unwrapped time that has just arrived contradicts the estimate.

        It contradicts if it lies in the future, or well before an earlier time. A delayed message
        does not count as a jump.
        """
        if self._latest_us is None:
            return False
        backward_s = 1e-6 * (self._latest_us - time_us)
        return (
            backward_s > _MIN_RESET_JUMP_S
            or self.to_host_time_s(time_us) - host_time_s > _MIN_RESET_JUMP_S
        )

    def observe(self, time_us: int, host_time_s: float) -> None:
        """Update the estimate with an unwrapped time and the host time at which it was sent."""
        if self._latest_us is None:
            self._latest_us = self._origin_us = time_us
        self._latest_us = max(self._latest_us, time_us)
        board_s = 1e-6 * (time_us - self._origin_us)
        offset_s = host_time_s - board_s
        if not self._windows or board_s - self._windows[-1][0] >= _WINDOW_S:
            self._windows.append((board_s, offset_s))
            self._fit_drift()
        elif offset_s - self._drift * board_s < self._windows[-1][1] - self._drift * board_s:
            # The start of the window stays, because otherwise the window would never end.
            self._windows[-1] = (self._windows[-1][0], offset_s)
            self._fit_drift()

    def to_host_time_s(self, time_us: int) -> float:
        """Return the host time of an unwrapped board time, s."""
        board_s = 1e-6 * (time_us - self._origin_us)
        return board_s * (1.0 + self._drift) + self._offset_s

    def to_board_time_us(self, host_time_s: float) -> int:
        """Return the unwrapped board time at a host time."""
        board_s = (host_time_s - self._offset_s) / (1.0 + self._drift)
        return self._origin_us + round(1e6 * board_s)

    def _fit_drift(self) -> None:
        """Fit the drift, then set the greatest offset with which no message arrived early."""
        if self.follows_drift and len(self._windows) >= _MIN_WINDOWS_FOR_DRIFT:
            count = len(self._windows)
            mean_board_s = sum(board_s for board_s, _ in self._windows) / count
            mean_offset_s = sum(offset_s for _, offset_s in self._windows) / count
            square_sum = sum((board_s - mean_board_s) ** 2 for board_s, _ in self._windows)
            slope = (
                sum(
                    (board_s - mean_board_s) * (offset_s - mean_offset_s)
                    for board_s, offset_s in self._windows
                )
                / square_sum
            )
            self._drift = min(max(slope, -_MAX_DRIFT_RATIO), _MAX_DRIFT_RATIO)
        self._offset_s = min(
            offset_s - self._drift * board_s for board_s, offset_s in self._windows
        )
