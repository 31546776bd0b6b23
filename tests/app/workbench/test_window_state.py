"""How the window describes the state of the machine: examples, and rules for all states."""

from dataclasses import replace
from datetime import datetime
from itertools import product

import pytest

from rotemina.app.motion.penetration import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.playback import PAUSE_REASON, PlaybackPhase, PlaybackState, ResumeStep
from rotemina.app.motion.state import (
    STOP_AND_LOCK_REASON,
    ConnectionState,
    SessionState,
    StopRequest,
    find_lock_reason,
)
from rotemina.app.workbench import (
    StateRemedy,
    StateTone,
    WindowSnapshot,
    describe_motion,
    describe_state,
)
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
STOP_TIME = datetime(2026, 3, 1, 12, 3, 4)
OPERATOR_STOP = StopRequest("operator", "", STOP_TIME)
PAUSE_STOP = StopRequest("operator", PAUSE_REASON, STOP_TIME)
COMMAND = dict.fromkeys(ROBOT.axes, 0.0)
READY = SessionState(
    ConnectionState.CONNECTED, DeviceState.IDLE, COMMAND, COMMAND, position_known=True, age_s=0.02
)
ALL_AXES_PLAYED = dict.fromkeys(ROBOT.axes, "playback")
MOVING = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
PLAYED = PlaybackState(rows=10000, duration_s=100.0)
PAUSED = replace(PLAYED, phase=PlaybackPhase.PAUSED, row=5436, path_s=54.36)
DEVIATION_TEXT = (
    "axis thy deviates from the model by 126 µrad for more than 20 ms; the bound is 125 µrad"
)


def make_state(**changes):
    """Return a session state with the reason why it is locked."""
    state = replace(READY, **changes)
    reason = changes.get("lock_reason") or find_lock_reason(state)
    return replace(
        state, lock_reason=f"{state.latch_reason} is active" if state.latch_reason else reason
    )


def describe(session=READY, **other_fields):
    return describe_state(WindowSnapshot(ROBOT, session, **other_fields))


def row(headword, reason, tone, remedy=None, *, rest=None, **session):
    """Return a state of the session, the rest of the snapshot, and how they are displayed."""
    return pytest.param(
        make_state(**session), rest or {}, headword, reason, tone, remedy, id=reason[:40]
    )


FAILED, CLOSED, MOVES = ConnectionState.FAILED, DeviceState.CLOSED, DeviceState.MOVING
UNHOMED = {"position_known": False, "unhomed": ("x", "y")}
STOPPED = {"stop": OPERATOR_STOP, "halted": True}
IS_PAUSED = {"playback": PAUSED}
LOCK_STOP = StopRequest("operator", STOP_AND_LOCK_REASON, STOP_TIME)
EXCESS_STOP = StopRequest("program", DEVIATION_TEXT, STOP_TIME)


