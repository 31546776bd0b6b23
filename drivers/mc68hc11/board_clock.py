"""A board's clock as the host knows it: 32 bits of microseconds, and how they map to host time.

What a board says arrives late, never early. So the least delayed of many answers tells the offset
of both clocks, and how that changes from one stretch of time to the next tells their drift.
"""

from collections import deque

_TURN = 1 << 32  # µs, then the board counts from 0 again
_HALF = _TURN >> 1
_WINDOW_S = 1.0  # of whose answers the least delayed is kept
_WINDOWS = 32
_ENOUGH = 16  # windows before a drift is believed
_MOST_DRIFT = 5e-4  # a quartz is ten times better
_JUMP_S = 0.5  # a board that is off by more than this was reset


class BoardClock:
    """Follows one board's clock from the times that it tells and when they were heard.

    Board times are whole microseconds since an arbitrary beginning, unwrapped: they do not turn.

    Attributes
    ----------
    drifts : bool
        Whether to follow the drift. Where a board speaks only when it is polled, answers are late
        by up to a period, which would look like one.
    """

    def __init__(self) -> None:
        self.drifts = True
        self._latest_us: int | None = None
        self._origin_us = 0
        self._windows: deque[tuple[float, float]] = deque(maxlen=_WINDOWS)  # board s, offset s
        self._drift = 0.0
        self._offset_s = 0.0

    @property
    def known(self) -> bool:
        """Whether any time of the board was heard yet."""
        return self._latest_us is not None

    def unwrapped(self, time_us: int) -> int:
        """Return a time that the board told, the one nearest to its latest."""
        if self._latest_us is None:
            return time_us
        return self._latest_us + (time_us - self._latest_us + _HALF) % _TURN - _HALF

    def jumped(self, time_us: int, host_time_s: float) -> bool:
        """Whether an unwrapped time heard just now cannot be of the clock followed so far.

        It lies in the future, or well before one that was heard already; late alone is no jump.
        """
        if self._latest_us is None:
            return False
        back_s = 1e-6 * (self._latest_us - time_us)
        return back_s > _JUMP_S or self.host_time_s(time_us) - host_time_s > _JUMP_S

    def observe(self, time_us: int, host_time_s: float) -> None:
        """Note an unwrapped time and when, at the earliest, the board said it."""
        if self._latest_us is None:
            self._latest_us = self._origin_us = time_us
        self._latest_us = max(self._latest_us, time_us)
        board_s = 1e-6 * (time_us - self._origin_us)
        late_s = host_time_s - board_s
        if not self._windows or board_s - self._windows[-1][0] >= _WINDOW_S:
            self._windows.append((board_s, late_s))
            self._fit()
        elif late_s - self._drift * board_s < self._windows[-1][1] - self._drift * board_s:
            # The window keeps its beginning, or it would never end.
            self._windows[-1] = (self._windows[-1][0], late_s)
            self._fit()

    def host_time_s(self, time_us: int) -> float:
        """Return the host's time of an unwrapped time of the board, s."""
        board_s = 1e-6 * (time_us - self._origin_us)
        return board_s * (1.0 + self._drift) + self._offset_s

    def time_us(self, host_time_s: float) -> int:
        """Return the unwrapped time of the board at a time of the host."""
        board_s = (host_time_s - self._offset_s) / (1.0 + self._drift)
        return self._origin_us + round(1e6 * board_s)

    def _fit(self) -> None:
        """Lay the line of the drift below all windows."""
        if self.drifts and len(self._windows) >= _ENOUGH:
            count = len(self._windows)
            middle = sum(board_s for board_s, _ in self._windows) / count
            lateness = sum(late_s for _, late_s in self._windows) / count
            spread = sum((board_s - middle) ** 2 for board_s, _ in self._windows)
            slope = (
                sum((board_s - middle) * (late_s - lateness) for board_s, late_s in self._windows)
                / spread
            )
            self._drift = min(max(slope, -_MOST_DRIFT), _MOST_DRIFT)
        self._offset_s = min(late_s - self._drift * board_s for board_s, late_s in self._windows)
