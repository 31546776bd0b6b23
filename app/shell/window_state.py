"""What the window says of the machine now, worked out from one snapshot alone."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.app.display_units import duration_text
from rotemina.app.motion.ownership import HOMING, OPERATOR
from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus
from rotemina.app.motion.penetration.status import Phase as PenetrationPhase
from rotemina.app.motion.playback import PAUSE_REASON, PlaybackPhase, PlaybackState
from rotemina.app.motion.resuming import ResumeStep
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.motion.stop import LOCKED
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.app.shell.state_tone import Tone
from rotemina.app.shell.state_words import (
    age_text,
    axes_text,
    describe_moved,
    describe_movers,
    describe_stop,
    sentence,
)
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.model import Robot

_MOVING = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)


class Remedy(StrEnum):
    """The one button that leads out of a state."""

    CONNECT = "connect"
    RECONNECT = "reconnect"
    RELEASE = "release"
    CLEAR_FAULT = "clear fault"
    COMPARE_PARAMETERS = "compare parameters"
    HOME = "home"
    CONFIRM = "confirm"


@dataclass(frozen=True, slots=True)
class WindowSnapshot:
    """All that the window knows of the machine at one moment.

    Attributes
    ----------
    robot : Robot
        For the units of its axes.
    session : SessionState
    playback : PlaybackState
    resuming : ResumeStep
        What a playback that is to be resumed waits for.
    penetration : PenetrationStatus
    procedure : str
        Another procedure that moves axes by itself, as an autofocus; empty without one.
    """

    robot: Robot
    session: SessionState
    playback: PlaybackState = field(default_factory=PlaybackState)
    resuming: ResumeStep = ResumeStep.NONE
    penetration: PenetrationStatus = field(default_factory=PenetrationStatus)
    procedure: str = ""


@dataclass(frozen=True, slots=True)
class StateDisplay:
    """The state in words: one or two, and a line with the reason or with what is moving.

    Attributes
    ----------
    headword, reason : str
    tone : Tone
    remedy : Remedy or None
    """

    headword: str
    reason: str
    tone: Tone
    remedy: Remedy | None = None


def describe_state(snapshot: WindowSnapshot) -> StateDisplay:
    """Return what the window says of the machine now; of several things the gravest."""
    return next(found for rule in _RULES if (found := rule(snapshot)) is not None)


# --- the rules, the gravest first -----------------------------------------------------------------


def _describe_connection(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the state while there is no device."""
    state = snapshot.session
    if state.connection is Connection.FAILED:
        fault = spoken(state.fault or "")
        if not state.link_lost:
            text = fault or translate("shell", "The device failed; reconnect it.")
            return StateDisplay(
                translate("shell", "Failed"), sentence(text), Tone.DANGER, Remedy.RECONNECT
            )
        lost = translate("shell", "No answer for {time}; the machine may have moved")
        text = lost.format(time=age_text(state.age_s or 0.0))
        return StateDisplay(
            translate("shell", "Link lost"),
            f"{text}. {sentence(fault)}".strip(),
            Tone.DANGER,
            Remedy.RECONNECT,
        )
    if state.connection is Connection.DISCONNECTED:
        return StateDisplay(
            translate("shell", "Disconnected"),
            translate("shell", "No machine is connected; nothing can be moved from here."),
            Tone.QUIET,
            Remedy.CONNECT,
        )
    if state.connection is Connection.CONNECTING or state.activity is DeviceState.CLOSED:
        return StateDisplay(
            translate("shell", "Connecting"),
            translate("shell", "Waiting for the first answer of the device."),
            Tone.BUSY,
        )
    return None


