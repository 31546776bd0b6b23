"""Events of a recording in words."""

import json

from rotemina.app.motion.recording import RecordedEvent
from rotemina.app.records import (
    EventSeverity,
    TimelineEvent,
    make_timeline_events,
)


def make_event(at_s, kind, text, **details):
    return RecordedEvent(at_s, kind, text, json.dumps(details))


def test_events_have_a_severity():
    events = make_timeline_events(
        [
            make_event(10.0, "state", "ready"),
            make_event(10.5, "fault", "cable pulled"),
            make_event(11.0, "log", "looked", level="INFO"),
            make_event(11.5, "log", "slow disk", level="WARNING"),
            make_event(12.0, "frames", "of a later program"),
        ],
        10.0,
    )
    assert events == (
        TimelineEvent(0.0, "State", "ready", EventSeverity.DETAIL),
        TimelineEvent(0.5, "Fault", "cable pulled", EventSeverity.GRAVE),
        TimelineEvent(1.0, "Log", "looked", EventSeverity.DETAIL),
        TimelineEvent(1.5, "Log", "slow disk", EventSeverity.WARNING),
        TimelineEvent(2.0, "frames", "of a later program", EventSeverity.REMARK),
    )


def test_a_refusal_repeated_in_the_log_is_listed_once():
    events = make_timeline_events(
        [make_event(1.0, "refused", "no"), make_event(1.001, "log", "no", level="WARNING")], 1.0
    )
    assert [event.word for event in events] == ["Refused"]


def test_an_event_before_the_start_is_placed_at_the_start():
    assert make_timeline_events([make_event(0.9, "stop", "stop")], 1.0)[0].at_s == 0.0
