"""Events of a recording, described for the operator, without Qt."""

import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.recording import RecordedEvent


class EventSeverity(StrEnum):
    """Importance of an event for the investigation of an incident."""

    GRAVE = "grave"
    WARNING = "warning"
    REMARK = "remark"
    DETAIL = "detail"


@dataclass(frozen=True, slots=True)
class TimelineEvent:
    """An event of a recording; ``at_s`` is the time since the start of the recording."""

    at_s: float
    word: str
    text: str
    severity: EventSeverity


_EVENT_WORDS = {
    "fault": ("Fault", EventSeverity.GRAVE),
    "stop": ("Stop", EventSeverity.WARNING),
    "refused": ("Refused", EventSeverity.WARNING),
    "recorder": ("Recorder", EventSeverity.WARNING),
    "note": ("Note", EventSeverity.REMARK),
    "action": ("Action", EventSeverity.REMARK),
    "playback_begin": ("Playback begins", EventSeverity.REMARK),
    "playback_end": ("Playback ends", EventSeverity.REMARK),
    "connection": ("Connection", EventSeverity.REMARK),
    "state": ("State", EventSeverity.DETAIL),
}
_WARNING_LEVELS = ("WARNING", "ERROR", "CRITICAL")


def make_timeline_events(
    events: Sequence[RecordedEvent], start_s: float
) -> tuple[TimelineEvent, ...]:
    """Describe events in words.

    Log entries that only repeat the text of a fault or refusal are left out. ``start_s`` is the
    host time at the start of the recording.
    """
    reported_texts = {event.text for event in events if event.kind in ("fault", "refused")}
    return tuple(
        _describe_event(event, start_s)
        for event in events
        if not (event.kind == "log" and event.text in reported_texts)
    )


def _describe_event(event: RecordedEvent, start_s: float) -> TimelineEvent:
    at_s = max(event.host_time_s - start_s, 0.0)
    if event.kind == "log":
        severity = EventSeverity.WARNING if _is_warning(event.details) else EventSeverity.DETAIL
        return TimelineEvent(at_s, "Log", event.text, severity)
    word, severity = _EVENT_WORDS.get(event.kind, (event.kind, EventSeverity.REMARK))
    return TimelineEvent(at_s, word, event.text, severity)


def _is_warning(details: str) -> bool:
    """Whether a log entry is a warning or worse; False if its details are damaged."""
    with suppress(ValueError):
        values = json.loads(details)
        return isinstance(values, dict) and values.get("level") in _WARNING_LEVELS
    return False
