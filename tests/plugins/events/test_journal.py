"""The operator's log: every move once, with its way; stops, locks, playbacks and recordings."""

from dataclasses import replace
from datetime import datetime

import pytest

from rotemina.app.motion.ownership import OPERATOR, PLAYBACK
from rotemina.app.motion.penetration.status import PenetrationStatus, Phase
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.motion.stop import LOCKED, StopRequest
from rotemina.app.shell.help_topics import Explained
from rotemina.app.shell.workbench import Level
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.events.journal import Journal, Moment
from rotemina.sim.robot.file import load_robot

NOON = datetime(2024, 5, 6, 12, 0, 0)
AT_REST = SessionState(
    connection=Connection.CONNECTED,
    activity=DeviceState.IDLE,
    command={"x": 0.0275, "zn": 32.5e-6},
    position_known=True,
)
MOVING = replace(AT_REST, activity=DeviceState.MOVING, owners={"x": OPERATOR})


@pytest.fixture
def journal():
    return Journal(load_robot("rotemina"), lambda: NOON)


def told(journal, *states, **others):
    """Return what a journal tells of states that follow each other by a tenth of a second."""
    before = journal.count
    for number, state in enumerate(states):
        at_s = 0.1 * (before + number)
        parts = {"playback": PlaybackState(), "penetration": PenetrationStatus(), **others}
        journal.look(Moment(state, at_s=at_s, **parts))
    return [entry.text for entry in list(journal.entries)[before:]]


def test_each_move_is_told_once_at_its_end_with_its_way(journal):
    there = {"x": 0.02751, "zn": 32.5e-6}
    under_way = replace(MOVING, command={"x": 0.027503, "zn": 32.5e-6})
    assert told(journal, AT_REST, MOVING, under_way) == []
    assert told(journal, replace(AT_REST, command=there), AT_REST) == [
        "X 27.5000 → 27.5100 mm",
        "X 27.5100 → 27.5000 mm",  # between two looks, so that it was never seen to move
    ]
    by_stick = replace(MOVING, owners={"x": "joystick"})
    both = {"x": 0.02751, "zn": 33.5e-6}
    assert told(journal, by_stick, replace(AT_REST, command=both)) == [
        "joystick: X 27.5000 → 27.5100 mm, Z nano 32.500 → 33.500 µm"
    ]


def test_a_new_connection_begins_anew_and_a_playback_has_its_own_words(journal):
    gone = replace(AT_REST, connection=Connection.DISCONNECTED)
    elsewhere = replace(AT_REST, command={"x": 0.01, "zn": 1e-5})
    assert told(journal, AT_REST, gone, elsewhere, driver="simulator") == [
        "Disconnected",
        "Connected: simulator",
    ]
    played = replace(elsewhere, activity=DeviceState.PLAYING, owners={"x": PLAYBACK})
    playing = PlaybackState(PlaybackPhase.PLAYING)
    paused = PlaybackState(PlaybackPhase.PAUSED, row=4)
    for playback, text in (
        (playing, "Playing tour"),
        (paused, "tour is paused at row 5"),
        (replace(playing, row=4), "tour resumed at row 5"),
        (PlaybackState(), "tour ended"),
    ):
        assert told(journal, played, playback=playback, plan="tour", driver="simulator") == [text]
    assert told(journal, AT_REST, driver="simulator") == []


def test_stops_and_locks_are_told_with_who_and_why(journal):
    stop = StopRequest(OPERATOR, "", NOON)
    lock = StopRequest(OPERATOR, LOCKED, NOON)
    own = StopRequest("program", "the disk is full", NOON)
    latched = replace(AT_REST, stop=lock, latched="locked", locked="locked")
    assert told(
        journal,
        AT_REST,
        replace(AT_REST, stop=stop),
        latched,
        replace(AT_REST, stop=lock),
        replace(AT_REST, stop=own),
    ) == [
        "Stopped by the operator",
        "Stopped and locked by the operator",
        "Lock released",
        "Stopped by the program: the disk is full",
    ]
    assert {entry.level for entry in journal.entries} == {Level.WARNING, Level.INFO}


def test_only_a_lock_that_lasts_is_told_and_its_end(journal):
    unknown = replace(AT_REST, stop=None, locked="home first")
    assert told(journal, AT_REST, unknown, AT_REST) == []
    assert told(journal, *[unknown] * 8) == ["Locked: home first"]
    assert told(journal, *[AT_REST] * 8) == ["Motion is possible"]


def test_penetration_and_recording_are_told(journal):
    held = PenetrationStatus(Phase.HELD, reason="stopped")
    assert told(journal, AT_REST) == []
    assert told(journal, AT_REST, penetration=held) == ["Penetration: held: stopped"]
    assert journal.entries[-1].level is Level.WARNING
    assert told(journal, AT_REST, penetration=held, recording="a.arrows") == [
        "Recording a.arrows started"
    ]
    assert told(journal, AT_REST, penetration=held, model="other") == [
        "Recording a.arrows ended",
        "Model in use: other",
    ]


def test_repeats_of_a_notice_are_one_entry_and_moves_are_not(journal):
    for target in (70, 80):
        journal.tell_notice(Level.ERROR, Explained(f"target {target} µm is outside"))
    assert [(one.text, one.count) for one in journal.entries] == [("target 80 µm is outside", 2)]
    journal.tell_notice(Level.ERROR, Explained("something else"))
    journal.tell_notice(Level.ERROR, Explained("target 90 µm is outside"))
    assert [one.count for one in journal.entries] == [2, 1, 1]
    assert (journal.count, journal.repeats) == (3, 1)
