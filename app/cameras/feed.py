"""A camera in use: one thread grabs pictures, and readers get the newest one without waiting."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

from rotemina.app.cameras.frame_check import FROZEN_S, FrameCheck, PictureState
from rotemina.drivers.cameras.camera import Camera
from rotemina.drivers.cameras.errors import CameraSettingError
from rotemina.drivers.cameras.frame import Frame
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, Trigger
from rotemina.drivers.clock import Clock
from rotemina.drivers.errors import DriverError, StateError
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import fixed, rounded

_LOG = logging.getLogger(__name__)

STALLED_S = 1.0
_GRAB_S = 0.1  # how long a request may wait for a picture
_SMOOTHING = 0.1  # of the rate, per picture
_AS_IT_IS = CameraSettings()


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
    """One moment of it.

    Attributes
    ----------
    state : FeedState
    reason : str
        What is wrong and what to do; empty while nothing is.
    frame : Frame or None
        The newest picture, also of a camera that was lost. One that a frozen camera gives again is
        not new.
    age_s : float or None
        Since that came in.
    rate_hz : float
        Of new pictures that came in lately; 0 before there are two.
    settings : CameraSettings
        In force.
    description : CameraDescription or None
        None while it is not open.
    problem : str
        Why the latest settings were refused; empty if they were not.
    """

    state: FeedState = FeedState.CLOSED
    reason: str = ""
    frame: Frame | None = None
    age_s: float | None = None
    rate_hz: float = 0.0
    settings: CameraSettings = _AS_IT_IS
    description: CameraDescription | None = None
    problem: str = ""


class CameraFeed:
    """Keeps a camera open on its own thread. Every method may be called from any thread.

    Parameters
    ----------
    camera : Camera
        Nobody else uses it from now on.
    clock : callable
        The host's time, s: the camera's own clock.
    """

    def __init__(self, camera: Camera, *, clock: Clock = time.monotonic) -> None:
        self.camera = camera
        self._clock = clock
        self._latest = FeedView()  # exchanged as a whole, by the thread alone
        self._arrived_s = 0.0  # when the latest picture came, also one that is not new
        self._wanted: CameraSettings | None = None
        self._triggers = 0
        self._listeners: tuple[Callable[[Frame], None], ...] = ()
        self._lock = threading.Lock()  # guards the three above; never held while anybody waits
        self._ending = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def view(self) -> FeedView:
        """The present state, by the age of the newest picture; never waits."""
        latest = self._latest
        if latest.frame is None:
            return latest
        age_s = max(self._clock() - latest.frame.host_time_s, 0.0)
        if latest.state not in _FREE_RUNNING or latest.settings.trigger is Trigger.SOFTWARE:
            return replace(latest, age_s=age_s)
        longest_s = max(STALLED_S, 3.0 * (latest.settings.exposure_s or 0.0))
        if latest.rate_hz:
            longest_s = max(longest_s, 3.0 / latest.rate_hz)
        silent_s = self._clock() - self._arrived_s
        if silent_s <= longest_s:
            return replace(latest, age_s=age_s)
        reason = message(
            "engine", "no picture for {seconds} s; check the camera and its cable, or open it again"
        ).fill(seconds=fixed(silent_s, 1))
        return replace(latest, age_s=age_s, state=FeedState.STALLED, reason=reason)

    @property
    def newest(self) -> Frame | None:
        """The newest picture."""
        return self._latest.frame

    def start(self, settings: CameraSettings | None = None) -> None:
        """Open the camera and continue until :meth:`close`; also after it was lost.

        Raises
        ------
        StateError
            If it runs already, or its thread still waits for a camera that does not answer.
        """
        if self._thread is not None and self._thread.is_alive():
            raise StateError(
                message("engine", "{name}: its thread is still running; close it first").fill(
                    name=self.camera.name
                )
            )
        with self._lock:
            self._wanted = settings
            self._triggers = 0
        self._ending.clear()
        self._latest = FeedView(FeedState.OPENING)
        name = f"camera {self.camera.identity.key}"
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def close(self, timeout_s: float = 2.0) -> bool:
        """Release the camera; return whether its thread has ended in time.

        One that hangs in its camera is left behind and hinders nobody.
        """
        self._ending.set()
        thread = self._thread
        if thread is None or thread is threading.current_thread():
            return True
        thread.join(timeout_s)
        return not thread.is_alive()

    def configure(self, settings: CameraSettings) -> None:
        """Request settings; the latest request counts, and ``view`` shows the outcome."""
        with self._lock:
            self._wanted = settings

    def trigger(self) -> None:
        """Have one picture taken, if it waits for a trigger."""
        with self._lock:
            self._triggers += 1

    def listen(self, tell: Callable[[Frame], None]) -> Callable[[], None]:
        """Call ``listener`` with every picture, on the camera's thread; return how to end that.

        ``tell`` must not wait: a recorder puts the frame into a bounded queue.
        """
        with self._lock:
            self._listeners = (*self._listeners, tell)

        def leave() -> None:
            with self._lock:
                self._listeners = tuple(one for one in self._listeners if one is not tell)

        return leave

    # --- on the camera's thread -------------------------------------------------------------------

    def _run(self) -> None:
        check = FrameCheck()
        try:
            self.camera.open()
            self._publish(
                state=FeedState.LIVE,
                description=self.camera.description,
                settings=self.camera.settings,
            )
            while not self._ending.is_set():
                self._obey()
                frame = self.camera.grab(_GRAB_S)
                if frame is not None:
                    self._take(frame, check)
        except DriverError as error:
            self._lose(str(error))
        except Exception:  # a plugin may raise anything
            _LOG.exception("%s failed", self.camera.name)
            self._lose(
                message(
                    "engine",
                    "{name} failed; the log has the cause. Check the camera and its cable, and "
                    "open it again",
                ).fill(name=self.camera.name)
            )
        else:
            self._publish(state=FeedState.CLOSED, reason="", description=None)
        finally:
            self._let_go()

    def _let_go(self) -> None:
        try:
            self.camera.close()
        except Exception:  # it has gone, or is a bad plugin: nothing is left to do about it
            _LOG.exception("%s could not be closed", self.camera.name)

    def _lose(self, reason: str) -> None:
        self._publish(state=FeedState.LOST, reason=reason, description=None)

    def _obey(self) -> None:
        """Set what was requested, and pass on a trigger."""
        with self._lock:
            wanted, self._wanted = self._wanted, None
        if wanted is not None:
            problem = ""
            try:
                self.camera.configure(wanted)
            except CameraSettingError as error:
                problem = str(error)
            settings = self.camera.settings
            waiting = settings.trigger is Trigger.SOFTWARE
            state = FeedState.WAITING if waiting else FeedState.LIVE
            self._publish(settings=settings, problem=problem, state=state, reason="")
        if self.camera.settings.trigger is Trigger.SOFTWARE:
            with self._lock:
                due = self._triggers > 0
                self._triggers = max(self._triggers - 1, 0)
            if due:
                self.camera.trigger()

    def _take(self, frame: Frame, check: FrameCheck) -> None:
        """Show a new picture; of one that is not new, only what it says about the camera."""
        shown = check.judge(frame)
        self._arrived_s = frame.host_time_s
        if shown is PictureState.FROZEN:
            frozen = message(
                "engine",
                "the camera has only repeated earlier pictures for more than {seconds} s; do not "
                "trust them, and open the camera again",
            ).fill(seconds=rounded(FROZEN_S, 6))
            self._publish(state=FeedState.FROZEN, reason=frozen)
        if check.is_repeated:
            return
        rate_hz, before = self._latest.rate_hz, self._latest.frame
        if before is not None and frame.host_time_s > before.host_time_s:
            now_hz = 1.0 / (frame.host_time_s - before.host_time_s)
            rate_hz = now_hz if not rate_hz else rate_hz + _SMOOTHING * (now_hz - rate_hz)
        state, reason = FeedState.LIVE, ""
        if self.camera.settings.trigger is Trigger.SOFTWARE:
            state = FeedState.WAITING
        if shown is PictureState.BLACK:
            state = FeedState.BLACK
            reason = message(
                "engine", "the picture is black; check lamp, shutter, lens cap and exposure"
            )
        self._publish(frame=frame, rate_hz=rate_hz, state=state, reason=reason)
        with self._lock:
            listeners = self._listeners
        for tell in listeners:
            try:
                tell(frame)
            except Exception:  # one bad listener must not end the picture for all
                _LOG.exception("%s: a listener failed", self.camera.name)

    def _publish(self, **changes: object) -> None:
        self._latest = replace(self._latest, **changes)  # type: ignore[arg-type]
