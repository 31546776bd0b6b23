"""Notes about the boards for observers: events, and the latency of stops."""

from collections import deque
from dataclasses import dataclass, field

_KEPT = 1000


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened: time of the process, s, and words."""

    at_s: float
    text: str


@dataclass(frozen=True, slots=True)
class StopNote:
    """A stop: when a board heard it, and from when on its commands were at rest, s."""

    board: int
    heard_s: float
    rest_s: float


@dataclass(slots=True)
class Notes:
    """The latest events and stops."""

    events: deque[Event] = field(default_factory=lambda: deque(maxlen=_KEPT))
    stops: deque[StopNote] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def say(self, at_s: float, text: str) -> None:
        """Note an event."""
        self.events.append(Event(at_s, text))

    def stopped(self, note: StopNote) -> None:
        """Note that a stop has been carried out."""
        self.stops.append(note)
        rest_ms = 1e3 * (note.rest_s - note.heard_s)
        self.say(
            note.rest_s, f"board {note.board}: stop heard, axes at rest {rest_ms:.2f} ms later"
        )

    def taken(self) -> list[Event]:
        """Return the events since the last call."""
        events = list(self.events)
        self.events.clear()
        return events
