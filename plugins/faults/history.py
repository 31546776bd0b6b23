"""Faults, lost links, refusals and recoveries, each with its time. Free of Qt."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from rotemina.app.motion.state import (
    CommandRefused,
    Connection,
    Event,
    Faulted,
    Phase,
    SessionState,
    StateChanged,
)

MOST = 500  # entries; the oldest give way
_TURNS = 2  # a link that is lost and found again and again takes no more than two rows


class Kind(StrEnum):
    """What an entry tells of."""

    FAULT = "fault"
    LOST = "lost"
    FAILED = "not connected"
    REFUSED = "refused"
    RECOVERED = "recovered"
    STOP = "emergency stop"
    INJECTED = "injected"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that happened; ``count`` times in a row, ``at`` the latest time.

    Later entries have greater numbers.
    """

    number: int
    at: datetime
    kind: Kind
    text: str
    count: int = 1

    @property
    def time(self) -> str:
        """The host's clock as local time."""
        return f"{self.at:%Y-%m-%d %H:%M:%S}.{self.at.microsecond // 1000:03d}"

    @property
    def told(self) -> str:
        """The text, with how many times it came."""
        return self.text if self.count == 1 else f"{self.text} ({self.count} times)"

    def __str__(self) -> str:
        return f"{self.time}{self.at:%z}\t{self.kind}\t{' '.join(self.told.split())}"


class History:
    """The latest entries, oldest first."""

    def __init__(self, most: int = MOST) -> None:
        self._most = most
        self._number = 0
        self._entries: list[Entry] = []
        self._state = SessionState()
        self._was_connected = False
        self._latched: str | None = None

    @property
    def entries(self) -> tuple[Entry, ...]:
        """What is kept."""
        return tuple(self._entries)

    def clear(self) -> None:
        """Forget all entries."""
        self._entries.clear()

    def add(self, at: datetime, kind: Kind, text: str) -> None:
        """Add an entry; what comes again, or comes and goes again, is counted instead."""
        count = 1
        for place in range(len(self._entries) - 1, max(len(self._entries) - _TURNS, 0) - 1, -1):
            old = self._entries[place]
            if (old.kind, old.text) == (kind, text):
                count += self._entries.pop(place).count
                break
        self._number += 1
        self._entries.append(Entry(self._number, at, kind, text, count))
        del self._entries[: -self._most]

    def note_event(self, at: datetime, event: Event) -> None:
        """Add what a session's event tells of, if it is worth an entry."""
        if isinstance(event, StateChanged):
            self._note_state(at, event.state)
        elif isinstance(event, CommandRefused):
            self.add(at, Kind.REFUSED, event.message)
        elif isinstance(event, Faulted):
            failed = self._state.connection is Connection.FAILED
            kind = Kind.FAULT
            if failed:
                kind = Kind.LOST if self._was_connected else Kind.FAILED
            self.add(at, kind, event.message)

    def note_latch(self, at: datetime, latched: str | None) -> None:
        """Add that the emergency stop was latched or released, if it was."""
        if latched != self._latched:
            self._latched = latched
            self.add(at, Kind.STOP, "released" if latched is None else f"{latched} latched")

    def _note_state(self, at: datetime, state: SessionState) -> None:
        before, self._state = self._state, state
        connected = state.connection is Connection.CONNECTED
        was = before.connection is Connection.CONNECTED
        if connected and not was:
            self.add(at, Kind.RECOVERED, "connected")
        elif was and state.connection is Connection.DISCONNECTED:
            self.add(at, Kind.NOTE, "disconnected")
        elif connected:
            self._note_soundness(at, before, state)
        self._was_connected = was

    def _note_soundness(self, at: datetime, before: SessionState, state: SessionState) -> None:
        lost, was_lost = state.phase is Phase.SHORT_LOSS, before.phase is Phase.SHORT_LOSS
        if lost and not was_lost:
            self.add(at, Kind.LOST, "the device says nothing for a short while")
        elif was_lost and not lost:
            self.add(at, Kind.RECOVERED, "the device answers again")
        if before.fault is not None and state.fault is None:
            self.add(at, Kind.RECOVERED, f"cleared: {before.fault}")


def as_text(entries: Iterable[Entry]) -> str:
    """Return entries as lines of time, kind and text, with tabs between."""
    return "".join(f"{entry}\n" for entry in entries)
