"""Faults, lost links, refusals and recoveries, with their times.

Entries are kept and written in English, and shown in the language of the window.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from rotemina.app.motion.state import (
    Alarmed,
    CommandRefused,
    Connection,
    Event,
    Faulted,
    Phase,
    SessionState,
    StateChanged,
)
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.faults import mark, tr

MOST = 500  # entries; the oldest give way
_TURNS = 2  # a link that is lost and found again and again takes no more than two rows


class Kind(StrEnum):
    """The kind of an entry, as stored in files."""

    FAULT = mark("fault")
    LOST = mark("lost")
    FAILED = mark("not connected")
    REFUSED = mark("refused")
    RECOVERED = mark("recovered")
    STOP = mark("stop and lock")
    INJECTED = mark("injected")
    NOTE = mark("note")


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that happened; ``count`` times in a row, ``at`` the latest time.

    Later entries have greater numbers. ``about`` stands in the text where it says ``{about}``.
    """

    number: int
    at: datetime
    kind: Kind
    text: str
    about: str = ""
    count: int = 1

    @property
    def time(self) -> str:
        """The host's clock as local time."""
        return f"{self.at:%Y-%m-%d %H:%M:%S}.{self.at.microsecond // 1000:03d}"

    @property
    def told(self) -> str:
        """The text, with how many times it came."""
        text = _filled(self.text, self.about)
        return text if self.count == 1 else f"{text} ({self.count} times)"

    @property
    def shown(self) -> str:
        """The same in the language of the window."""
        text = _filled(_said(self.text), _said(self.about))
        if self.count == 1:
            return text
        return tr("{text} ({n} times)").format(text=text, n=self.count)

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
        """The kept entries."""
        return tuple(self._entries)

    def clear(self) -> None:
        """Forget all entries."""
        self._entries.clear()

    def add(self, at: datetime, kind: Kind, text: str, about: str = "") -> None:
        """Add an entry; what comes again, or comes and goes again, is counted instead."""
        count = 1
        for place in range(len(self._entries) - 1, max(len(self._entries) - _TURNS, 0) - 1, -1):
            old = self._entries[place]
            if (old.kind, old.text, old.about) == (kind, text, about):
                count += self._entries.pop(place).count
                break
        self._number += 1
        self._entries.append(Entry(self._number, at, kind, text, about, count))
        del self._entries[: -self._most]

    def note_event(self, at: datetime, event: Event) -> None:
        """Add what a session's event tells of, if it is worth an entry."""
        if isinstance(event, StateChanged):
            self._note_state(at, event.state)
        elif isinstance(event, CommandRefused):
            self.add(at, Kind.REFUSED, event.message)
        elif isinstance(event, Alarmed):
            self.add(at, Kind.NOTE, event.message)
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
            text = mark("released")
            if latched is not None:
                text = mark("{about} locked")
            self.add(at, Kind.STOP, text, latched or "")

    def _note_state(self, at: datetime, state: SessionState) -> None:
        before, self._state = self._state, state
        connected = state.connection is Connection.CONNECTED
        was = before.connection is Connection.CONNECTED
        if connected and not was:
            self.add(at, Kind.RECOVERED, mark("connected"))
        elif was and state.connection is Connection.DISCONNECTED:
            self.add(at, Kind.NOTE, mark("disconnected"))
        elif connected:
            self._note_soundness(at, before, state)
        self._was_connected = was

    def _note_soundness(self, at: datetime, before: SessionState, state: SessionState) -> None:
        lost, was_lost = state.phase is Phase.SHORT_LOSS, before.phase is Phase.SHORT_LOSS
        if lost and not was_lost:
            self.add(at, Kind.LOST, mark("the device is silent for a short time"))
        elif was_lost and not lost:
            self.add(at, Kind.RECOVERED, mark("the device answers again"))
        if before.fault is not None and state.fault is None:
            self.add(at, Kind.RECOVERED, mark("cleared: {about}"), before.fault)


def _said(text: str) -> str:
    """Return what is kept, or the engine says, in the language of the window."""
    told = tr(text) if text else ""
    return told if told != text else spoken(text)


def _filled(text: str, about: str) -> str:
    """Return a text about something; what a device says may hold braces, and stays."""
    return text.replace("{about}", about) if about else text


def as_text(entries: Iterable[Entry]) -> str:
    """Return entries as lines of time, kind and text, with tabs between."""
    return "".join(f"{entry}\n" for entry in entries)
