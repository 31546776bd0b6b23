"""Log of the boards for tests and the user: events, and the latencies of stops."""

from collections import deque
from dataclasses import dataclass, field

_MAX_NOTES = 1000


@dataclass(frozen=True, slots=True)
class BoardEvent:
    """Event of a board, with its simulated time, s."""

    at_s: float
    text: str


@dataclass(frozen=True, slots=True)
class StopNote:
    """Stop of a board: simulated times at which it was received and the axes came to rest, s."""

    board: int
    received_s: float
    rest_s: float


@dataclass(slots=True)
class BoardEventLog:
    """Log of the latest events and stops."""

    events: deque[BoardEvent] = field(default_factory=lambda: deque(maxlen=_MAX_NOTES))
    stops: deque[StopNote] = field(default_factory=lambda: deque(maxlen=_MAX_NOTES))

    def add_event(self, at_s: float, text: str) -> None:
        """Add an event."""
        self.events.append(BoardEvent(at_s, text))

    def add_stop(self, note: StopNote) -> None:
        """Add a stop that has been executed."""
        self.stops.append(note)
        rest_ms = 1e3 * (note.rest_s - note.received_s)
        self.add_event(
            note.rest_s, f"board {note.board}: stop heard, axes at rest {rest_ms:.2f} ms later"
        )

    def take_events(self) -> list[BoardEvent]:
        """Return the events since the last call."""
        events = list(self.events)
        self.events.clear()
        return events