@pytest.mark.parametrize(
    ("session", "rest", "headword", "reason", "tone", "remedy"),
    [
        row("Ready", "At rest; every axis can be moved.", "good"),
        row("Ready", "At rest; every axis can be moved.", "good", stop=OPERATOR_STOP),
        row(
            *("Disconnected", "No machine is connected", "quiet", StateRemedy.CONNECT),
            **{"connection": ConnectionState.DISCONNECTED, "activity": CLOSED},
        ),
        row(
            *("Connecting", "Waiting for the first answer", "busy"),
            **{"connection": ConnectionState.CONNECTING, "activity": CLOSED},
        ),
        row(
            *("Failed", "Port COM7: there is no such port", "danger", StateRemedy.RECONNECT),
            **{"connection": FAILED, "fault": "port COM7: there is no such port"},
        ),
        row(
            "Link lost",
            "No answer for 3.0 s; the machine may have moved. Unplugged",
            *("danger", StateRemedy.RECONNECT),
            **{"connection": FAILED, "fault": "unplugged", "link_lost": True, "age_s": 3.0},
        ),
        row(
            *("Link lost", "No answer for 0.3 s; commands are refused", "warning"),
            **{"silent_s": 0.3, "activity": MOVES, "owners": {"x": "operator"}},
        ),
        row(
            "Fault",
            "X: limit switch. Check the machine, then clear the fault.",
            *("danger", StateRemedy.CLEAR_FAULT),
            **{"rest": IS_PAUSED, "activity": DeviceState.FAULT, "fault": "x: limit switch"},
        ),
        row(
            *("Fault", "locked as well: release it first.", "danger", StateRemedy.RELEASE),
            **{"fault": "overheated", "latch_reason": STOP_AND_LOCK_REASON},
        ),
        row(
            *("Locked", "Locked by the operator at 12:03:04.", "danger", StateRemedy.RELEASE),
            **{"rest": IS_PAUSED, "latch_reason": STOP_AND_LOCK_REASON, "stop": LOCK_STOP},
        ),
        row(
            *("Locked", "The stick's stop is active.", "danger", StateRemedy.RELEASE),
            latch_reason="the stick's stop",
        ),
        row(
            *("Locked", "The position of X, Y is not known", "warning", StateRemedy.HOME), **UNHOMED
        ),
        row(
            *("Homing", "Moving to find the limit switches of X, Y.", "busy"),
            **UNHOMED,
            **{"activity": DeviceState.HOMING, "owners": {"x": "homing", "y": "homing"}},
        ),
        row(
            *("Locked", "home, or confirm it", "warning", StateRemedy.CONFIRM),
            doubt="the connection was lost",
        ),
        row(
            *("Moving", "Operator moves X; Joystick moves Z nano", "busy"),
            **{"activity": MOVES, "owners": {"x": "operator", "zn": "joystick"}},
        ),
        row("Moving", "moves without a command from this window", "busy", activity=MOVES),
        row(
            *("Moving", "No new command is accepted: a replay is shown", "warning"),
            **{"activity": MOVES, "lock_reason": "a replay is shown"},
        ),
        row(
            *("Playing 62 %", "Playback moves all axes; 0:38 left", "busy"),
            rest={"playback": replace(PLAYED, phase=PlaybackPhase.PLAYING, row=6199, path_s=62)},
            **{"activity": DeviceState.PLAYING, "progress": 0.3, "owners": ALL_AXES_PLAYED},
        ),
        row(
            *("Stopping", "The axes are coming to rest.", "warning"),
            **{"stopping": True, "activity": MOVES, **STOPPED},
        ),
        row("Stopped", "Stopped by the operator at 12:03:04.", "warning", **STOPPED),
        row(
            *("Paused at row 5437", "Resume continues from here, End ends", "warning"),
            **{"rest": IS_PAUSED, "stop": PAUSE_STOP, "halted": True},
        ),
        row(
            *("Paused at row 5437", "Stopped by the operator at 12:03:04.", "warning"),
            **{"rest": IS_PAUSED, **STOPPED},
        ),
        row(
            *("Paused at row 5437", f"A{DEVIATION_TEXT[1:]}. Check the machine", "warning"),
            rest={"playback": replace(PAUSED, excess=DEVIATION_TEXT)},
            **{"stop": EXCESS_STOP, "halted": True},
        ),
        row(
            "Paused at row 5437",
            "X moved 2.7 mm, θx moved 100 µrad since the pause; Resume asks",
            "warning",
            rest={"playback": replace(PAUSED, moved={"x": 2.7e-3, "thx": -1e-4})},
        ),
        row(
            *("Moving", "Moving back slowly to row 5437", "busy"),
            rest={"playback": PAUSED, "resuming": ResumeStep.RETURNING},
            **{"activity": MOVES, "owners": ALL_AXES_PLAYED},
        ),
        row(
            *("Penetration", "Hold; it continues automatically.", "busy"),
            rest={"penetration": PenetrationStatus(PenetrationPhase.HOLD)},
        ),
        row(
            *("Penetration", "Armed; its button starts the run.", "warning"),
            rest={"penetration": PenetrationStatus(PenetrationPhase.ARMED)},
        ),
        row("Moving", "Autofocus is under way", "busy", rest={"procedure": "autofocus"}),
    ],
)
def test_a_state_is_described(session, rest, headword, reason, tone, remedy):
    display = describe(session, **rest)
    assert reason in display.reason
    assert (display.headword, display.tone, display.remedy) == (headword, tone, remedy)


TONES = {
    "Ready": {StateTone.GOOD},
    "Moving": {StateTone.BUSY, StateTone.WARNING},
    "Playing": {StateTone.BUSY, StateTone.WARNING},
    "Homing": {StateTone.BUSY},
    "Connecting": {StateTone.BUSY},
    "Penetration": {StateTone.BUSY, StateTone.WARNING},
    "Paused": {StateTone.WARNING},
    "Stopping": {StateTone.WARNING},
    "Stopped": {StateTone.WARNING},
    "Locked": {StateTone.WARNING, StateTone.DANGER},
    "Link": {StateTone.WARNING, StateTone.DANGER},
    "Fault": {StateTone.DANGER},
    "Failed": {StateTone.DANGER},
    "Disconnected": {StateTone.QUIET},
}
OBSTACLES = (
    {},
    {"differences": ("kp: 3 in place of 4",)},
    {"position_known": False, "unhomed": ("x", "y")},
    {"doubt": "the connection was lost"},
    {"lock_reason": "a replay is shown"},
)
OWNERS = ({}, {"x": "operator", "thx": "operator"}, ALL_AXES_PLAYED)
ACTIVITIES = (
    {},
    {"playback": replace(PAUSED, excess=DEVIATION_TEXT)},
    {"playback": replace(PAUSED, moved={"x": 2.7e-3})},
    {"playback": PAUSED, "resuming": ResumeStep.RESTING},
    {"playback": PAUSED, "resuming": ResumeStep.RETURNING},
    {"playback": replace(PAUSED, pausing=True)},
    {"playback": replace(PLAYED, phase=PlaybackPhase.PLAYING)},
    {"procedure": "autofocus"},
    *({"penetration": PenetrationStatus(phase)} for phase in PenetrationPhase),
)


