"""Request handlers of the 3-D server; each requires the correct host, origin and secret.

The loopback address alone does not protect the server, because any web page that the operator opens
can send requests to it. Therefore:

- ``Host`` must be the host of the server. This rejects a foreign name that an attacker points to
  127.0.0.1 (DNS rebinding).
- ``Origin``, if the browser sends it, must be the origin of the server. A socket must send it.
- The first part of the path must be the secret, compared in constant time.

The application's settings hold ``origin``, ``secret``, ``files`` and ``viewers``.
"""

import json
import logging
from hmac import compare_digest
from typing import Any

from tornado.web import RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from rotemina.app.scene.scene import SceneCommand
from rotemina.app.scene.viewers import ConnectedViewers, SceneViewer

_LOG = logging.getLogger(__name__)
# The only message that a viewer may send.
_DRAWN_MESSAGE = "drawn"
# Close code of RFC 6455, 7.4.1.
_POLICY_VIOLATION_CODE = 1008
_CONTENT_SECURITY_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; connect-src {}; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)


class GuardedHandler(RequestHandler):
    """Base of the handlers; refuses clients that did not receive the address from this program."""

    needs_origin = False

    def set_default_headers(self) -> None:
        """Set headers that protect the reply against other pages and caches."""
        self.clear_header("Server")
        socket = self.settings["origin"].replace("http:", "ws:")
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Security-Policy", _CONTENT_SECURITY_POLICY.format(socket))
        self.set_header("Cross-Origin-Opener-Policy", "same-origin")
        self.set_header("Cross-Origin-Resource-Policy", "same-origin")
        self.set_header("Referrer-Policy", "no-referrer")
        self.set_header("X-Content-Type-Options", "nosniff")

    def prepare(self) -> None:
        """Admit the request, or end it with a status and no content."""
        status = self._find_refusal_status()
        if status is not None:
            self._end_request(status)

    def log_exception(self, typ: Any, value: Any, tb: Any) -> None:
        """Log a failure without the request, whose path contains the secret."""
        _LOG.error("the 3-D view failed to answer", exc_info=(typ, value, tb))

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Send only the status."""
        self.finish()

    def _end_request(self, status: int) -> None:
        self.set_status(status)
        self.finish()

    def _find_refusal_status(self) -> int | None:
        origin = self.settings["origin"]
        if self.request.headers.get_list("Host") != [origin.removeprefix("http://")]:
            return 421
        origins = self.request.headers.get_list("Origin")
        if any(value != origin for value in origins) or (self.needs_origin and not origins):
            return 403
        secret = self.request.path.removeprefix("/").split("/")[0]
        if not compare_digest(secret.encode(), self.settings["secret"].encode()):
            return 403
        return None


class PageFileHandler(GuardedHandler):
    """Handler that sends the files of the viewer."""

    def get(self, name: str) -> None:
        """Send the file with this name, or status 404."""
        file = self.settings["files"].get(name)
        if file is None:
            self._end_request(404)
            return
        self.set_header("Content-Type", file.content_type)
        self.finish(file.content)


class SceneSocket(GuardedHandler, WebSocketHandler):
    """WebSocket to one viewer, which may only report that it has drawn."""

    needs_origin = True

    def initialize(self) -> None:
        """Take the viewers from the settings."""
        self._viewers: ConnectedViewers = self.settings["viewers"]
        self._viewer: SceneViewer | None = None

    def check_origin(self, origin: str) -> bool:
        """Return whether the origin is the origin of the server."""
        return bool(origin == self.settings["origin"])

    def open(self) -> None:
        """Send the whole scene."""
        self.set_nodelay(True)
        self._viewer = self._viewers.add(self)

    def on_message(self, message: str | bytes) -> None:
        """Send the next changes after a drawn frame; any other message closes the connection."""
        if message == _DRAWN_MESSAGE and self._viewer is not None:
            self._viewer.on_drawn()
        else:
            self.close(_POLICY_VIOLATION_CODE)

    def on_close(self) -> None:
        """Remove the viewer."""
        if self._viewer is not None:
            self._viewers.remove(self._viewer)

    def send(self, commands: tuple[SceneCommand, ...]) -> None:
        """Send commands in one message, which the page draws in one frame."""
        try:
            self.write_message(json.dumps(commands, allow_nan=False, separators=(",", ":")))
        except WebSocketClosedError:
            self.on_close()

    def end(self) -> None:
        """Close the connection."""
        self.close()

    def _find_refusal_status(self) -> int | None:
        return super()._find_refusal_status() or (503 if self._viewers.is_full else None)
