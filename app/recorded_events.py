"""Events of a recording in the operator's words. Free of Qt."""

import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

from rotemina.app.motion.recording.backlog import RecordedEvent


class Severity(StrEnum):
    """How much an event matters to someone who looks for what happened."""

    GRAVE = "grave"
    WARNING = "warning"
    REMARK = "remark"
    DETAIL = "detail"


@dataclass(frozen=True, slots=True)
class TimelineEvent:
    """An event at a time of the recording, s from its begin."""

    at_s: float
    word: str
    text: str
    weight: Severity


_KINDS = {
    "fault": ("Fault", Severity.GRAVE),
    "stop": ("Stop", Severity.WARNING),
    "refused": ("Refused", Severity.WARNING),
    "recorder": ("Recorder", Severity.WARNING),
    "note": ("Note", Severity.REMARK),
    "action": ("Action", Severity.REMARK),
    "playback_begin": ("Playback begins", Severity.REMARK),
    "playback_end": ("Playback ends", Severity.REMARK),
    "connection": ("Connection", Severity.REMARK),
    "state": ("State", Severity.DETAIL),
}
_COMPLAINTS = ("WARNING", "ERROR", "CRITICAL")


def timeline_events(events: Sequence[RecordedEvent], began_s: float) -> tuple[TimelineEvent, ...]:
    """Return events in words; what is logged of a fault or refusal beside it is left out."""
    said = {event.text for event in events if event.kind in ("fault", "refused")}
    return tuple(
        _in_words(event, began_s)
        for event in events
        if not (event.kind == "log" and event.text in said)
    )


def _in_words(event: RecordedEvent, began_s: float) -> TimelineEvent:
    at_s = max(event.host_time_s - began_s, 0.0)
    if event.kind == "log":
        weight = Severity.WARNING if _complains(event.details) else Severity.DETAIL
        return TimelineEvent(at_s, "Log", event.text, weight)
    word, weight = _KINDS.get(event.kind, (event.kind, Severity.REMARK))
    return TimelineEvent(at_s, word, event.text, weight)


def _complains(details: str) -> bool:
    """Whether details of a log entry say so; those that were spoilt on the disk do not."""
    with suppress(ValueError):
        found = json.loads(details)
        return isinstance(found, dict) and found.get("level") in _COMPLAINTS
    return False
