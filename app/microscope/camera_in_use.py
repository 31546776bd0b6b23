"""The available cameras, and the one in use."""

import threading
from collections.abc import Callable

from rotemina.app.cameras.feed import CameraFeed, FeedState, FeedView
from rotemina.app.microscope.camera_memory import CameraMemory, UsedCamera
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.drivers.cameras.camera import Camera, CameraIdentity
from rotemina.drivers.cameras.frame import Frame
from rotemina.drivers.cameras.hub import CameraHub
from rotemina.drivers.cameras.settings import CameraSettings
from rotemina.drivers.driver import Driver
from rotemina.drivers.errors import DriverError
from rotemina.drivers.simulator.true_positions import TruePositions
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message

SIMULATED = "simulated"
LOOK_S = 2.0  # between two looks at what is plugged in
_CLOSED = FeedView()


class CameraInUse:
    """Looks for cameras and keeps one open; wishes from any thread, done by the one that steps.

    Where nobody has chosen, the camera that was in use last opens by itself as soon as it is there
    and someone looks, or if there is none such, the simulated microscope.

    Parameters
    ----------
    hub : CameraHub
    driver : callable
        Return the driver in use.
    feed_of : callable
        Make the feed of a camera.
    memory : CameraMemory, optional
        Of the camera that was in use last.
    refuse_in_use : callable
        Raise MicroscopeError while something goes by the camera's pictures.
    """

    def __init__(
        self,
        hub: CameraHub,
        driver: Callable[[], Driver | None],
        feed_of: Callable[[Camera], CameraFeed] = CameraFeed,
        memory: CameraMemory | None = None,
        refuse_in_use: Callable[[], None] = lambda: None,
    ) -> None:
        self._memory = CameraMemory() if memory is None else memory
        self._hub, self._driver, self._feed_of = hub, driver, feed_of
        self._refuse_in_use = refuse_in_use
        self._lock = threading.Lock()  # guards wish and listeners; never held while anybody waits
        self._wish: Callable[[], None] | None = None
        self._chosen = False
        #: Whether somebody looks; until then nothing is looked for, and nothing opens by itself.
        self.watched = False
        self._listeners: dict[Callable[[Frame], None], Callable[[], None]] = {}
        self._feed: CameraFeed | None = None
        self._by_address = False
        self._looked_s: float | None = None
        self._refused = ""
        self._seen_driver: Driver | None = None
        # Of the simulated microscope that was closed as another machine came into use.
        self._interrupted: CameraSettings | None = None
        self.cameras: tuple[CameraIdentity, ...] = ()
        self.problems: dict[str, str] = {}

    # --- any thread -------------------------------------------------------------------------------

    @property
    def camera(self) -> Camera | None:
        """The one in use."""
        feed = self._feed
        return None if feed is None else feed.camera

    @property
    def view(self) -> FeedView:
        """The state of the camera."""
        feed = self._feed
        if feed is not None:
            return feed.view
        if self._refused:
            return FeedView(FeedState.LOST, self._refused)
        return _CLOSED

    @property
    def newest(self) -> Frame | None:
        """Its newest picture."""
        feed = self._feed
        return None if feed is None else feed.newest

    @property
    def truth(self) -> str:
        """Why the simulated microscope shows nothing of the machine in use; empty if it could."""
        return self.problems.get(SIMULATED, "")

    def open(self, key: str, settings: CameraSettings | None = None) -> None:
        """Use a listed camera.

        Raises
        ------
        MicroscopeError
            If none is listed by this key, or a run goes by the one in use.
        """
        self._refuse_in_use()
        found = next((one for one in self.cameras if one.key == key), None)
        if found is None:
            known = ", ".join(one.key for one in self.cameras) or "none"
            raise MicroscopeError(
                message("engine", "there is no camera {key}; available: {known}").fill(
                    key=repr(key), known=known
                )
            )
        self._ask(lambda: self._use(lambda: self._hub.camera(found), settings))

    def open_address(
        self, source: str, address: str, settings: CameraSettings | None = None
    ) -> None:
        """Use an unlisted source, such as a file; :attr:`view` shows problems.

        Raises
        ------
        MicroscopeError
            While a run goes by the one in use.
        """
        self._refuse_in_use()
        self._ask(
            lambda: self._use(
                lambda: self._hub.addressed(source, address), settings, by_address=True
            )
        )

    def close_and_forget(self) -> None:
        """Close the camera, also for the next start; raises as :meth:`open_address`."""
        self._refuse_in_use()

        def forget() -> None:
            self.close()
            self._interrupted = None
            self._memory.keep(None)

        self._ask(forget)

    def configure(self, settings: CameraSettings) -> None:
        """Configure the camera in use; :attr:`view` shows the outcome.

        Raises
        ------
        MicroscopeError
            If there is none, or a run goes by it.
        """
        self._refuse_in_use()
        self._present().configure(settings)

    def trigger(self) -> None:
        """Have one picture taken; raises MicroscopeError if there is none."""
        self._present().trigger()

    def listen(self, tell: Callable[[Frame], None]) -> Callable[[], None]:
        """Call ``listener`` with every picture of any camera; return how to end that.

        ``tell`` is called on the camera's thread and must not wait.
        """
        with self._lock:
            feed = self._feed
            self._listeners[tell] = (lambda: None) if feed is None else feed.listen(tell)

        def leave() -> None:
            with self._lock:
                end = self._listeners.pop(tell, None)
            if end is not None:
                end()

        return leave

    # --- the thread that steps --------------------------------------------------------------------

    def step(self, now_s: float) -> None:
        """Execute requests, and search for cameras now and then; may take a while."""
        with self._lock:
            wish, self._wish = self._wish, None
        if wish is not None:
            wish()
        if not self.watched:
            return
        if self._looked_s is None or now_s - self._looked_s >= LOOK_S:
            self._looked_s = now_s
            self.cameras = self._hub.look()
            self.problems = dict(self._hub.problems)
            self._mind_the_simulated()
            self._open_unasked()
        self._remember()

    def close(self) -> None:
        """Release the camera; what hangs is left behind."""
        feed, self._feed = self._feed, None
        self._refused = ""
        if feed is not None:
            feed.close()

    def _ask(self, wish: Callable[[], None]) -> None:
        with self._lock:
            self._chosen = True
            self._wish = wish

    def _present(self) -> CameraFeed:
        feed = self._feed
        if feed is None:
            raise MicroscopeError(message("engine", "no camera is open; choose one first"))
        return feed

    def _use(
        self,
        make: Callable[[], Camera],
        settings: CameraSettings | None,
        *,
        by_address: bool = False,
    ) -> None:
        self.close()
        self._interrupted = None
        self._by_address = by_address
        try:
            feed = self._feed_of(make())
            feed.start(settings)
        except (DriverError, InputError) as error:
            self._refused = str(error)
            return
        with self._lock:
            self._feed = feed
            self._listeners = {tell: feed.listen(tell) for tell in self._listeners}

    def _mind_the_simulated(self) -> None:
        """Close it where another machine moves than it shows, and open it again when it can show.

        What was said of the device before is gone with it.
        """
        feed, driver = self._feed, self._driver()
        changed, self._seen_driver = driver is not self._seen_driver, driver
        shown = feed is not None and feed.camera.identity.source == SIMULATED
        if feed is not None and shown and driver is not None:
            lost = changed and feed.view.state is FeedState.LOST
            if lost or not isinstance(driver, TruePositions):
                self._interrupted = feed.view.settings
                self.close()
        if self._interrupted is None or self._feed is not None:
            return
        if not isinstance(driver, TruePositions):
            self._refused = self.truth
            return
        found = next((one for one in self.cameras if one.source == SIMULATED), None)
        if found is not None:
            settings, self._interrupted = self._interrupted, None
            self._use(lambda: self._hub.camera(found), settings)

    def _open_unasked(self) -> None:
        """Open, where nobody has chosen, the camera used last; or else the simulated one."""
        if self._chosen or self.camera is not None:
            return
        last = self._memory.last
        if last is None or last.identity.source == SIMULATED:
            found = next((one for one in self.cameras if one.source == SIMULATED), None)
            if found is not None and isinstance(self._driver(), TruePositions):
                settings = None if last is None else last.settings
                self._use(lambda: self._hub.camera(found), settings)
        elif last.by_address or any(one.key == last.identity.key for one in self.cameras):
            self._use(
                lambda: self._hub.camera(last.identity), last.settings, by_address=last.by_address
            )
        else:
            self._refused = message(
                "engine",
                "{camera} ({key}), the camera used last, is not connected; plug it in, or "
                "choose another",
            ).fill(camera=last.identity.name, key=last.identity.key)

    def _remember(self) -> None:
        """Keep what is in use, once it has shown a picture: then it is set as it was told."""
        feed = self._feed
        if feed is not None and feed.view.frame is not None:
            used = UsedCamera(feed.camera.identity, feed.view.settings, self._by_address)
            self._memory.keep(used)
