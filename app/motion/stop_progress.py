"""The progress of requested stops."""

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import replace

from rotemina.app.motion.state import SessionState
from rotemina.app.motion.stop import StopRequest
from rotemina.drivers.clock import Clock
from rotemina.drivers.samples import DeviceState

_MOVING = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
_MOST_STOPS = 16  # that wait to be told


class StopTracking:
    """Notes stops from any thread; the worker tells them and follows them until all rests."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        # Set by other threads, each in one assignment.
        #: When the latest stop was asked for, until the machine has come to rest.
        self.asked_s: float | None = None
        self._rested_s: float | None = None  # the stop that found the machine at rest
        self._unconfirmed_s: float | None = None
        self._failure: Exception | None = None
        self._to_tell: deque[StopRequest] = deque(maxlen=_MOST_STOPS)
        self._latest: StopRequest | None = None
        self._moved_after: StopRequest | None = None  # the stop after whose end something moved

    def note(self, host_time_s: float, failure: Exception | None, request: StopRequest) -> None:
        """Note, from any thread, that a stop was handed to the device, or failed to be."""
        self.asked_s = self._unconfirmed_s = host_time_s
        if failure is not None:  # a later stop that succeeds does not mend what this one found
            self._failure = failure
        self._to_tell.append(request)
        self._latest = request  # after ``asked_s``: a stop that is seen is seen to be under way

    @property
    def is_latest(self) -> bool:
        """Whether nothing has moved since the latest stop ended; False before the first stop."""
        latest = self._latest
        return latest is not None and latest is not self._moved_after

    def restart(self) -> None:
        """Forget how earlier stops went: they were of another device."""
        self.asked_s = self._rested_s = self._unconfirmed_s = self._failure = None

    def unreported(self) -> Iterator[StopRequest]:
        """Yield each stop that has not been reported yet."""
        while self._to_tell:
            yield self._to_tell.popleft()

    def take_failure(self) -> Exception | None:
        """Return how a stop failed since the last call, or None."""
        failure, self._failure = self._failure, None
        return failure

    def over(self, asked_s: float | None) -> None:
        """Note that all rested when a motion began that was requested after this stop."""
        self._rested_s = asked_s

    def confirmed(
        self, state: SessionState, now_s: float, pending: Callable[[], bool]
    ) -> SessionState:
        """Return the state with how long the device took to confirm the latest stop."""
        asked_s = self._unconfirmed_s
        if asked_s is None or pending():
            return state
        self._unconfirmed_s = None
        return replace(state, stop_latency_s=now_s - asked_s)

    def followed(self, state: SessionState, activity: DeviceState) -> SessionState:
        """Return the state with whether the machine is still stopping, or how long that took."""
        latest, asked_s = self._latest, self.asked_s
        if asked_s is None:
            if activity in _MOVING:
                self._moved_after = latest
            return state
        if asked_s == self._rested_s:
            self.asked_s = None
            return replace(state, standstill_s=0.0, stopping=False)
        if activity not in (DeviceState.IDLE, DeviceState.FAULT):
            return replace(state, standstill_s=None, stopping=True)
        self.asked_s = None
        return replace(state, standstill_s=self._clock() - asked_s, stopping=False)
