"""What the window says of every state of the machine: rows to read, and rules for all of them."""

from dataclasses import replace
from datetime import datetime
from itertools import product

import pytest

from rotemina.app.motion.penetration.status import PenetrationStatus
from rotemina.app.motion.penetration.status import Phase as PenetrationPhase
from rotemina.app.motion.playback import PAUSE_REASON, PlaybackPhase, PlaybackState
from rotemina.app.motion.resuming import ResumeStep
from rotemina.app.motion.state import Connection, SessionState, lock_reason
from rotemina.app.motion.stop import LOCKED, StopRequest
from rotemina.app.shell.state_tone import Tone
from rotemina.app.shell.state_words import describe_motion
from rotemina.app.shell.window_state import Remedy, WindowSnapshot, describe_state
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
AT = datetime(2026, 3, 1, 12, 3, 4)
PRESSED = StopRequest("operator", "", AT)
BY_PAUSE = StopRequest("operator", PAUSE_REASON, AT)
COMMAND = dict.fromkeys(ROBOT.axes, 0.0)
READY = SessionState(
    Connection.CONNECTED, DeviceState.IDLE, COMMAND, COMMAND, position_known=True, age_s=0.02
)
ALL = dict.fromkeys(ROBOT.axes, "playback")
MOVING = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)
PLAYED = PlaybackState(rows=10000, duration_s=100.0)
PAUSED = replace(PLAYED, phase=PlaybackPhase.PAUSED, row=5436, path_s=54.36)
EXCESS = "axis thy deviates from the model by 126 µrad for more than 20 ms; the bound is 125 µrad"


def state(**changes):
    """A state as a session gives it, with the reason why it is locked."""
    made = replace(READY, **changes)
    locked = changes.get("locked") or lock_reason(made)
    return replace(made, locked=f"{made.latched} is active" if made.latched else locked)


def shown(session=READY, **more):
    return describe_state(WindowSnapshot(ROBOT, session, **more))