def _describe_silence(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the state while a connected device does not answer."""
    state = snapshot.session
    if state.silent_s <= 0.0:
        return None
    text = translate("shell", "No answer for {time}; commands are refused until it answers.")
    return StateDisplay(
        translate("shell", "Link lost"),
        text.format(time=age_text(state.silent_s)),
        Tone.DANGER if state.latched else Tone.WARNING,
    )


def _describe_fault(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.fault is None and state.activity is not DeviceState.FAULT:
        return None
    fault = sentence(spoken(state.fault or "")) or translate("shell", "The device reports a fault")
    if state.latched is not None:
        text = translate("shell", "{fault}. The machine is locked as well: release it first.")
        remedy = Remedy.RELEASE
    else:
        text = translate("shell", "{fault}. Check the machine, then clear the fault.")
        remedy = Remedy.CLEAR_FAULT
    return StateDisplay(
        translate("shell", "Fault"), text.format(fault=fault.rstrip(".")), Tone.DANGER, remedy
    )


def _describe_latch(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.latched is None:
        return None
    if state.activity in _MOVING:
        text = translate("shell", "The axes are still coming to rest.")
    elif state.stop is not None and state.latched == LOCKED == state.stop.why:
        if state.stop.by == OPERATOR:
            by = translate("shell", "Locked by the operator at {time}. Release it to move.")
        else:
            by = translate("shell", "Locked by the program at {time}. Release it to move.")
        text = by.format(time=f"{state.stop.at:%H:%M:%S}")
    else:
        held = translate("shell", "{reason} is active. Release it to move.")
        text = held.format(reason=sentence(spoken(state.latched)))
    return StateDisplay(translate("shell", "Locked"), text, Tone.DANGER, Remedy.RELEASE)


def _describe_stopping(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    pausing = snapshot.playback.pausing and state.activity in _MOVING
    if not (state.stopping or pausing):
        return None
    if snapshot.playback.pausing:
        text = translate("shell", "The playback is being paused; the axes are coming to rest.")
    else:
        text = translate("shell", "The axes are coming to rest.")
    return StateDisplay(translate("shell", "Stopping"), text, Tone.WARNING)


def _describe_homing(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.activity is not DeviceState.HOMING:
        return None
    axes = [axis for axis, owner in state.owners.items() if owner == HOMING]
    text = (
        translate("shell", "Moving to find the limit switches of {axes}.").format(
            axes=axes_text(state, axes)
        )
        if axes
        else translate("shell", "Moving to find the limit switches.")
    )
    return StateDisplay(translate("shell", "Homing"), text, Tone.BUSY)


def _describe_playing(snapshot: WindowSnapshot) -> StateDisplay | None:
    state, playback = snapshot.session, snapshot.playback
    ours = playback.phase is PlaybackPhase.PLAYING
    plays = state.activity is DeviceState.PLAYING
    if not plays and not (ours and state.activity is DeviceState.IDLE):
        return None
    share = state.progress
    if ours:
        share = playback.path_s / playback.duration_s if playback.duration_s else 0.0
    if not plays:
        text = translate("shell", "The path is being checked; then the axes move.")
    elif state.progress <= 0.0:
        text = translate("shell", "The axes move to where the trajectory begins.")
    elif ours:
        left_s = (playback.duration_s - playback.path_s) / playback.speed
        text = translate("shell", "{movers}; {time} left").format(
            movers=describe_movers(state) or translate("shell", "A trajectory moves the axes"),
            time=duration_text(left_s),
        )
    else:
        text = describe_movers(state) or translate("shell", "A trajectory moves the axes")
    headword = translate("shell", "Playing {share:.0f} %").format(share=100.0 * share)
    return _with_lock(StateDisplay(headword, text, Tone.BUSY), state)


def _describe_moving(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.activity is not DeviceState.MOVING:
        return None
    if snapshot.resuming is ResumeStep.RETURNING:
        text = translate("shell", "Moving back slowly to row {row}; then the playback resumes.")
        text = text.format(row=_row_text(snapshot.playback))
    else:
        text = describe_movers(state) or translate(
            "shell", "The machine moves without a command from this window; STOP halts it."
        )
    return _with_lock(StateDisplay(translate("shell", "Moving"), text, Tone.BUSY), state)


def _describe_lock(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the state of a machine at rest that accepts no motion."""
    state = snapshot.session
    if state.locked is None and state.position_known:
        return None
    reason = state.locked or ""
    text = spoken(reason) if reason else translate("shell", "the position is not known yet")
    remedy = None
    if state.differences:
        remedy = Remedy.COMPARE_PARAMETERS
    elif state.unhomed:
        remedy = Remedy.HOME
    elif state.doubt is not None:
        remedy = Remedy.CONFIRM
    return StateDisplay(translate("shell", "Locked"), f"{sentence(text)}.", Tone.WARNING, remedy)


def _describe_penetration(snapshot: WindowSnapshot) -> StateDisplay | None:
    status = snapshot.penetration
    if status.phase not in {*UNDER_WAY, PenetrationPhase.ARMED, PenetrationPhase.HELD}:
        return None
    text = sentence(spoken(status.phase))
    if status.reason:
        text = f"{text}: {spoken(status.reason)}"
    if status.phase in UNDER_WAY:
        more, tone = translate("shell", "it moves on by itself"), Tone.BUSY
    elif status.phase is PenetrationPhase.ARMED:
        more, tone = translate("shell", "its button starts the run"), Tone.WARNING
    else:
        more, tone = translate("shell", "it stays here until its axes are freed"), Tone.WARNING
    return StateDisplay(translate("shell", "Penetration"), f"{text}; {more}.", tone)


def _describe_procedure(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the state of a machine at rest that is about to move by itself."""
    state, moving = snapshot.session, translate("shell", "Moving")
    if snapshot.procedure:
        text = translate("shell", "{procedure} is under way and moves axes by itself.")
        return StateDisplay(
            moving, text.format(procedure=sentence(spoken(snapshot.procedure))), Tone.BUSY
        )
    if movers := describe_movers(state):
        return StateDisplay(moving, movers, Tone.BUSY)
    if state.queued:
        return StateDisplay(moving, translate("shell", "A command is about to begin."), Tone.BUSY)
    return None


def _describe_pause(snapshot: WindowSnapshot) -> StateDisplay | None:
    state, playback = snapshot.session, snapshot.playback
    if playback.phase is not PlaybackPhase.PAUSED:
        return None
    if snapshot.resuming is not ResumeStep.NONE:
        text = translate("shell", "It resumes as soon as the axes rest and the path is checked.")
    elif moved := describe_moved(snapshot.robot, playback):
        text = translate("shell", "{moved}; Resume asks how to go on.").format(moved=moved)
    elif playback.excess:
        text = translate("shell", "{excess}. Check the machine, then resume or end.").format(
            excess=sentence(spoken(playback.excess))
        )
    elif state.halted and state.stop is not None and state.stop.why != PAUSE_REASON:
        text = translate("shell", "{stopped}. Resume goes on from here.").format(
            stopped=describe_stop(state.stop)
        )
    else:
        text = translate("shell", "At rest; Resume goes on from here, End gives it up.")
    headword = translate("shell", "Paused at row {row}").format(row=_row_text(playback))
    return StateDisplay(headword, text, Tone.WARNING)


def _describe_stopped(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if not state.halted or state.stop is None:
        return None
    text = translate("shell", "{stopped}. The next command moves it again.")
    return StateDisplay(
        translate("shell", "Stopped"),
        text.format(stopped=describe_stop(state.stop)),
        Tone.WARNING,
    )


def _describe_readiness(_: WindowSnapshot) -> StateDisplay:
    return StateDisplay(
        translate("shell", "Ready"),
        translate("shell", "At rest; every axis can be moved."),
        Tone.GOOD,
    )


_RULES: tuple[Callable[[WindowSnapshot], StateDisplay | None], ...] = (
    _describe_connection,
    # A device with a fault may send no more readings: that is no lost link.
    _describe_fault,
    _describe_silence,
    _describe_latch,
    _describe_stopping,
    _describe_homing,
    _describe_playing,
    _describe_moving,
    _describe_lock,
    _describe_penetration,
    _describe_procedure,
    _describe_pause,
    _describe_stopped,
    _describe_readiness,
)


def _with_lock(display: StateDisplay, state: SessionState) -> StateDisplay:
    """Return what moves, with the reason why no other command is accepted."""
    if state.locked is None:
        return display
    text = translate("shell", "{moving}. No new command is accepted: {reason}").format(
        moving=display.reason.rstrip("."), reason=spoken(state.locked)
    )
    return StateDisplay(display.headword, text, Tone.WARNING)


def _row_text(playback: PlaybackState) -> str:
    return str(max(playback.row, 0) + 1)
