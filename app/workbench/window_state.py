"""The state of the machine as the window displays it, derived from one snapshot."""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from rotemina.app.language import format_duration, translate, translate_message
from rotemina.app.motion.device import HOMING, OPERATOR
from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationPhase as PenetrationPhase,
    PenetrationStatus,
)
from rotemina.app.motion.playback import (
    PAUSE_REASON,
    PlaybackPhase,
    PlaybackState,
    ResumeStep,
)
from rotemina.app.motion.state import STOP_AND_LOCK_REASON, ConnectionState, SessionState
from rotemina.app.workbench.state_words import (
    StateTone,
    capitalise,
    describe_moved,
    describe_movers,
    describe_stop,
    format_age,
    format_axes,
)
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot import Robot

_MOVING_STATES = (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING)


class StateRemedy(StrEnum):
    """The action that resolves a state, offered by a button in the header."""

    CONNECT = "connect"
    RECONNECT = "reconnect"
    RELEASE = "release"
    CLEAR_FAULT = "clear fault"
    COMPARE_PARAMETERS = "compare parameters"
    HOME = "home"
    CONFIRM = "confirm"


@dataclass(frozen=True, slots=True)
class WindowSnapshot:
    """All that the window knows about the machine at one moment.

    Attributes
    ----------
    robot : Robot
        For the units of its axes.
    session : SessionState
    playback : PlaybackState
    resuming : ResumeStep
        What the playback is waiting for before it resumes.
    penetration : PenetrationStatus
    procedure : str
        Another procedure that moves axes by itself, such as an autofocus; "" if there is none.
    """

    robot: Robot
    session: SessionState
    playback: PlaybackState = field(default_factory=PlaybackState)
    resuming: ResumeStep = ResumeStep.NONE
    penetration: PenetrationStatus = field(default_factory=PenetrationStatus)
    procedure: str = ""


@dataclass(frozen=True, slots=True)
class StateDisplay:
    """The state in one or two words, and a line with the reason or with what is moving.

    Attributes
    ----------
    headword, reason : str
    tone : StateTone
    remedy : StateRemedy or None
    """

    headword: str
    reason: str
    tone: StateTone
    remedy: StateRemedy | None = None


def describe_state(snapshot: WindowSnapshot) -> StateDisplay:
    """Return the display of the machine's state; if several apply, of the most severe one."""
    return next(display for rule in _RULES if (display := rule(snapshot)) is not None)


