"""The event journal: moves with start and end, stops, locks, playbacks and recordings."""

from dataclasses import replace
from datetime import datetime

import pytest

from rotemina.app.motion.device import OPERATOR, PLAYBACK
from rotemina.app.motion.penetration import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import (
    STOP_AND_LOCK_REASON,
    ConnectionState,
    SessionState,
    StopRequest,
)
from rotemina.app.workbench import Level, NoticeMessage
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.events.journal import EventJournal, MachineSnapshot
from rotemina.sim.robot_files import load_robot

NOON = datetime(2024, 5, 6, 12, 0, 0)
AT_REST = SessionState(
    connection=ConnectionState.CONNECTED,
    activity=DeviceState.IDLE,
    command={"x": 0.0275, "zn": 32.5e-6},
    position_known=True,
)
MOVING = replace(AT_REST, activity=DeviceState.MOVING, owners={"x": OPERATOR})


@pytest.fixture
def journal():
    return EventJournal(load_robot("rotemina"), lambda: NOON)


def record_states(journal, *states, **others):
    """Record states at intervals of 0.1 s, and return the texts of the new entries."""
    old_count = journal.count
    for index, state in enumerate(states):
        at_s = 0.1 * (old_count + index)
        snapshot_parts = {"playback": PlaybackState(), "penetration": PenetrationStatus(), **others}
        journal.record_changes(MachineSnapshot(state, at_s=at_s, **snapshot_parts))
    return [entry.text for entry in list(journal.entries)[old_count:]]


def test_each_move_is_one_entry_with_start_and_end(journal):
    end_command = {"x": 0.02751, "zn": 32.5e-6}
    under_way = replace(MOVING, command={"x": 0.027503, "zn": 32.5e-6})
    assert record_states(journal, AT_REST, MOVING, under_way) == []
    assert record_states(journal, replace(AT_REST, command=end_command), AT_REST) == [
        "X 27.5000 → 27.5100 mm",
        "X 27.5100 → 27.5000 mm",  # a move between two snapshots
    ]
    joystick_move = replace(MOVING, owners={"x": "joystick"})
    end_of_both = {"x": 0.02751, "zn": 33.5e-6}
    assert record_states(journal, joystick_move, replace(AT_REST, command=end_of_both)) == [
        "joystick: X 27.5000 → 27.5100 mm, Z nano 32.500 → 33.500 µm"
    ]


def test_a_new_connection_is_no_move_and_playbacks_are_named(journal):
    disconnected = replace(AT_REST, connection=ConnectionState.DISCONNECTED)
    at_new_position = replace(AT_REST, command={"x": 0.01, "zn": 1e-5})
    assert record_states(journal, AT_REST, disconnected, at_new_position, driver="simulator") == [
        "Disconnected",
        "Connected: simulator",
    ]
    playback_state = replace(at_new_position, activity=DeviceState.PLAYING, owners={"x": PLAYBACK})
    playing = PlaybackState(PlaybackPhase.PLAYING)
    paused = PlaybackState(PlaybackPhase.PAUSED, row=4)
    for playback, text in (
        (playing, "Playing tour"),
        (paused, "tour is paused at row 5"),
        (replace(playing, row=4), "tour resumed at row 5"),
        (PlaybackState(), "tour ended"),
    ):
        assert record_states(
            journal, playback_state, playback=playback, plan="tour", driver="simulator"
        ) == [text]
    assert record_states(journal, AT_REST, driver="simulator") == []


def test_stops_and_locks_name_their_source_and_reason(journal):
    stop = StopRequest(OPERATOR, "", NOON)
    lock = StopRequest(OPERATOR, STOP_AND_LOCK_REASON, NOON)
    program_stop = StopRequest("program", "the disk is full", NOON)
    latched = replace(AT_REST, stop=lock, latch_reason="locked", lock_reason="locked")
    assert record_states(
        journal,
        AT_REST,
        replace(AT_REST, stop=stop),
        latched,
        replace(AT_REST, stop=lock),
        replace(AT_REST, stop=program_stop),
    ) == [
        "Stopped by the operator",
        "Stopped and locked by the operator",
        "Lock released",
        "Stopped by the program: the disk is full",
    ]
    assert {entry.level for entry in journal.entries} == {Level.WARNING, Level.INFO}


def test_only_a_lasting_lock_and_its_end_are_recorded(journal):
    unknown = replace(AT_REST, stop=None, lock_reason="home first")
    assert record_states(journal, AT_REST, unknown, AT_REST) == []
    assert record_states(journal, *[unknown] * 8) == ["Locked: home first"]
    assert record_states(journal, *[AT_REST] * 8) == ["Motion is possible"]


def test_penetration_recording_and_model_changes_are_recorded(journal):
    held = PenetrationStatus(PenetrationPhase.HELD, reason="stopped")
    assert record_states(journal, AT_REST) == []
    assert record_states(journal, AT_REST, penetration=held) == ["Penetration: held: stopped"]
    assert journal.entries[-1].level is Level.WARNING
    assert record_states(journal, AT_REST, penetration=held, recording="a.arrows") == [
        "Recording a.arrows started"
    ]
    assert record_states(journal, AT_REST, penetration=held, model="other") == [
        "Recording a.arrows ended",
        "Model in use: other",
    ]


def test_repeated_notices_share_one_entry_with_a_count(journal):
    for target in (70, 80):
        journal.add_notice(Level.ERROR, NoticeMessage(f"target {target} µm is outside"))
    assert [(entry.text, entry.count) for entry in journal.entries] == [
        ("target 80 µm is outside", 2)
    ]
    journal.add_notice(Level.ERROR, NoticeMessage("something else"))
    journal.add_notice(Level.ERROR, NoticeMessage("target 90 µm is outside"))
    assert [entry.count for entry in journal.entries] == [2, 1, 1]
    assert (journal.count, journal.repeats) == (3, 1)
