"""The server of the 3-D view: loopback only, with a secret in its address, on its own thread."""

import asyncio
import logging
import secrets
import socket
import threading
from collections.abc import Callable

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application

from rotemina.app.errors import ViewerError
from rotemina.app.scene.handlers import PageFileHandler, SceneSocket
from rotemina.app.scene.page import load_page_files
from rotemina.app.scene.scene import SceneCommandStore
from rotemina.app.scene.viewers import ConnectedViewers
from rotemina.sim.errors import describe_exception

_LOG = logging.getLogger(__name__)

LOOPBACK_HOST = "127.0.0.1"
_SECRET_BYTES = 32
# Pings detect viewers that have disappeared without closing the connection.
_PING_PERIOD_S = 10.0
# No request needs a body, so even a small limit is sufficient.
_MAX_HEADER_BYTES, _MAX_BODY_BYTES = 16_384, 64
_MAX_MESSAGE_BYTES = 64
_SHUTDOWN_TIMEOUT_S = 5.0


class ViewServer:
    """Serves a scene at a secret address, from :meth:`start` until :meth:`close`.

    Parameters
    ----------
    scene : SceneCommandStore
        After each change of the scene, :meth:`send_changes` must be called.
    """

    def __init__(self, scene: SceneCommandStore) -> None:
        self._viewers = ConnectedViewers(scene)
        self._secret = secrets.token_urlsafe(_SECRET_BYTES)
        self._sockets: list[socket.socket] = []
        self._loop: asyncio.AbstractEventLoop | None = None
        self._stop_event: asyncio.Event | None = None
        # Set once the server listens or has failed.
        self._ready = threading.Event()
        self._failure: Exception | None = None
        self._thread: threading.Thread | None = None

    @property
    def origin(self) -> str:
        """The address without the secret, which a browser sends in ``Origin``."""
        return f"http://{LOOPBACK_HOST}:{self._sockets[0].getsockname()[1]}"

    @property
    def url(self) -> str:
        """The full address with the secret; a viewer needs nothing else."""
        return f"{self.origin}/{self._secret}/"

    @property
    def viewer_count(self) -> int:
        """Number of connected viewers."""
        return len(self._viewers)

    def start(self) -> None:
        """Bind a free port and start the server; return once it is listening.

        Raises
        ------
        ViewerError
            If no port can be bound, the thread cannot serve it, or a file of the viewer cannot be
            read.
        """
        files = load_page_files()
        try:
            self._sockets = bind_sockets(0, LOOPBACK_HOST, family=socket.AF_INET)
        except OSError as error:
            raise _make_listen_error(error) from error
        application = Application(
            [
                (r"/[^/]+/socket", SceneSocket),
                (r"/[^/]+/(.*)", PageFileHandler),
                (r"(.*)", PageFileHandler),
            ],
            origin=self.origin,
            secret=self._secret,
            files=files,
            viewers=self._viewers,
            # The request log would contain the secret.
            log_function=lambda handler: None,
            websocket_ping_interval=_PING_PERIOD_S,
            websocket_max_message_size=_MAX_MESSAGE_BYTES,
        )
        self._thread = threading.Thread(
            target=self._run, args=(application,), name="3-D view", daemon=True
        )
        self._thread.start()
        self._ready.wait()
        if self._failure is not None:
            for bound_socket in self._sockets:
                bound_socket.close()
            raise _make_listen_error(self._failure) from self._failure

    def send_changes(self) -> None:
        """Send changes of the scene to the viewers; never waits, may be called on any thread."""
        if self._loop is not None:
            self._call_in_loop(self._viewers.send_changes)

    def close(self) -> bool:
        """Disconnect all viewers and end the thread; return whether it has ended.

        It is safe to call this twice.
        """
        if self._thread is None:
            return True
        stop_event = self._stop_event
        if stop_event is not None:
            self._call_in_loop(stop_event.set)
        self._thread.join(_SHUTDOWN_TIMEOUT_S)
        return not self._thread.is_alive()

    def _call_in_loop(self, action: Callable[[], None]) -> None:
        assert self._loop is not None
        try:
            self._loop.call_soon_threadsafe(action)
        except RuntimeError:
            # The event loop has just ended.
            _LOG.debug("the 3-D view has ended")

    def _run(self, application: Application) -> None:
        try:
            with asyncio.Runner() as runner:
                runner.run(self._serve(application))
        except Exception as error:
            if self._ready.is_set():
                raise
            # An event loop needs open files, so it may fail to start.
            self._failure = error
            self._ready.set()

    async def _serve(self, application: Application) -> None:
        server = HTTPServer(
            application, max_header_size=_MAX_HEADER_BYTES, max_body_size=_MAX_BODY_BYTES
        )
        server.add_sockets(self._sockets)
        self._loop, self._stop_event = asyncio.get_running_loop(), asyncio.Event()
        self._ready.set()
        await self._stop_event.wait()
        server.stop()
        self._viewers.close()
        await server.close_all_connections()


def _make_listen_error(error: Exception) -> ViewerError:
    return ViewerError(
        "the 3-D view cannot listen on {host}: {strerror}; a firewall or the limit on open "
        "files may prevent it",
        host=LOOPBACK_HOST,
        strerror=describe_exception(error),
    )
