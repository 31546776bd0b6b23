"""The session's phase as screens show it: one word, and how grave it is."""

from enum import StrEnum

from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.display_units import label
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import Connection, Phase, SessionState
from rotemina.app.motion.stop import LOCKED, StopRequest
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked, translate
from rotemina.app.widgets.controls import set_property
from rotemina.app.widgets.labels import LiveLabel
from rotemina.drivers.samples import DeviceState


class Tone(StrEnum):
    """How grave a word is; the style sheet has a colour for each."""

    GOOD = "good"
    BUSY = "busy"
    WARNING = "warning"
    DANGER = "danger"
    QUIET = "quiet"


_TONES = {
    Phase.DISCONNECTED: Tone.QUIET,
    Phase.CONNECTING: Tone.BUSY,
    Phase.READY: Tone.GOOD,
    Phase.MOVING: Tone.BUSY,
    Phase.STOPPING: Tone.WARNING,
    Phase.SHORT_LOSS: Tone.WARNING,
    Phase.FAULT: Tone.DANGER,
    Phase.POSITION_UNKNOWN: Tone.WARNING,
}


_WORDS = {
    Phase.DISCONNECTED: marked("shell", "disconnected"),
    Phase.CONNECTING: marked("shell", "connecting"),
    Phase.READY: marked("shell", "ready"),
    Phase.MOVING: marked("shell", "moving"),
    Phase.STOPPING: marked("shell", "stopping"),
    Phase.SHORT_LOSS: marked("shell", "short loss"),
    Phase.FAULT: marked("shell", "fault"),
    Phase.POSITION_UNKNOWN: marked("shell", "position unknown"),
}


def word(state: SessionState) -> str:
    """Return how the session stands, in a word or two."""
    if state.connection is Connection.FAILED:
        return translate("shell", "failed")
    if state.phase is Phase.READY and state.locked is not None:
        return translate("shell", "locked")
    return translate("shell", _WORDS[state.phase])


def headword(state: SessionState, playback: PlaybackState) -> str:
    """Return how the session stands as the header says it, with how far a playback is."""
    ready = state.phase is Phase.READY and state.locked is None
    if state.activity is DeviceState.PLAYING:
        text = translate("shell", "Playing {share:.0f} %").format(share=100.0 * state.progress)
    elif ready and playback.phase is PlaybackPhase.PAUSED:
        text = translate("shell", "Paused at row {row}").format(row=max(playback.row, 0) + 1)
    elif state.phase is Phase.SHORT_LOSS or (state.fault and state.silent_s > 0.0):
        text = translate("shell", "Link lost")
    elif ready and _halted(state):
        text = translate("shell", "Stopped")
    else:
        text = word(state)
    return text[:1].upper() + text[1:]


def _halted(state: SessionState) -> bool:
    """Whether a stop is the last thing that happened, which has not been released since."""
    return state.stop is not None and state.stop.why != LOCKED


def tone(state: SessionState) -> Tone:
    """Return how grave that is."""
    if state.connection is Connection.FAILED or state.latched is not None:
        return Tone.DANGER
    if state.phase is Phase.READY and state.locked is not None:
        return Tone.WARNING
    return _TONES[state.phase]


def doing(state: SessionState) -> str:
    """Return what the robot does, or why it does not move; "" when it may be told to."""
    if state.activity is DeviceState.PLAYING:
        return driven(state)
    if state.activity is DeviceState.HOMING:
        return translate("shell", "searching for its limit switches")
    if state.locked is not None:
        reason = spoken(state.locked)
        return reason[:1].upper() + reason[1:]
    told = stopped(state.stop) if state.stop is not None and _halted(state) else ""
    return driven(state) or told


def stopped(request: StopRequest) -> str:
    """Return who asked for a stop, when and why."""
    by_operator = request.by == OPERATOR
    text = (
        translate("shell", "Stopped by the operator at {time}")
        if by_operator
        else translate("shell", "Stopped by the program at {time}")
    ).format(time=f"{request.at:%H:%M:%S}")
    return f"{text}: {spoken(request.why)}" if request.why else text


def driven(state: SessionState) -> str:
    """Return who drives which axes; "" where nobody does."""
    owned: dict[str, list[str]] = {}
    for axis, owner in state.owners.items():
        owned.setdefault(owner, []).append(label(axis))
    return "; ".join(f"{', '.join(axes)}: {spoken(owner)}" for owner, axes in owned.items())


def set_tone(widget: QWidget, value: Tone) -> None:
    """Give a widget the colours of a tone."""
    set_property(widget, "tone", str(value))


class PhaseLabel(LiveLabel):
    """The phase in one word, in its colour."""

    def __init__(self) -> None:
        super().__init__("–")
        self.setAccessibleName(translate("shell", "Phase of the session"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, Tone.QUIET)

    def show_state(self, state: SessionState) -> None:
        """Show the phase of a state."""
        self.setText(word(state))
        set_tone(self, tone(state))
