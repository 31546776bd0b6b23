"""Heartbeats of the thread that shows a session, and of the one that steers."""

from rotemina.drivers.clock import Clock

PERIOD_S = 0.25  # between two beats
SILENT_S = 1.0  # without a beat, and nobody counts as alive any more


class Heartbeat:
    """The time of a thread's latest sign of life; every method may be called from any thread.

    Before the first beat, and after :meth:`end`, no beat is expected.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._last_s: float | None = None

    def beat(self) -> None:
        """Record that the thread is alive."""
        self._last_s = self._clock()

    def end(self) -> None:
        """Expect no further beat."""
        self._last_s = None

    @property
    def age_s(self) -> float | None:
        """Age of the latest beat; None while no beat is expected."""
        last_s = self._last_s
        return None if last_s is None else self._clock() - last_s

    @property
    def silent(self) -> bool:
        """Whether a beat is overdue."""
        age_s = self.age_s
        return age_s is not None and age_s > SILENT_S