def make_all_sessions():
    """Yield all combinations of state fields, including those that never occur together."""
    for connection, activity, silent_s, fault, stopping in product(
        ConnectionState, DeviceState, (0.0, 0.3), (None, "overheated"), (False, True)
    ):
        for stop, latched, owners, obstacle in product(
            ((None, False), (OPERATOR_STOP, True), (OPERATOR_STOP, False)),
            (None, STOP_AND_LOCK_REASON),
            OWNERS,
            OBSTACLES,
        ):
            yield make_state(
                connection=connection,
                activity=activity,
                silent_s=silent_s,
                fault=fault,
                stopping=stopping,
                stop=stop[0],
                halted=stop[1],
                latch_reason=latched,
                owners=owners,
                **obstacle,
            )


def check_display(session, other_fields):
    """Check a display against its state."""
    display = describe(session, **other_fields)
    word = display.headword.split()[0]
    assert display.tone in TONES[word]
    assert display.reason.strip()
    # Each moving axis is named once; the reason of a lock may name it again.
    movers, _, _ = display.reason.partition("No new command is accepted")
    for axis in ("X", "θx", "Z nano"):
        assert movers.count(axis) <= 1
    check_most_serious_first(word, session)
    check_present(word, display, session, other_fields)
    check_remedy(display.remedy, session)


def check_most_serious_first(word, session):
    """Check that the most serious condition is shown."""
    if session.connection is ConnectionState.FAILED:
        assert word in ("Failed", "Link")
    if session.connection is not ConnectionState.CONNECTED:
        assert word in ("Failed", "Link", "Connecting", "Disconnected")
    elif session.activity is DeviceState.CLOSED:
        assert word == "Connecting"
    elif session.fault or session.activity is DeviceState.FAULT:
        assert word == "Fault"  # a halted machine may send no readings without being lost
    elif session.silent_s > 0.0:
        assert word == "Link"
    elif session.latch_reason:
        assert word == "Locked"


def check_present(word, display, session, other_fields):
    """Check that only present conditions are shown, and green only if motion is accepted."""
    is_moving = session.activity in MOVING
    if word in ("Ready", "Paused", "Stopped"):
        assert session.activity is DeviceState.IDLE
        assert session.lock_reason is None
        assert not session.stopping
        assert not session.owners
    if "Stopped by" in display.reason:
        assert session.halted
        assert not is_moving
    if "At rest" in display.reason:
        assert not is_moving
    if word == "Paused":
        assert other_fields["playback"].phase is PlaybackPhase.PAUSED
    if display.tone is StateTone.GOOD:
        assert not session.halted
        assert other_fields.get("playback", PLAYED).phase is PlaybackPhase.IDLE
        assert "procedure" not in other_fields


def check_remedy(remedy, session):
    """Check that the offered button can help."""
    is_connected = session.connection is ConnectionState.CONNECTED
    is_moving = session.activity in MOVING
    can_help = {
        None: True,
        StateRemedy.CONNECT: session.connection is ConnectionState.DISCONNECTED,
        StateRemedy.RECONNECT: session.connection is ConnectionState.FAILED,
        StateRemedy.RELEASE: is_connected and session.latch_reason is not None,
        StateRemedy.CLEAR_FAULT: is_connected and session.latch_reason is None,
        StateRemedy.COMPARE_PARAMETERS: bool(session.differences) and not is_moving,
        StateRemedy.HOME: bool(session.unhomed) and not is_moving and session.latch_reason is None,
        StateRemedy.CONFIRM: session.doubt is not None and not is_moving,
    }
    assert can_help[remedy]


def test_the_display_never_contradicts_the_session():
    for session in make_all_sessions():
        check_display(session, {})


@pytest.mark.parametrize("other_fields", ACTIVITIES)
def test_the_display_of_an_activity_never_contradicts_the_session(other_fields):
    for activity, stop, owners, obstacle in product(
        DeviceState, ((None, False), (OPERATOR_STOP, True), (PAUSE_STOP, True)), OWNERS, OBSTACLES
    ):
        for latched, (silent_s, stopping) in product(
            (None, STOP_AND_LOCK_REASON), ((0.0, False), (0.3, False), (0.0, True))
        ):
            session = make_state(
                activity=activity,
                stop=stop[0],
                halted=stop[1],
                owners=owners,
                latch_reason=latched,
                silent_s=silent_s,
                stopping=stopping,
                **obstacle,
            )
            check_display(session, other_fields)


@pytest.mark.parametrize(
    ("session", "words"),
    [
        (make_state(), "No axis is moving."),
        (make_state(activity=DeviceState.MOVING), "Axes are moving."),
        (make_state(owners={"x": "operator"}), "Operator moves X"),
        (make_state(silent_s=0.4), "Not known: the machine does not answer."),
        (make_state(connection=ConnectionState.FAILED), "Not known: the machine does not answer."),
    ],
)
def test_axes_without_readings_are_not_described_as_at_rest(session, words):
    assert describe_motion(session) == words
