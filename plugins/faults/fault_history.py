"""History of faults, lost links, refusals and recoveries, with their times.

Entries are stored and saved in English, and shown in the UI language.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum

from rotemina.app.language import translate_message
from rotemina.app.motion.state import (
    AlarmRaised,
    CommandRefused,
    ConnectionState,
    FaultRaised,
    SessionEvent,
    SessionPhase,
    SessionState,
    StateChanged,
)
from rotemina.plugins.faults import mark, tr

# Older entries are dropped.
MAX_ENTRIES = 500
# A new entry is merged with an equal one among this many latest entries. With 2, a link that is
# lost and recovered many times takes up only two rows.
_REPEAT_SEARCH_DEPTH = 2


class FaultKind(StrEnum):
    """Kind of an entry. The value is written to files."""

    FAULT = mark("fault")
    LOST = mark("lost")
    CONNECTION_FAILED = mark("not connected")
    REFUSED = mark("refused")
    RECOVERED = mark("recovered")
    STOP = mark("stop and lock")
    INJECTED = mark("injected")
    NOTE = mark("note")


@dataclass(frozen=True, slots=True)
class FaultEntry:
    """Entry of the fault history.

    Attributes
    ----------
    number : int
        Serial number, which increases from entry to entry.
    at : datetime
        Time of the latest occurrence.
    kind : FaultKind
    text : str
        What happened, in English.
    about : str
        The subject of the text, such as the fault that was cleared. It replaces ``{about}`` in
        ``text``.
    count : int
        Number of occurrences.
    """

    number: int
    at: datetime
    kind: FaultKind
    text: str
    about: str = ""
    count: int = 1

    @property
    def time(self) -> str:
        """The local time of the entry as text."""
        return f"{self.at:%Y-%m-%d %H:%M:%S}.{self.at.microsecond // 1000:03d}"

    @property
    def english_text(self) -> str:
        """The English text with the number of occurrences."""
        text = _fill_text(self.text, self.about)
        return text if self.count == 1 else f"{text} ({self.count} times)"

    @property
    def shown_text(self) -> str:
        """The text with the number of occurrences, in the UI language."""
        text = _fill_text(_translate_text(self.text), _translate_text(self.about))
        if self.count == 1:
            return text
        return tr("{text} ({n} times)").format(text=text, n=self.count)

    def __str__(self) -> str:
        return f"{self.time}{self.at:%z}\t{self.kind}\t{' '.join(self.english_text.split())}"


class FaultHistory:
    """History of the latest entries, oldest first."""

    def __init__(self, max_entries: int = MAX_ENTRIES) -> None:
        self._max_entries = max_entries
        self._number = 0
        self._entries: list[FaultEntry] = []
        self._state = SessionState()
        # Whether the device was connected before the latest change of the state. The session
        # reports a changed state first, and the fault that caused it afterwards.
        self._was_connected_before_change = False
        self._latch_reason: str | None = None

    @property
    def entries(self) -> tuple[FaultEntry, ...]:
        """The entries, oldest first."""
        return tuple(self._entries)

    def clear(self) -> None:
        """Remove all entries."""
        self._entries.clear()

    def add(self, at: datetime, kind: FaultKind, text: str, about: str = "") -> None:
        """Add an entry. If it repeats a recent entry, replace that entry and increase the count."""
        count = 1
        for index in range(
            len(self._entries) - 1, max(len(self._entries) - _REPEAT_SEARCH_DEPTH, 0) - 1, -1
        ):
            old = self._entries[index]
            if (old.kind, old.text, old.about) == (kind, text, about):
                count += self._entries.pop(index).count
                break
        self._number += 1
        self._entries.append(FaultEntry(self._number, at, kind, text, about, count))
        del self._entries[: -self._max_entries]

    def record_event(self, at: datetime, event: SessionEvent) -> None:
        """Add an entry for an event of the session if it belongs in the history."""
        if isinstance(event, StateChanged):
            self._record_state(at, event.state)
        elif isinstance(event, CommandRefused):
            self.add(at, FaultKind.REFUSED, event.message)
        elif isinstance(event, AlarmRaised):
            self.add(at, FaultKind.NOTE, event.message)
        elif isinstance(event, FaultRaised):
            kind = FaultKind.FAULT
            if self._state.connection is ConnectionState.FAILED:
                kind = (
                    FaultKind.LOST
                    if self._was_connected_before_change
                    else FaultKind.CONNECTION_FAILED
                )
            self.add(at, kind, event.message)

    def record_latch(self, at: datetime, latch_reason: str | None) -> None:
        """Add an entry if the emergency stop has been latched or released.

        ``latch_reason`` is the reason for the latched stop; None if it is released.
        """
        if latch_reason != self._latch_reason:
            self._latch_reason = latch_reason
            text = mark("released")
            if latch_reason is not None:
                text = mark("{about} locked")
            self.add(at, FaultKind.STOP, text, latch_reason or "")

    def _record_state(self, at: datetime, state: SessionState) -> None:
        previous, self._state = self._state, state
        is_connected = state.connection is ConnectionState.CONNECTED
        was_connected = previous.connection is ConnectionState.CONNECTED
        if is_connected and not was_connected:
            self.add(at, FaultKind.RECOVERED, mark("connected"))
        elif was_connected and state.connection is ConnectionState.DISCONNECTED:
            self.add(at, FaultKind.NOTE, mark("disconnected"))
        elif is_connected:
            self._record_link_and_fault(at, previous, state)
        self._was_connected_before_change = was_connected

    def _record_link_and_fault(
        self, at: datetime, previous: SessionState, state: SessionState
    ) -> None:
        is_link_lost = state.phase is SessionPhase.SHORT_LOSS
        was_link_lost = previous.phase is SessionPhase.SHORT_LOSS
        if is_link_lost and not was_link_lost:
            self.add(at, FaultKind.LOST, mark("the device has briefly stopped responding"))
        elif was_link_lost and not is_link_lost:
            self.add(at, FaultKind.RECOVERED, mark("the device answers again"))
        if previous.fault is not None and state.fault is None:
            self.add(at, FaultKind.RECOVERED, mark("cleared: {about}"), previous.fault)


def _translate_text(text: str) -> str:
    """Translate a text of this plugin, or otherwise of the engine."""
    translation = tr(text) if text else ""
    return translation if translation != text else translate_message(text)


def _fill_text(text: str, about: str) -> str:
    """Insert ``about`` in a text.

    ``str.format`` is not used, because texts from a device may contain other braces.
    """
    return text.replace("{about}", about) if about else text


def format_entries(entries: Iterable[FaultEntry]) -> str:
    """Return entries as lines of time, kind and text, separated by tabs."""
    return "".join(f"{entry}\n" for entry in entries)
