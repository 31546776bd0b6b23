"""A camera in use: one thread grabs pictures, and readers get the newest one without waiting."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.cameras.frame_check import MIN_FROZEN_S, FrameCheck, PictureState
from rotemina.drivers.cameras import (
    Camera,
    CameraDescription,
    CameraFrame,
    CameraSettings,
    CameraTrigger,
)
from rotemina.drivers.contract import CameraSettingError, Clock, DriverError, StateError
from rotemina.sim.messages import format_fixed, format_rounded, marked, message

_LOG = logging.getLogger(__name__)

# A free-running camera counts as stalled if no picture has arrived for this long.
STALL_TIMEOUT_S = 1.0
# Longest time that a grab may block, and so delay a request.
_GRAB_TIMEOUT_S = 0.1
# Weight of the latest interval in the exponentially smoothed rate.
_RATE_SMOOTHING_RATIO = 0.1
_UNCHANGED_SETTINGS = CameraSettings()


class FeedState(StrEnum):
    """The state of a camera."""

    CLOSED = "closed"
    OPENING = "opening"
    LIVE = "live"
    WAITING = marked("engine", "waiting for a trigger")
    STALLED = "stalled"
    FROZEN = "frozen"
    BLACK = "black"
    LOST = "lost"


_FREE_RUNNING = (FeedState.LIVE, FeedState.FROZEN, FeedState.BLACK)


@dataclass(frozen=True, slots=True, eq=False)
class FeedView:
    """The state of a camera feed at one moment.

    Attributes
    ----------
    state : FeedState
    reason : str
        What is wrong and what to do; empty if nothing is wrong.
    frame : CameraFrame or None
        The newest picture; kept after the camera is lost. Pictures that a frozen camera repeats do
        not count as new.
    age_s : float or None
        Age of ``frame``.
    rate_hz : float
        Smoothed rate of new pictures; 0 until the second one.
    settings : CameraSettings
        Settings in force.
    description : CameraDescription or None
        None unless the camera is open.
    problem : str
        Why the latest settings were refused; empty if they were not.
    """

    state: FeedState = FeedState.CLOSED
    reason: str = ""
    frame: CameraFrame | None = None
    age_s: float | None = None
    rate_hz: float = 0.0
    settings: CameraSettings = _UNCHANGED_SETTINGS
    description: CameraDescription | None = None
    problem: str = ""


class CameraFeed:
    """Keeps a camera open on its own thread. Every method may be called from any thread.

    Parameters
    ----------
    camera : Camera
        Nothing else may use it from now on.
    clock : callable
        Returns the host's time, s. The camera uses the same clock.
    """

    def __init__(self, camera: Camera, *, clock: Clock = time.monotonic) -> None:
        self.camera = camera
        self._clock = clock
        # Replaced as a whole, only by the camera's thread.
        self._latest = FeedView()
        # Host time of the latest picture, even if it repeats an earlier one.
        self._latest_arrival_s = 0.0
        self._requested_settings: CameraSettings | None = None
        self._pending_triggers = 0
        self._listeners: tuple[Callable[[CameraFrame], None], ...] = ()
        # Guards the requested settings, the pending triggers and the listeners. Held only briefly.
        self._lock = threading.Lock()
        self._stop_event = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def view(self) -> FeedView:
        """The present state, including the age of the newest picture; never waits."""
        latest = self._latest
        if latest.frame is None:
            return latest
        age_s = max(self._clock() - latest.frame.host_time_s, 0.0)
        if latest.state not in _FREE_RUNNING or latest.settings.trigger is CameraTrigger.SOFTWARE:
            return replace(latest, age_s=age_s)
        # Slow cameras and long exposures have longer intervals between pictures.
        max_interval_s = max(STALL_TIMEOUT_S, 3.0 * (latest.settings.exposure_s or 0.0))
        if latest.rate_hz:
            max_interval_s = max(max_interval_s, 3.0 / latest.rate_hz)
        silent_s = self._clock() - self._latest_arrival_s
        if silent_s <= max_interval_s:
            return replace(latest, age_s=age_s)
        reason = message(
            "engine", "no picture for {seconds} s; check the camera and its cable, or open it again"
        ).fill(seconds=format_fixed(silent_s, 1))
        return replace(latest, age_s=age_s, state=FeedState.STALLED, reason=reason)

    @property
    def newest(self) -> CameraFrame | None:
        """The newest picture, or None before the first picture."""
        return self._latest.frame

    def start(self, settings: CameraSettings | None = None) -> None:
        """Open the camera, or reopen a lost one, and grab pictures until :meth:`close`.

        Raises
        ------
        StateError
            If the feed is running already, or its thread still waits for a camera that does not
            answer.
        """
        if self._thread is not None and self._thread.is_alive():
            raise StateError(
                "{name}: its thread is still running; close it first", name=self.camera.name
            )
        with self._lock:
            self._requested_settings = settings
            self._pending_triggers = 0
        self._stop_event.clear()
        self._latest = FeedView(FeedState.OPENING)
        name = f"camera {self.camera.identity.key}"
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def close(self, timeout_s: float = 2.0) -> bool:
        """Release the camera; return whether its thread has ended in time.

        A thread that hangs in its camera is abandoned and disturbs nothing else.
        """
        self._stop_event.set()
        thread = self._thread
        if thread is None or thread is threading.current_thread():
            return True
        thread.join(timeout_s)
        return not thread.is_alive()

    def configure(self, settings: CameraSettings) -> None:
        """Request settings; only the latest request counts, and :attr:`view` shows the outcome."""
        with self._lock:
            self._requested_settings = settings

    def trigger(self) -> None:
        """Trigger one picture, if the camera waits for triggers."""
        with self._lock:
            self._pending_triggers += 1

    def listen(self, listener: Callable[[CameraFrame], None]) -> Callable[[], None]:
        """Call ``listener`` with every new picture; return a function that ends this.

        ``listener`` is called on the camera's thread and must not wait. A recorder, for example,
        puts the frame into a bounded queue.
        """
        with self._lock:
            self._listeners = (*self._listeners, listener)

        def unsubscribe() -> None:
            with self._lock:
                self._listeners = tuple(other for other in self._listeners if other is not listener)

        return unsubscribe

    def _run(self) -> None:
        # This method and all private ones below run on the camera's thread.
        check = FrameCheck()
        try:
            self.camera.open()
            self._publish(
                state=FeedState.LIVE,
                description=self.camera.description,
                settings=self.camera.settings,
            )
            while not self._stop_event.is_set():
                self._apply_requests()
                frame = self.camera.grab(_GRAB_TIMEOUT_S)
                if frame is not None:
                    self._handle_frame(frame, check)
        except DriverError as error:
            self._mark_lost(str(error))
        except Exception:
            # The camera may be a plugin, which may raise anything.
            _LOG.exception("%s failed", self.camera.name)
            self._mark_lost(
                message(
                    "engine",
                    "{name} failed; the log has the cause. Check the camera and its cable, and "
                    "open it again",
                ).fill(name=self.camera.name)
            )
        else:
            self._publish(state=FeedState.CLOSED, reason="", description=None)
        finally:
            self._close_camera()

    def _close_camera(self) -> None:
        try:
            self.camera.close()
        except Exception:
            # The camera was removed, or its plugin is faulty; nothing more can be done.
            _LOG.exception("%s could not be closed", self.camera.name)

    def _mark_lost(self, reason: str) -> None:
        self._publish(state=FeedState.LOST, reason=reason, description=None)

    def _apply_requests(self) -> None:
        with self._lock:
            requested, self._requested_settings = self._requested_settings, None
        if requested is not None:
            problem = ""
            try:
                self.camera.configure(requested)
            except CameraSettingError as error:
                problem = str(error)
            settings = self.camera.settings
            is_triggered = settings.trigger is CameraTrigger.SOFTWARE
            state = FeedState.WAITING if is_triggered else FeedState.LIVE
            self._publish(settings=settings, problem=problem, state=state, reason="")
        if self.camera.settings.trigger is CameraTrigger.SOFTWARE:
            with self._lock:
                has_trigger = self._pending_triggers > 0
                self._pending_triggers = max(self._pending_triggers - 1, 0)
            if has_trigger:
                self.camera.trigger()

    def _handle_frame(self, frame: CameraFrame, check: FrameCheck) -> None:
        """Publish a new picture. A repeated picture only updates the state of the camera."""
        verdict = check.classify(frame)
        self._latest_arrival_s = frame.host_time_s
        if verdict is PictureState.FROZEN:
            frozen_reason = message(
                "engine",
                "the camera has only repeated earlier pictures for more than {seconds} s; do not "
                "trust them, and open the camera again",
            ).fill(seconds=format_rounded(MIN_FROZEN_S, 6))
            self._publish(state=FeedState.FROZEN, reason=frozen_reason)
        if check.is_repeated:
            return
        rate_hz, previous = self._latest.rate_hz, self._latest.frame
        if previous is not None and frame.host_time_s > previous.host_time_s:
            latest_rate_hz = 1.0 / (frame.host_time_s - previous.host_time_s)
            if rate_hz:
                rate_hz += _RATE_SMOOTHING_RATIO * (latest_rate_hz - rate_hz)
            else:
                rate_hz = latest_rate_hz
        state, reason = FeedState.LIVE, ""
        if self.camera.settings.trigger is CameraTrigger.SOFTWARE:
            state = FeedState.WAITING
        if verdict is PictureState.BLACK:
            state = FeedState.BLACK
            reason = message(
                "engine", "the picture is black; check lamp, shutter, lens cap and exposure"
            )
        self._publish(frame=frame, rate_hz=rate_hz, state=state, reason=reason)
        with self._lock:
            listeners = self._listeners
        for listener in listeners:
            try:
                listener(frame)
            except Exception:
                # A listener that fails must not end the feed for the others.
                _LOG.exception("%s: a listener failed", self.camera.name)

    def _publish(self, **changes: object) -> None:
        self._latest = replace(self._latest, **changes)  # type: ignore[arg-type]
