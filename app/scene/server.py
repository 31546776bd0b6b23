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

from rotemina.app.scene.handlers import FileHandler, SceneSocket
from rotemina.app.scene.page import ViewerError, page_files
from rotemina.app.scene.scene import Scene
from rotemina.app.scene.viewers import Viewers
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message

_LOG = logging.getLogger(__name__)

HOST = "127.0.0.1"
_SECRET_BYTES = 32
_PING_S = 10.0  # after which a viewer that is gone is noticed
_HEAD_BYTES, _BODY_BYTES = 16_384, 64  # that a request may have; none needs a body
_SAID_BYTES = 64  # that a viewer may say at once
_ENDING_S = 5.0


class ViewServer:
    """Serves a scene at a secret address, from :meth:`start` until :meth:`close`.

    Parameters
    ----------
    scene : Scene
        Who changes it calls :meth:`changed` afterwards.
    """

    def __init__(self, scene: Scene) -> None:
        self._viewers = Viewers(scene)
        self._secret = secrets.token_urlsafe(_SECRET_BYTES)
        self._sockets: list[socket.socket] = []
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ending: asyncio.Event | None = None
        self._ready = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def origin(self) -> str:
        """The server without its secret, as a browser names it."""
        return f"http://{HOST}:{self._sockets[0].getsockname()[1]}"

    @property
    def url(self) -> str:
        """The whole address; who has it may look."""
        return f"{self.origin}/{self._secret}/"

    @property
    def watching(self) -> int:
        """How many viewers are connected."""
        return len(self._viewers)

    def start(self) -> None:
        """Take a free port and begin to answer; returns when it does.

        Raises
        ------
        ViewerError
            If there is no port, or the viewer's files are missing.
        """
        files = page_files()
        try:
            self._sockets = bind_sockets(0, HOST, family=socket.AF_INET)
        except OSError as error:
            raise ViewerError(
                message(
                    "engine",
                    "the 3-D view cannot listen on {host}: {strerror}; a firewall or a limit of "
                    "open files may forbid it",
                ).fill(host=HOST, strerror=reason_of(error))
            ) from error
        application = Application(
            [
                (r"/[^/]+/socket", SceneSocket),
                (r"/[^/]+/(.*)", FileHandler),
                (r"(.*)", FileHandler),
            ],
            origin=self.origin,
            secret=self._secret,
            files=files,
            viewers=self._viewers,
            log_function=lambda handler: None,  # its lines would hold the secret
            websocket_ping_interval=_PING_S,
            websocket_max_message_size=_SAID_BYTES,
        )
        self._thread = threading.Thread(
            target=self._run, args=(application,), name="3-D view", daemon=True
        )
        self._thread.start()
        self._ready.wait()

    def changed(self) -> None:
        """Send changes of the scene to viewers; any thread, never waits."""
        if self._loop is not None:
            self._call(self._viewers.tell)

    def close(self) -> bool:
        """Release all viewers and end the thread; safe to call twice. Return whether it ended."""
        if self._thread is None:
            return True
        ending = self._ending
        if ending is not None:
            self._call(ending.set)
        self._thread.join(_ENDING_S)
        return not self._thread.is_alive()

    def _call(self, action: Callable[[], None]) -> None:
        assert self._loop is not None
        try:
            self._loop.call_soon_threadsafe(action)
        except RuntimeError:  # the loop has just ended
            _LOG.debug("the 3-D view has ended")

    def _run(self, application: Application) -> None:
        with asyncio.Runner() as runner:
            runner.run(self._serve(application))

    async def _serve(self, application: Application) -> None:
        server = HTTPServer(application, max_header_size=_HEAD_BYTES, max_body_size=_BODY_BYTES)
        server.add_sockets(self._sockets)
        self._loop, self._ending = asyncio.get_running_loop(), asyncio.Event()
        self._ready.set()
        await self._ending.wait()
        server.stop()
        self._viewers.close()
        await server.close_all_connections()
