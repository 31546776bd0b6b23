"""Staggered refresh: each frame updates only some of the texts, because nobody reads faster."""

from collections.abc import Iterator
from contextlib import contextmanager

from rotemina.app.motion.state import SessionState

# Each text is refreshed in every third of the 30 frames a second.
TURN_COUNT = 3


class StaggeredRefresh:
    """Schedule that refreshes only a third of the texts in each frame.

    All are refreshed in the first frame after a change of the state that determines what the
    machine may do next. Outside of frames, such as when a panel is refreshed by a direct call, all
    are refreshed.
    """

    def __init__(self) -> None:
        self._frame_count = 0
        self._last_state: tuple[object, ...] | None = None
        self._turn: int | None = None

    def begin_frame(self, state: SessionState) -> None:
        """Begin a frame."""
        self._frame_count += 1
        current_state = (
            state.activity,
            state.connection,
            state.lock_reason is None,
            state.position_known,
        )
        self._turn = self._frame_count % TURN_COUNT if current_state == self._last_state else None
        self._last_state = current_state

    def end_frame(self) -> None:
        """End a frame."""
        self._turn = None

    @contextmanager
    def suspend(self) -> Iterator[None]:
        """Refresh everything in this context, even in the middle of a frame."""
        turn, self._turn = self._turn, None
        try:
            yield
        finally:
            self._turn = turn

    def is_due(self, number: int) -> bool:
        """Return whether the text of this number is refreshed now."""
        return self._turn is None or number % TURN_COUNT == self._turn
