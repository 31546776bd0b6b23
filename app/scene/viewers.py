"""The connected viewers of the scene, and the rate of updates to each."""

import asyncio
from collections.abc import Callable
from typing import Protocol

from rotemina.app.scene.scene import Command, Scene

FRAME_S = 1 / 30  # between two messages to one viewer, at least
MOST = 8  # viewers at a time


class Connection(Protocol):
    """The line to one viewer."""

    def send(self, commands: tuple[Command, ...]) -> None:
        """Hand commands on, without waiting."""

    def end(self) -> None:
        """Close the line."""


class Timing(Protocol):
    """What of an event loop a viewer needs."""

    def time(self) -> float:
        """Return the time, s."""

    def call_later(self, delay: float, callback: Callable[[], object]) -> asyncio.TimerHandle:
        """Call back after ``delay``, s."""


class Viewer:
    """One viewer: gets what is new only after it has drawn what it got before.

    However slow it is, one message at most is on its way, and what it gets next is the newest.
    A page out of sight draws nothing and so is told nothing.
    """

    def __init__(self, scene: Scene, connection: Connection, timing: Timing) -> None:
        self.connection = connection
        self._scene, self._timing = scene, timing
        self._seen = 0
        self._drawing = False
        self._next_s = 0.0
        self._timer: asyncio.TimerHandle | None = None

    def tell(self) -> None:
        """Send what is new, now or as soon as this viewer is to have it."""
        if self._drawing or self._timer is not None:
            return
        wait_s = self._next_s - self._timing.time()
        if wait_s > 0.0:
            self._timer = self._timing.call_later(wait_s, self._go_on)
            return
        changes = self._scene.changes(self._seen)
        if changes.commands:
            self._seen, self._drawing = changes.revision, True
            self._next_s = self._timing.time() + FRAME_S
            self.connection.send(changes.commands)

    def drawn(self) -> None:
        """Note that the viewer has drawn everything it received."""
        self._drawing = False
        self.tell()

    def end(self) -> None:
        """End all sending."""
        if self._timer is not None:
            self._timer.cancel()
        self._drawing = True

    def _go_on(self) -> None:
        self._timer = None
        self.tell()


class Viewers:
    """All of them; but for ``len``, to be used on the server's thread alone."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._all: set[Viewer] = set()

    def __len__(self) -> int:
        return len(self._all)

    @property
    def full(self) -> bool:
        """Whether there is no room for another one."""
        return len(self._all) >= MOST

    def join(self, connection: Connection) -> Viewer:
        """Add a viewer, and send it the whole scene."""
        viewer = Viewer(self._scene, connection, asyncio.get_running_loop())
        self._all.add(viewer)
        viewer.tell()
        return viewer

    def leave(self, viewer: Viewer) -> None:
        """Forget a viewer."""
        viewer.end()
        self._all.discard(viewer)

    def tell(self) -> None:
        """Send the changes to all viewers."""
        for viewer in tuple(self._all):
            viewer.tell()

    def close(self) -> None:
        """Close every line."""
        for viewer in tuple(self._all):
            viewer.connection.end()
