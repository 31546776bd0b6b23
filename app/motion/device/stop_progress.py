"""Progress of requested stops, from the request until the machine rests."""

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import replace

from rotemina.app.motion.state import SessionState, StopRequest
from rotemina.drivers.contract import Clock, DeviceState

_MOVING_STATES = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
# Older unreported stops are dropped beyond this number.
_MAX_UNREPORTED_STOPS = 16


class StopTracking:
    """Receives stops from any thread; the worker follows each until all axes rest."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        # Other threads set the next values without a lock, each in one assignment.
        #: Host time of the latest stop request, until the machine has come to rest.
        self.requested_s: float | None = None
        # Request time of the stop that found the machine at rest.
        self._stop_at_rest_s: float | None = None
        self._unconfirmed_s: float | None = None
        self._failure: Exception | None = None
        self._unreported_stops: deque[StopRequest] = deque(maxlen=_MAX_UNREPORTED_STOPS)
        self._latest: StopRequest | None = None
        # The latest stop after which the machine has moved again.
        self._stop_before_motion: StopRequest | None = None

    def note(self, host_time_s: float, failure: Exception | None, request: StopRequest) -> None:
        """Take note that a stop was passed to the device, or that this failed. Thread-safe."""
        self.requested_s = self._unconfirmed_s = host_time_s
        # A later stop that succeeds must not hide this failure.
        if failure is not None:
            self._failure = failure
        self._unreported_stops.append(request)
        # This is set after ``requested_s``, so that the worker never takes this stop for ended.
        self._latest = request

    @property
    def is_resting(self) -> bool:
        """Whether nothing has moved since the latest stop ended; False before the first stop."""
        latest_stop = self._latest
        return latest_stop is not None and latest_stop is not self._stop_before_motion

    def restart(self) -> None:
        """Forget the progress of earlier stops when another device is connected."""
        self.requested_s = self._stop_at_rest_s = self._unconfirmed_s = self._failure = None

    def take_unreported(self) -> Iterator[StopRequest]:
        """Yield each stop that has not been reported yet."""
        while self._unreported_stops:
            yield self._unreported_stops.popleft()

    def take_failure(self) -> Exception | None:
        """Return the failure of a stop since the last call, or None."""
        failure, self._failure = self._failure, None
        return failure

    def note_rest_before(self, requested_s: float | None) -> None:
        """Take note that the machine came to rest after this stop before the next motion."""
        self._stop_at_rest_s = requested_s

    def with_confirmation(
        self, state: SessionState, now_s: float, is_pending: Callable[[], bool]
    ) -> SessionState:
        """Return the state with the time until the device confirmed the latest stop.

        ``is_pending`` returns whether the device has not confirmed the stop yet.
        """
        requested_s = self._unconfirmed_s
        if requested_s is None or is_pending():
            return state
        self._unconfirmed_s = None
        return replace(state, stop_latency_s=now_s - requested_s)

    def with_progress(self, state: SessionState, activity: DeviceState) -> SessionState:
        """Return the state updated with the stop that is running, or the time until standstill."""
        latest_stop, requested_s = self._latest, self.requested_s
        if requested_s is None:
            if activity in _MOVING_STATES:
                self._stop_before_motion = latest_stop
            return state
        if requested_s == self._stop_at_rest_s:
            self.requested_s = None
            return replace(state, standstill_s=0.0, stopping=False)
        if activity not in (DeviceState.IDLE, DeviceState.FAULT):
            return replace(state, standstill_s=None, stopping=True)
        self.requested_s = None
        return replace(state, standstill_s=self._clock() - requested_s, stopping=False)
