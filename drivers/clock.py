"""Clocks of the host, real or manual; both give ``host_time_s``."""

from collections.abc import Callable

Clock = Callable[[], float]


class VirtualClock:
    """A clock that is advanced manually, for tests and fast playback."""

    def __init__(self, host_time_s: float = 0.0) -> None:
        self._host_time_s = host_time_s

    def __call__(self) -> float:
        """Return the present ``host_time_s``."""
        return self._host_time_s

    def advance(self, seconds: float) -> None:
        """Move on by ``seconds``, which must not be negative."""
        if not seconds >= 0:
            raise ValueError(f"a clock moves on, not by {seconds} s")
        self._host_time_s += seconds