def _describe_connection(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the display while there is no device."""
    state = snapshot.session
    if state.connection is ConnectionState.FAILED:
        fault = translate_message(state.fault or "")
        if not state.link_lost:
            text = fault or translate("shell", "The device failed; reconnect it.")
            return StateDisplay(
                translate("shell", "Failed"),
                capitalise(text),
                StateTone.DANGER,
                StateRemedy.RECONNECT,
            )
        template = translate("shell", "No answer for {time}; the machine may have moved")
        text = template.format(time=format_age(state.age_s or 0.0))
        return StateDisplay(
            translate("shell", "Link lost"),
            f"{text}. {capitalise(fault)}".strip(),
            StateTone.DANGER,
            StateRemedy.RECONNECT,
        )
    if state.connection is ConnectionState.DISCONNECTED:
        return StateDisplay(
            translate("shell", "Disconnected"),
            translate("shell", "No machine is connected; nothing can be moved from here."),
            StateTone.QUIET,
            StateRemedy.CONNECT,
        )
    if state.connection is ConnectionState.CONNECTING or state.activity is DeviceState.CLOSED:
        return StateDisplay(
            translate("shell", "Connecting"),
            translate("shell", "Waiting for the first answer of the device."),
            StateTone.BUSY,
        )
    return None


def _describe_silence(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.silent_s <= 0.0:
        return None
    text = translate("shell", "No answer for {time}; commands are refused until it answers.")
    return StateDisplay(
        translate("shell", "Link lost"),
        text.format(time=format_age(state.silent_s)),
        StateTone.DANGER if state.latch_reason else StateTone.WARNING,
    )


def _describe_fault(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.fault is None and state.activity is not DeviceState.FAULT:
        return None
    fault = capitalise(translate_message(state.fault or "")) or translate(
        "shell", "The device reports a fault"
    )
    if state.latch_reason is not None:
        text = translate("shell", "{fault}. The machine is locked as well: release it first.")
        remedy = StateRemedy.RELEASE
    else:
        text = translate("shell", "{fault}. Check the machine, then clear the fault.")
        remedy = StateRemedy.CLEAR_FAULT
    return StateDisplay(
        translate("shell", "Fault"), text.format(fault=fault.rstrip(".")), StateTone.DANGER, remedy
    )


def _describe_latch(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.latch_reason is None:
        return None
    if state.activity in _MOVING_STATES:
        text = translate("shell", "The axes are still coming to rest.")
    elif state.stop is not None and state.latch_reason == STOP_AND_LOCK_REASON == state.stop.why:
        if state.stop.by == OPERATOR:
            template = translate("shell", "Locked by the operator at {time}. Release it to move.")
        else:
            template = translate("shell", "Locked by the program at {time}. Release it to move.")
        text = template.format(time=f"{state.stop.at:%H:%M:%S}")
    else:
        template_with_reason = translate("shell", "{reason} is active. Release it to move.")
        text = template_with_reason.format(reason=capitalise(translate_message(state.latch_reason)))
    return StateDisplay(translate("shell", "Locked"), text, StateTone.DANGER, StateRemedy.RELEASE)


def _describe_stopping(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    is_pausing = snapshot.playback.pausing and state.activity in _MOVING_STATES
    if not (state.stopping or is_pausing):
        return None
    if snapshot.playback.pausing:
        text = translate("shell", "The playback is being paused; the axes are coming to rest.")
    else:
        text = translate("shell", "The axes are coming to rest.")
    return StateDisplay(translate("shell", "Stopping"), text, StateTone.WARNING)


def _describe_homing(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.activity is not DeviceState.HOMING:
        return None
    axes = [axis for axis, owner in state.owners.items() if owner == HOMING]
    text = (
        translate("shell", "Moving to find the limit switches of {axes}.").format(
            axes=format_axes(state, axes)
        )
        if axes
        else translate("shell", "Moving to find the limit switches.")
    )
    return StateDisplay(translate("shell", "Homing"), text, StateTone.BUSY)


def _describe_playing(snapshot: WindowSnapshot) -> StateDisplay | None:
    state, playback = snapshot.session, snapshot.playback
    is_own_playback = playback.phase is PlaybackPhase.PLAYING
    is_device_playing = state.activity is DeviceState.PLAYING
    if not is_device_playing and not (is_own_playback and state.activity is DeviceState.IDLE):
        return None
    progress = state.progress
    if is_own_playback:
        progress = playback.path_s / playback.duration_s if playback.duration_s else 0.0
    if not is_device_playing:
        text = translate("shell", "The path is being checked; then the axes move.")
    elif state.progress <= 0.0:
        text = translate("shell", "The axes are moving to the start of the trajectory.")
    elif is_own_playback:
        remaining_s = (playback.duration_s - playback.path_s) / playback.speed
        text = translate("shell", "{movers}; {time} left").format(
            movers=describe_movers(state) or translate("shell", "A trajectory moves the axes"),
            time=format_duration(remaining_s),
        )
    else:
        text = describe_movers(state) or translate("shell", "A trajectory moves the axes")
    headword = translate("shell", "Playing {share:.0f} %").format(share=100.0 * progress)
    return _add_lock_reason(StateDisplay(headword, text, StateTone.BUSY), state)


def _describe_moving(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if state.activity is not DeviceState.MOVING:
        return None
    if snapshot.resuming is ResumeStep.RETURNING:
        text = translate("shell", "Moving back slowly to row {row}; then the playback resumes.")
        text = text.format(row=_format_row(snapshot.playback))
    else:
        text = describe_movers(state) or translate(
            "shell", "The machine moves without a command from this window; STOP halts it."
        )
    return _add_lock_reason(StateDisplay(translate("shell", "Moving"), text, StateTone.BUSY), state)


def _describe_lock(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the display of a machine at rest that accepts no motion."""
    state = snapshot.session
    if state.lock_reason is None and state.position_known:
        return None
    reason = state.lock_reason or ""
    text = (
        translate_message(reason) if reason else translate("shell", "the position is not known yet")
    )
    remedy = None
    if state.differences:
        remedy = StateRemedy.COMPARE_PARAMETERS
    elif state.unhomed:
        remedy = StateRemedy.HOME
    elif state.doubt is not None:
        remedy = StateRemedy.CONFIRM
    return StateDisplay(
        translate("shell", "Locked"), f"{capitalise(text)}.", StateTone.WARNING, remedy
    )


def _describe_penetration(snapshot: WindowSnapshot) -> StateDisplay | None:
    status = snapshot.penetration
    if status.phase not in {*RUNNING_PHASES, PenetrationPhase.ARMED, PenetrationPhase.HELD}:
        return None
    text = capitalise(translate_message(status.phase))
    if status.reason:
        text = f"{text}: {translate_message(status.reason)}"
    if status.phase in RUNNING_PHASES:
        continuation, tone = translate("shell", "it continues automatically"), StateTone.BUSY
    elif status.phase is PenetrationPhase.ARMED:
        continuation, tone = translate("shell", "its button starts the run"), StateTone.WARNING
    else:
        continuation, tone = (
            translate("shell", "it stays here until its axes are freed"),
            StateTone.WARNING,
        )
    return StateDisplay(translate("shell", "Penetration"), f"{text}; {continuation}.", tone)


def _describe_procedure(snapshot: WindowSnapshot) -> StateDisplay | None:
    """Return the display of a machine at rest that is about to move by itself."""
    state, headword = snapshot.session, translate("shell", "Moving")
    if snapshot.procedure:
        text = translate("shell", "{procedure} is under way and moves axes by itself.")
        return StateDisplay(
            headword,
            text.format(procedure=capitalise(translate_message(snapshot.procedure))),
            StateTone.BUSY,
        )
    if movers := describe_movers(state):
        return StateDisplay(headword, movers, StateTone.BUSY)
    if state.queued:
        return StateDisplay(
            headword, translate("shell", "A command is about to begin."), StateTone.BUSY
        )
    return None


def _describe_pause(snapshot: WindowSnapshot) -> StateDisplay | None:
    state, playback = snapshot.session, snapshot.playback
    if playback.phase is not PlaybackPhase.PAUSED:
        return None
    if snapshot.resuming is not ResumeStep.NONE:
        text = translate("shell", "It resumes as soon as the axes rest and the path is checked.")
    elif moved_text := describe_moved(snapshot.robot, playback):
        text = translate("shell", "{moved}; Resume asks how to continue.").format(moved=moved_text)
    elif playback.excess:
        text = translate("shell", "{excess}. Check the machine, then resume or end.").format(
            excess=capitalise(translate_message(playback.excess))
        )
    elif state.halted and state.stop is not None and state.stop.why != PAUSE_REASON:
        text = translate("shell", "{stopped}. Resume continues from here.").format(
            stopped=describe_stop(state.stop)
        )
    else:
        text = translate("shell", "At rest; Resume continues from here, End ends the playback.")
    headword = translate("shell", "Paused at row {row}").format(row=_format_row(playback))
    return StateDisplay(headword, text, StateTone.WARNING)


def _describe_stopped(snapshot: WindowSnapshot) -> StateDisplay | None:
    state = snapshot.session
    if not state.halted or state.stop is None:
        return None
    text = translate("shell", "{stopped}. The next command moves it again.")
    return StateDisplay(
        translate("shell", "Stopped"),
        text.format(stopped=describe_stop(state.stop)),
        StateTone.WARNING,
    )


def _describe_readiness(_: WindowSnapshot) -> StateDisplay:
    return StateDisplay(
        translate("shell", "Ready"),
        translate("shell", "At rest; every axis can be moved."),
        StateTone.GOOD,
    )


# The rules in order of severity, the most severe state first.
_RULES: tuple[Callable[[WindowSnapshot], StateDisplay | None], ...] = (
    _describe_connection,
    # A device with a fault may stop sending readings; that is not a lost link.
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


def _add_lock_reason(display: StateDisplay, state: SessionState) -> StateDisplay:
    if state.lock_reason is None:
        return display
    text = translate("shell", "{moving}. No new command is accepted: {reason}").format(
        moving=display.reason.rstrip("."), reason=translate_message(state.lock_reason)
    )
    return StateDisplay(display.headword, text, StateTone.WARNING)


def _format_row(playback: PlaybackState) -> str:
    return str(max(playback.row, 0) + 1)