ROWS = [
    # session, the rest of the snapshot, headword, line 2, tone, remedy
    (state(), {}, "Ready", "At rest; every axis can be moved.", "good", None),
    (
        state(connection=Connection.DISCONNECTED, activity=DeviceState.CLOSED),
        {},
        "Disconnected",
        "No machine is connected; nothing can be moved from here.",
        "quiet",
        Remedy.CONNECT,
    ),
    (
        state(connection=Connection.CONNECTING, activity=DeviceState.CLOSED),
        {},
        "Connecting",
        "Waiting for the first answer of the device.",
        "busy",
        None,
    ),
    (
        state(connection=Connection.FAILED, fault="port COM7: there is no such port"),
        {},
        "Failed",
        "Port COM7: there is no such port",
        "danger",
        Remedy.RECONNECT,
    ),
    (
        state(connection=Connection.FAILED, fault="unplugged", link_lost=True, age_s=3.0),
        {},
        "Link lost",
        "No answer for 3.0 s; the machine may have moved. Unplugged",
        "danger",
        Remedy.RECONNECT,
    ),
    (
        state(silent_s=0.3, activity=DeviceState.MOVING, owners={"x": "operator"}),
        {},
        "Link lost",
        "No answer for 0.3 s; commands are refused until it answers.",
        "warning",
        None,
    ),
    (
        state(activity=DeviceState.FAULT, fault="x: limit switch"),
        {"playback": PAUSED},
        "Fault",
        "X: limit switch. Check the machine, then clear the fault.",
        "danger",
        Remedy.CLEAR_FAULT,
    ),
    (
        state(activity=DeviceState.FAULT, fault="overheated", latched=LOCKED),
        {},
        "Fault",
        "Overheated. The machine is locked as well: release it first.",
        "danger",
        Remedy.RELEASE,
    ),
    (
        state(latched=LOCKED, stop=StopRequest("operator", LOCKED, AT), halted=True),
        {"playback": PAUSED},
        "Locked",
        "Locked by the operator at 12:03:04. Release it to move.",
        "danger",
        Remedy.RELEASE,
    ),
    (
        state(latched="the stick's stop"),
        {},
        "Locked",
        "The stick's stop is active. Release it to move.",
        "danger",
        Remedy.RELEASE,
    ),
    (
        state(position_known=False, unhomed=("x", "y")),
        {},
        "Locked",
        "The position of X, Y is not known; home first.",
        "warning",
        Remedy.HOME,
    ),
    (
        state(
            position_known=False,
            unhomed=("x", "y"),
            activity=DeviceState.HOMING,
            owners={"x": "homing", "y": "homing"},
        ),
        {},
        "Homing",
        "Moving to find the limit switches of X, Y.",
        "busy",
        None,
    ),
    (
        state(doubt="the connection was lost"),
        {},
        "Locked",
        "The connection was lost: the position may be wrong; home, or confirm it.",
        "warning",
        Remedy.CONFIRM,
    ),
    (
        state(activity=DeviceState.MOVING, owners={"x": "operator", "zn": "joystick"}),
        {},
        "Moving",
        "Operator moves X; Joystick moves Z nano",
        "busy",
        None,
    ),
    (
        state(activity=DeviceState.MOVING),
        {},
        "Moving",
        "The machine moves without a command from this window; STOP halts it.",
        "busy",
        None,
    ),
    (
        state(activity=DeviceState.MOVING, locked="a replay is shown"),
        {},
        "Moving",
        "The machine moves without a command from this window; STOP halts it. No new command is "
        "accepted: a replay is shown",
        "warning",
        None,
    ),
    (
        state(activity=DeviceState.PLAYING, progress=0.3, owners=ALL),
        {"playback": replace(PLAYED, phase=PlaybackPhase.PLAYING, row=6199, path_s=62.0)},
        "Playing 62 %",
        "Playback moves all axes; 0:38 left",
        "busy",
        None,
    ),
    (
        state(stopping=True, activity=DeviceState.MOVING, stop=PRESSED, halted=True),
        {},
        "Stopping",
        "The axes are coming to rest.",
        "warning",
        None,
    ),
    (
        state(stop=PRESSED, halted=True),
        {},
        "Stopped",
        "Stopped by the operator at 12:03:04. The next command moves it again.",
        "warning",
        None,
    ),
    (state(stop=PRESSED), {}, "Ready", "At rest; every axis can be moved.", "good", None),
    (
        state(stop=BY_PAUSE, halted=True),
        {"playback": PAUSED},
        "Paused at row 5437",
        "At rest; Resume goes on from here, End gives it up.",
        "warning",
        None,
    ),
    (
        state(stop=PRESSED, halted=True),
        {"playback": PAUSED},
        "Paused at row 5437",
        "Stopped by the operator at 12:03:04. Resume goes on from here.",
        "warning",
        None,
    ),
    (
        state(stop=StopRequest("program", EXCESS, AT), halted=True),
        {"playback": replace(PAUSED, excess=EXCESS)},
        "Paused at row 5437",
        f"A{EXCESS[1:]}. Check the machine, then resume or end.",
        "warning",
        None,
    ),
    (
        state(stop=BY_PAUSE),
        {"playback": replace(PAUSED, moved={"x": 2.7e-3, "thx": -1e-4})},
        "Paused at row 5437",
        "X moved 2.7 mm, θx moved 100 µrad since the pause; Resume asks how to go on.",
        "warning",
        None,
    ),
    (
        state(activity=DeviceState.MOVING, owners=ALL),
        {"playback": PAUSED, "resuming": ResumeStep.RETURNING},
        "Moving",
        "Moving back slowly to row 5437; then the playback resumes.",
        "busy",
        None,
    ),
    (
        state(),
        {"penetration": PenetrationStatus(PenetrationPhase.HOLD)},
        "Penetration",
        "Hold; it moves on by itself.",
        "busy",
        None,
    ),
    (
        state(),
        {"penetration": PenetrationStatus(PenetrationPhase.ARMED)},
        "Penetration",
        "Armed; its button starts the run.",
        "warning",
        None,
    ),
    (
        state(),
        {"procedure": "autofocus"},
        "Moving",
        "Autofocus is under way and moves axes by itself.",
        "busy",
        None,
    ),
]


@pytest.mark.parametrize(("session", "more", "headword", "reason", "tone", "remedy"), ROWS)
def test_a_state_reads(session, more, headword, reason, tone, remedy):
    display = shown(session, **more)
    assert (display.headword, display.reason) == (headword, reason)
    assert (display.tone, display.remedy) == (tone, remedy)


TONES = {
    "Ready": {Tone.GOOD},
    "Moving": {Tone.BUSY, Tone.WARNING},
    "Playing": {Tone.BUSY, Tone.WARNING},
    "Homing": {Tone.BUSY},
    "Connecting": {Tone.BUSY},
    "Penetration": {Tone.BUSY, Tone.WARNING},
    "Paused": {Tone.WARNING},
    "Stopping": {Tone.WARNING},
    "Stopped": {Tone.WARNING},
    "Locked": {Tone.WARNING, Tone.DANGER},
    "Link": {Tone.WARNING, Tone.DANGER},
    "Fault": {Tone.DANGER},
    "Failed": {Tone.DANGER},
    "Disconnected": {Tone.QUIET},
}
OBSTACLES = (
    {},
    {"differences": ("kp: 3 in place of 4",)},
    {"position_known": False, "unhomed": ("x", "y")},
    {"doubt": "the connection was lost"},
    {"locked": "a replay is shown"},
)
OWNERS = ({}, {"x": "operator", "thx": "operator"}, ALL)
WORK = (
    {},
    {"playback": replace(PAUSED, excess=EXCESS)},
    {"playback": replace(PAUSED, moved={"x": 2.7e-3})},
    {"playback": PAUSED, "resuming": ResumeStep.RESTING},
    {"playback": PAUSED, "resuming": ResumeStep.RETURNING},
    {"playback": replace(PAUSED, pausing=True)},
    {"playback": replace(PLAYED, phase=PlaybackPhase.PLAYING)},
    {"procedure": "autofocus"},
    *({"penetration": PenetrationStatus(phase)} for phase in PenetrationPhase),
)


