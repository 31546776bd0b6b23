"""The connected viewers of the scene, and the rate at which each one is updated."""

import asyncio
from collections.abc import Callable
from typing import Protocol

from rotemina.app.scene.scene import SceneCommand, SceneCommandStore

MIN_MESSAGE_INTERVAL_S = 1 / 30
MAX_VIEWERS = 8


class ViewerConnection(Protocol):
    """The connection to one viewer."""

    def send(self, commands: tuple[SceneCommand, ...]) -> None:
        """Send commands without waiting."""

    def end(self) -> None:
        """Close the connection."""


class EventLoopTimer(Protocol):
    """The part of an event loop that a viewer needs."""

    def time(self) -> float:
        """Return the time of the loop, s."""

    def call_later(self, delay: float, callback: Callable[[], object]) -> asyncio.TimerHandle:
        """Call ``callback`` after ``delay``, s."""


class SceneViewer:
    """One viewer, which receives a message only after it has drawn the previous one.

    A slow viewer therefore has at most one pending message, and the next message contains the
    newest state. A hidden page draws nothing, and so receives nothing.
    """

    def __init__(
        self, scene: SceneCommandStore, connection: ViewerConnection, timing: EventLoopTimer
    ) -> None:
        self.connection = connection
        self._scene, self._loop = scene, timing
        self._sent_revision = 0
        self._is_drawing = False
        self._next_message_s = 0.0
        self._timer: asyncio.TimerHandle | None = None

    def send_changes(self) -> None:
        """Send the changes of the scene now, or as soon as the viewer may receive a message."""
        if self._is_drawing or self._timer is not None:
            return
        wait_s = self._next_message_s - self._loop.time()
        if wait_s > 0.0:
            self._timer = self._loop.call_later(wait_s, self._on_timer)
            return
        changes = self._scene.get_changes(self._sent_revision)
        if changes.commands:
            self._sent_revision, self._is_drawing = changes.revision, True
            self._next_message_s = self._loop.time() + MIN_MESSAGE_INTERVAL_S
            self.connection.send(changes.commands)

    def on_drawn(self) -> None:
        """Register that the viewer has drawn the last message, and send further changes."""
        self._is_drawing = False
        self.send_changes()

    def end(self) -> None:
        """Stop sending to this viewer."""
        if self._timer is not None:
            self._timer.cancel()
        self._is_drawing = True

    def _on_timer(self) -> None:
        self._timer = None
        self.send_changes()


class ConnectedViewers:
    """All connected viewers; outside the server's thread only ``len`` may be used."""

    def __init__(self, scene: SceneCommandStore) -> None:
        self._scene = scene
        self._viewers: set[SceneViewer] = set()

    def __len__(self) -> int:
        return len(self._viewers)

    @property
    def is_full(self) -> bool:
        """Whether the largest number of viewers is connected."""
        return len(self._viewers) >= MAX_VIEWERS

    def add(self, connection: ViewerConnection) -> SceneViewer:
        """Add a viewer, and send it the whole scene."""
        viewer = SceneViewer(self._scene, connection, asyncio.get_running_loop())
        self._viewers.add(viewer)
        viewer.send_changes()
        return viewer

    def remove(self, viewer: SceneViewer) -> None:
        """Remove a viewer."""
        viewer.end()
        self._viewers.discard(viewer)

    def send_changes(self) -> None:
        """Send the changes to all viewers."""
        for viewer in tuple(self._viewers):
            viewer.send_changes()

    def close(self) -> None:
        """Close every connection."""
        for viewer in tuple(self._viewers):
            viewer.connection.end()
