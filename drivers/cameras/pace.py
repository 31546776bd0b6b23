"""Frame timing for a camera that generates pictures in software."""

from typing import TYPE_CHECKING

from rotemina.drivers.cameras.camera import Wait
from rotemina.drivers.contract import Clock
from rotemina.sim.compatibility import FormerMember, serve_former_names


class FramePacer:
    """Paces frames at a constant rate, and counts the frames that were missed."""

    def __init__(self, rate_hz: float, *, clock: Clock, wait: Wait) -> None:
        self._clock = clock
        self._wait = wait
        self._next_frame_s = clock()
        self.period_s = 1.0 / rate_hz

    def wait_for_frame(self, timeout_s: float) -> int:
        """Wait until a frame is due; return the number of frames since the last one, or 0.

        The result is 0 if no frame is due before the time-out.
        """
        remaining_s = self._next_frame_s - self._clock()
        if remaining_s > 0.0:
            self._wait(min(remaining_s, timeout_s))
            remaining_s = self._next_frame_s - self._clock()
        if remaining_s > 1e-9:
            return 0
        due_count = 1 + int(-remaining_s / self.period_s)
        self._next_frame_s += due_count * self.period_s
        return due_count

    def set_period(self, period_s: float) -> None:
        """Change the frame period, s; the new period counts from the last frame."""
        self._next_frame_s += period_s - self.period_s
        self.period_s = period_s

    # Former names, which work for one more release.
    beats = FormerMember("wait_for_frame")
    change = FormerMember("set_period")


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Pace="FramePacer",
    )
