"""Server of the scene, which is started in the background and stopped with the window."""

import threading
from typing import TYPE_CHECKING

from rotemina.app.scene import SceneCommandStore

if TYPE_CHECKING:
    from rotemina.app.scene import ViewServer


class SceneServer:
    """Owner of the scene server, which runs from the first :meth:`start` until :meth:`close`.

    There is at most one :class:`ViewServer`. The methods may be called from any thread.
    """

    def __init__(self, scene: SceneCommandStore) -> None:
        self.server: ViewServer | None = None
        self._scene = scene
        self._is_closed = False
        self._lock = threading.Lock()

    def start(self) -> None:
        """Import and start the server, which takes a moment. Does nothing after :meth:`close`.

        Raises
        ------
        ViewerError
            If the server cannot be started.
        """
        # Tornado is imported only when it is needed.
        from rotemina.app.scene import ViewServer

        with self._lock:
            if self.server is None and not self._is_closed:
                server = ViewServer(self._scene)
                server.start()
                self.server = server

    def close(self) -> None:
        """Stop the server permanently."""
        with self._lock:
            self._is_closed = True
            if self.server is not None:
                self.server.close()
