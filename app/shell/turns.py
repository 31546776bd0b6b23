"""Turns in which texts are written anew: a share of them in each frame, as nobody reads faster."""

from collections.abc import Iterator
from contextlib import contextmanager

from rotemina.app.motion.state import SessionState

TURNS = 3  # frames, of 30 a second, between two looks of the same


class Turns:
    """Tells who looks at the machine in the present frame.

    What the machine may do next is shown in its first frame by everyone. Outside of frames, such
    as when a panel is asked to look by hand, everybody looks.
    """

    def __init__(self) -> None:
        self._frames = 0
        self._seen: tuple[object, ...] | None = None
        self._turn: int | None = None

    def begin(self, state: SessionState) -> None:
        """Begin a frame."""
        self._frames += 1
        seen = state.activity, state.connection, state.locked is None, state.position_known
        self._turn = self._frames % TURNS if seen == self._seen else None
        self._seen = seen

    def end(self) -> None:
        """End it."""
        self._turn = None

    @contextmanager
    def suspended(self) -> Iterator[None]:
        """Let everybody look while this lasts, also in the middle of a frame."""
        turn, self._turn = self._turn, None
        try:
            yield
        finally:
            self._turn = turn

    def due(self, number: int) -> bool:
        """Return whether one of this number looks now."""
        return self._turn is None or number % TURNS == self._turn
