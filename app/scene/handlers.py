"""Request handlers of the 3-D server; each requires the right host, origin and secret.

Loopback alone keeps nobody out: any web page that the operator opens may send requests there. So

- ``Host`` must be the server's own: a name that an attacker points to 127.0.0.1 (DNS rebinding) is
  another;
- ``Origin``, where a browser names one, must be the server's own, and a socket must name one;
- the first part of the path must be the secret, compared in constant time.

The application's settings hold ``origin``, ``secret``, ``files`` and ``viewers``.
"""

import json
import logging
from hmac import compare_digest
from typing import Any

from tornado.web import RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from rotemina.app.scene.scene import Command
from rotemina.app.scene.viewers import Viewer, Viewers

_LOG = logging.getLogger(__name__)
_DRAWN = "drawn"  # all that a viewer may say
_NOT_ALLOWED = 1008  # RFC 6455, 7.4.1
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; connect-src {}; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)


class Guarded(RequestHandler):
    """Refuses clients that did not get the address from this program."""

    needs_origin = False

    def set_default_headers(self) -> None:
        """Prevent reading, framing and guessing by other pages, and any storing."""
        self.clear_header("Server")
        socket = self.settings["origin"].replace("http:", "ws:")
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Security-Policy", _POLICY.format(socket))
        self.set_header("Cross-Origin-Opener-Policy", "same-origin")
        self.set_header("Cross-Origin-Resource-Policy", "same-origin")
        self.set_header("Referrer-Policy", "no-referrer")
        self.set_header("X-Content-Type-Options", "nosniff")

    def prepare(self) -> None:
        """Let a request pass, or end it with a bare status."""
        status = self._refusal()
        if status is not None:
            self._end(status)

    def log_exception(self, typ: Any, value: Any, tb: Any) -> None:
        """Log a failure without the request: its path holds the secret."""
        _LOG.error("the 3-D view failed to answer", exc_info=(typ, value, tb))

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Send only the status."""
        self.finish()

    def _end(self, status: int) -> None:
        self.set_status(status)
        self.finish()

    def _refusal(self) -> int | None:
        """Return the status with which the request is refused, or None."""
        origin = self.settings["origin"]
        if self.request.headers.get_list("Host") != [origin.removeprefix("http://")]:
            return 421
        origins = self.request.headers.get_list("Origin")
        if any(each != origin for each in origins) or (self.needs_origin and not origins):
            return 403
        given = self.request.path.removeprefix("/").split("/")[0]
        if not compare_digest(given.encode(), self.settings["secret"].encode()):
            return 403
        return None


class FileHandler(Guarded):
    """Sends the viewer's few files."""

    def get(self, name: str) -> None:
        """Send one of them; there is nothing else."""
        file = self.settings["files"].get(name)
        if file is None:
            self._end(404)
            return
        self.set_header("Content-Type", file.kind)
        self.finish(file.content)


class SceneSocket(Guarded, WebSocketHandler):
    """The line to one viewer; all that it may say is that it has drawn."""

    needs_origin = True

    def initialize(self) -> None:
        """Take the viewers over from the settings."""
        self._viewers: Viewers = self.settings["viewers"]
        self._viewer: Viewer | None = None

    def check_origin(self, origin: str) -> bool:
        """Ask what every request is asked."""
        return bool(origin == self.settings["origin"])

    def open(self) -> None:
        """Send the whole scene."""
        self.set_nodelay(True)
        self._viewer = self._viewers.join(self)

    def on_message(self, message: str | bytes) -> None:
        """Continue after a drawn frame; anything else ends the connection."""
        if message == _DRAWN and self._viewer is not None:
            self._viewer.drawn()
        else:
            self.close(_NOT_ALLOWED)

    def on_close(self) -> None:
        """Forget the viewer."""
        if self._viewer is not None:
            self._viewers.leave(self._viewer)

    def send(self, commands: tuple[Command, ...]) -> None:
        """Send commands in one message, which the page draws in one frame."""
        try:
            self.write_message(json.dumps(commands, allow_nan=False, separators=(",", ":")))
        except WebSocketClosedError:
            self.on_close()

    def end(self) -> None:
        """Close the line."""
        self.close()

    def _refusal(self) -> int | None:
        return super()._refusal() or (503 if self._viewers.full else None)
