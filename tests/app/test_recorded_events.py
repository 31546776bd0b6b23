"""What happened in a recording, in words."""

import json

from rotemina.app.motion.recording.backlog import RecordedEvent
from rotemina.app.recorded_events import Severity, TimelineEvent, timeline_events


def event(at_s, kind, text, **details):
    return RecordedEvent(at_s, kind, text, json.dumps(details))


def test_what_matters_is_told_from_details():
    told = timeline_events(
        [
            event(10.0, "state", "ready"),
            event(10.5, "fault", "cable pulled"),
            event(11.0, "log", "looked", level="INFO"),
            event(11.5, "log", "slow disk", level="WARNING"),
            event(12.0, "frames", "of a later program"),
        ],
        10.0,
    )
    assert told == (
        TimelineEvent(0.0, "State", "ready", Severity.DETAIL),
        TimelineEvent(0.5, "Fault", "cable pulled", Severity.GRAVE),
        TimelineEvent(1.0, "Log", "looked", Severity.DETAIL),
        TimelineEvent(1.5, "Log", "slow disk", Severity.WARNING),
        TimelineEvent(2.0, "frames", "of a later program", Severity.REMARK),
    )


def test_what_the_log_repeats_of_a_refusal_is_said_once():
    told = timeline_events(
        [event(1.0, "refused", "no"), event(1.001, "log", "no", level="WARNING")], 1.0
    )
    assert [one.word for one in told] == ["Refused"]


def test_what_happened_before_the_begin_counts_as_at_the_begin():
    assert timeline_events([event(0.9, "stop", "stop")], 1.0)[0].at_s == 0.0
