"""The server of the panel's scene: started in the background, ended with the window."""

import threading
from typing import TYPE_CHECKING

from rotemina.app.scene.scene import Scene

if TYPE_CHECKING:
    from rotemina.app.scene.server import ViewServer


class Serving:
    """One server at most, from the first :meth:`start` until :meth:`close`; any thread."""

    def __init__(self, scene: Scene) -> None:
        self.server: ViewServer | None = None
        self._scene = scene
        self._closed = False
        self._lock = threading.Lock()

    def start(self) -> None:
        """Load and start the server, which takes a moment; nothing happens once closed.

        Raises
        ------
        ViewerError
            If it cannot be served.
        """
        from rotemina.app.scene.server import ViewServer  # tornado is loaded when first needed

        with self._lock:
            if self.server is None and not self._closed:
                server = ViewServer(self._scene)
                server.start()
                self.server = server

    def close(self) -> None:
        """Stop the server permanently."""
        with self._lock:
            self._closed = True
            if self.server is not None:
                self.server.close()