def every_session():
    """Every combination of what a session's state says, also such as never come together."""
    for connection, activity, silent_s, fault, stopping in product(
        Connection, DeviceState, (0.0, 0.3), (None, "overheated"), (False, True)
    ):
        for stop, latched, owners, obstacle in product(
            ((None, False), (PRESSED, True), (PRESSED, False)), (None, LOCKED), OWNERS, OBSTACLES
        ):
            yield state(
                connection=connection,
                activity=activity,
                silent_s=silent_s,
                fault=fault,
                stopping=stopping,
                stop=stop[0],
                halted=stop[1],
                latched=latched,
                owners=owners,
                **obstacle,
            )


def check_display(session, more):
    """Hold a display against the state that it is of."""
    display = shown(session, **more)
    word = display.headword.split()[0]
    assert display.tone in TONES[word]
    assert display.reason.strip()
    # What moves is said once; the reason of a lock names the axes that it is about.
    movers, _, _ = display.reason.partition("No new command is accepted")
    for axis in ("X", "θx", "Z nano"):
        assert movers.count(axis) <= 1
    check_gravest_first(word, session)
    check_present(word, display, session, more)
    check_remedy(display.remedy, session)


def check_gravest_first(word, session):
    """The gravest of several things is shown."""
    if session.connection is Connection.FAILED:
        assert word in ("Failed", "Link")
    if session.connection is not Connection.CONNECTED:
        assert word in ("Failed", "Link", "Connecting", "Disconnected")
    elif session.activity is DeviceState.CLOSED:
        assert word == "Connecting"
    elif session.fault or session.activity is DeviceState.FAULT:
        assert word == "Fault"  # what halted may send no readings, and is not lost for that
    elif session.silent_s > 0.0:
        assert word == "Link"
    elif session.latched:
        assert word == "Locked"


def check_present(word, display, session, more):
    """Nothing past or impossible is shown, and nothing green that accepts no motion."""
    moves = session.activity in MOVING
    if word in ("Ready", "Paused", "Stopped"):
        assert session.activity is DeviceState.IDLE
        assert session.locked is None
        assert not session.stopping
        assert not session.owners
    if "Stopped by" in display.reason:
        assert session.halted
        assert not moves
    if "At rest" in display.reason:
        assert not moves
    if word == "Paused":
        assert more["playback"].phase is PlaybackPhase.PAUSED
    if display.tone is Tone.GOOD:
        assert not session.halted
        assert more.get("playback", PLAYED).phase is PlaybackPhase.IDLE
        assert "procedure" not in more


def check_remedy(remedy, session):
    """The button that is offered can help."""
    connected = session.connection is Connection.CONNECTED
    moves = session.activity in MOVING
    can_help = {
        None: True,
        Remedy.CONNECT: session.connection is Connection.DISCONNECTED,
        Remedy.RECONNECT: session.connection is Connection.FAILED,
        Remedy.RELEASE: connected and session.latched is not None,
        Remedy.CLEAR_FAULT: connected and session.latched is None,
        Remedy.COMPARE_PARAMETERS: bool(session.differences) and not moves,
        Remedy.HOME: bool(session.unhomed) and not moves and session.latched is None,
        Remedy.CONFIRM: session.doubt is not None and not moves,
    }
    assert can_help[remedy]


def test_no_state_of_a_session_is_worded_against_it():
    for session in every_session():
        check_display(session, {})


@pytest.mark.parametrize("more", WORK)
def test_no_work_is_worded_against_the_state_in_which_it_is_done(more):
    for activity, stop, owners, obstacle in product(
        DeviceState, ((None, False), (PRESSED, True), (BY_PAUSE, True)), OWNERS, OBSTACLES
    ):
        for latched, silent_s, stopping in product((None, LOCKED), (0.0, 0.3), (False, True)):
            session = state(
                activity=activity,
                stop=stop[0],
                halted=stop[1],
                owners=owners,
                latched=latched,
                silent_s=silent_s,
                stopping=stopping,
                **obstacle,
            )
            check_display(session, more)


@pytest.mark.parametrize(
    ("session", "words"),
    [
        (state(), "No axis is moving."),
        (state(activity=DeviceState.MOVING), "Axes are moving."),
        (state(owners={"x": "operator"}), "Operator moves X"),
        (state(silent_s=0.4), "Not known: the machine does not answer."),
        (state(connection=Connection.FAILED), "Not known: the machine does not answer."),
    ],
)
def test_nothing_is_said_to_rest_that_nobody_sees(session, words):
    assert describe_motion(session) == words
