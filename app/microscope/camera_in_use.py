"""The available cameras, and the one in use."""

import threading
from collections.abc import Callable

from rotemina.app.cameras import (
    CameraFeed,
    FeedState,
    FeedView,
)
from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.camera_memory import CameraMemory, RememberedCamera
from rotemina.drivers.abilities import TruePositions
from rotemina.drivers.cameras import Camera, CameraFrame, CameraHub, CameraIdentity, CameraSettings
from rotemina.drivers.contract import Driver, DriverError
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

SIMULATED_SOURCE = "simulated"
CAMERA_SEARCH_PERIOD_S = 2.0
_CLOSED_VIEW = FeedView()


class CameraInUse:
    """The camera in use, which is kept open, and the search for available cameras.

    Any thread may make requests; the thread that calls :meth:`step` executes them. Until someone
    selects a camera, the last used camera is opened automatically as soon as it is connected and a
    view is watching. If no camera is remembered, the simulated microscope is opened instead.

    Parameters
    ----------
    hub : CameraHub
    driver : callable
        Returns the driver in use, or None.
    make_feed : callable
        Makes the feed of a camera.
    memory : CameraMemory, optional
        Remembers the last used camera.
    refuse_if_in_use : callable
        Raises MicroscopeError while a run depends on the camera's pictures.
    """

    def __init__(
        self,
        hub: CameraHub,
        driver: Callable[[], Driver | None],
        make_feed: Callable[[Camera], CameraFeed] = CameraFeed,
        memory: CameraMemory | None = None,
        refuse_if_in_use: Callable[[], None] = lambda: None,
    ) -> None:
        self._memory = CameraMemory() if memory is None else memory
        self._hub, self._get_driver, self._make_feed = hub, driver, make_feed
        self._refuse_if_in_use = refuse_if_in_use
        # Guards the request and the listeners; never held during a wait.
        self._lock = threading.Lock()
        self._request: Callable[[], None] | None = None
        self._has_user_chosen = False
        #: Whether a view is watching. While none is, no camera is searched for or opened
        #: automatically.
        self.is_watched = False
        # Each listener with the function that ends its subscription to the feed.
        self._listeners: dict[Callable[[CameraFrame], None], Callable[[], None]] = {}
        self._feed: CameraFeed | None = None
        self._is_by_address = False
        self._last_search_s: float | None = None
        self._open_error = ""
        self._previous_driver: Driver | None = None
        # Settings of the simulated microscope, if it was closed because another machine is in use.
        self._interrupted_settings: CameraSettings | None = None
        self.cameras: tuple[CameraIdentity, ...] = ()
        self.problems: dict[str, str] = {}

    @property
    def camera(self) -> Camera | None:
        """The camera in use."""
        feed = self._feed
        return None if feed is None else feed.camera

    @property
    def view(self) -> FeedView:
        """The state of the camera."""
        feed = self._feed
        if feed is not None:
            return feed.view
        if self._open_error:
            return FeedView(FeedState.LOST, self._open_error)
        return _CLOSED_VIEW

    @property
    def newest_frame(self) -> CameraFrame | None:
        """The newest picture of the camera in use."""
        feed = self._feed
        return None if feed is None else feed.newest

    @property
    def simulation_problem(self) -> str:
        """Why the simulated microscope cannot show the machine in use; empty if it can."""
        return self.problems.get(SIMULATED_SOURCE, "")

    def open(self, key: str, settings: CameraSettings | None = None) -> None:
        """Use a listed camera.

        Raises
        ------
        MicroscopeError
            If no camera with this key is listed, or a run depends on the camera in use.
        """
        self._refuse_if_in_use()
        match = next((camera for camera in self.cameras if camera.key == key), None)
        if match is None:
            known = ", ".join(camera.key for camera in self.cameras) or "none"
            raise MicroscopeError(
                "there is no camera {key}; available: {known}", key=repr(key), known=known
            )
        self._set_request(lambda: self._open_camera(lambda: self._hub.make_camera(match), settings))

    def open_address(
        self, source: str, address: str, settings: CameraSettings | None = None
    ) -> None:
        """Use an unlisted source, such as a file; :attr:`view` shows problems.

        Raises
        ------
        MicroscopeError
            If a run depends on the camera in use.
        """
        self._refuse_if_in_use()
        self._set_request(
            lambda: self._open_camera(
                lambda: self._hub.camera_at_address(source, address), settings, by_address=True
            )
        )

    def close_and_forget(self) -> None:
        """Close the camera, and do not open it at the next start.

        Raises
        ------
        MicroscopeError
            If a run uses the camera.
        """
        self._refuse_if_in_use()

        def forget() -> None:
            self.close()
            self._interrupted_settings = None
            self._memory.store(None)

        self._set_request(forget)

    def configure(self, settings: CameraSettings) -> None:
        """Configure the camera in use; :attr:`view` shows the outcome.

        Raises
        ------
        MicroscopeError
            If no camera is open, or a run uses it.
        """
        self._refuse_if_in_use()
        self._require_feed().configure(settings)

    def trigger(self) -> None:
        """Trigger one picture; raises MicroscopeError if no camera is open."""
        self._require_feed().trigger()

    def listen(self, listener: Callable[[CameraFrame], None]) -> Callable[[], None]:
        """Call ``listener`` with every picture of any camera; return a function that ends this.

        ``listener`` is called on the camera's thread and must not wait.
        """
        with self._lock:
            feed = self._feed
            self._listeners[listener] = (lambda: None) if feed is None else feed.listen(listener)

        def unsubscribe() -> None:
            with self._lock:
                unsubscribe_from_feed = self._listeners.pop(listener, None)
            if unsubscribe_from_feed is not None:
                unsubscribe_from_feed()

        return unsubscribe

    def step(self, now_s: float) -> None:
        """Execute the latest request, and search for cameras when due; may take a while."""
        with self._lock:
            request, self._request = self._request, None
        if request is not None:
            request()
        if not self.is_watched:
            return
        if self._last_search_s is None or now_s - self._last_search_s >= CAMERA_SEARCH_PERIOD_S:
            self._last_search_s = now_s
            self.cameras = self._hub.find_cameras()
            self.problems = dict(self._hub.problems)
            self._update_simulated()
            self._open_default()
        self._remember()

    def close(self) -> None:
        """Release the camera; a camera that hangs is abandoned."""
        feed, self._feed = self._feed, None
        self._open_error = ""
        if feed is not None:
            feed.close()

    def _set_request(self, request: Callable[[], None]) -> None:
        with self._lock:
            self._has_user_chosen = True
            self._request = request

    def _require_feed(self) -> CameraFeed:
        feed = self._feed
        if feed is None:
            raise MicroscopeError("no camera is open; choose one first")
        return feed

    def _open_camera(
        self,
        make: Callable[[], Camera],
        settings: CameraSettings | None,
        *,
        by_address: bool = False,
    ) -> None:
        self.close()
        self._interrupted_settings = None
        self._is_by_address = by_address
        try:
            feed = self._make_feed(make())
            feed.start(settings)
        except (DriverError, InputError) as error:
            self._open_error = str(error)
            return
        with self._lock:
            self._feed = feed
            self._listeners = {listener: feed.listen(listener) for listener in self._listeners}

    def _update_simulated(self) -> None:
        """Close the simulated microscope if it cannot show the machine in use; reopen it later.

        The simulated microscope is also reopened if it was lost and the driver has changed since
        then, because its problem was that of the earlier driver.
        """
        feed, driver = self._feed, self._get_driver()
        driver_changed, self._previous_driver = driver is not self._previous_driver, driver
        is_simulated = feed is not None and feed.camera.identity.source == SIMULATED_SOURCE
        if feed is not None and is_simulated and driver is not None:
            needs_reopening = driver_changed and feed.view.state is FeedState.LOST
            if needs_reopening or not isinstance(driver, TruePositions):
                self._interrupted_settings = feed.view.settings
                self.close()
        if self._interrupted_settings is None or self._feed is not None:
            return
        if not isinstance(driver, TruePositions):
            self._open_error = self.simulation_problem
            return
        match = next((camera for camera in self.cameras if camera.source == SIMULATED_SOURCE), None)
        if match is not None:
            settings, self._interrupted_settings = self._interrupted_settings, None
            self._open_camera(lambda: self._hub.make_camera(match), settings)

    def _open_default(self) -> None:
        """Open the last used camera or the simulated one, unless the user has chosen a camera."""
        if self._has_user_chosen or self.camera is not None:
            return
        last_camera = self._memory.last_camera
        if last_camera is None or last_camera.identity.source == SIMULATED_SOURCE:
            match = next(
                (camera for camera in self.cameras if camera.source == SIMULATED_SOURCE), None
            )
            if match is not None and isinstance(self._get_driver(), TruePositions):
                settings = None if last_camera is None else last_camera.settings
                self._open_camera(lambda: self._hub.make_camera(match), settings)
        elif last_camera.by_address or any(
            camera.key == last_camera.identity.key for camera in self.cameras
        ):
            self._open_camera(
                lambda: self._hub.make_camera(last_camera.identity),
                last_camera.settings,
                by_address=last_camera.by_address,
            )
        else:
            self._open_error = message(
                "engine",
                "{camera} ({key}), the camera used last, is not connected; plug it in, or "
                "choose another",
            ).fill(camera=last_camera.identity.name, key=last_camera.identity.key)

    def _remember(self) -> None:
        """Remember the camera in use once a picture shows that its settings are in force."""
        feed = self._feed
        if feed is not None and feed.view.frame is not None:
            camera_in_use = RememberedCamera(
                feed.camera.identity, feed.view.settings, self._is_by_address
            )
            self._memory.store(camera_in_use)
