"""The state of the machine in words, with the colours of its severity."""

from collections.abc import Iterable
from enum import StrEnum

from PySide6.QtWidgets import QSizePolicy, QWidget

from rotemina.app.language import format_duration, get_axis_label, translate, translate_message
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.playback import PlaybackState
from rotemina.app.motion.state import ConnectionState, SessionState, StopRequest
from rotemina.app.widgets.controls import set_property
from rotemina.app.widgets.text import LiveLabel
from rotemina.drivers.contract import DeviceState
from rotemina.sim.messages import format_fixed
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_quantity


class StateTone(StrEnum):
    """Severity of a word; the style sheet has a colour for each."""

    GOOD = "good"
    BUSY = "busy"
    WARNING = "warning"
    DANGER = "danger"
    QUIET = "quiet"


def set_tone(widget: QWidget, value: StateTone) -> None:
    """Set the colours of a widget to those of a tone."""
    set_property(widget, "tone", str(value))


class PhaseLabel(LiveLabel):
    """The state in one or two words, in its colour."""

    def __init__(self) -> None:
        super().__init__("–")
        self.setAccessibleName(translate("shell", "Phase of the session"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        set_tone(self, StateTone.QUIET)

    def show_phase(self, word: str, tone: StateTone) -> None:
        """Show a word in the colour of its tone."""
        self.setText(word)
        set_tone(self, tone)


def describe_movers(state: SessionState) -> str:
    """Return who moves which axes, or ""."""
    axes_by_owner: dict[str, list[str]] = {}
    for axis, owner in state.owners.items():
        axes_by_owner.setdefault(owner, []).append(axis)
    sentences = [
        translate("shell", "{owner} moves {axes}").format(
            owner=capitalise(translate_message(owner)), axes=format_axes(state, axes)
        )
        for owner, axes in axes_by_owner.items()
    ]
    return "; ".join(sentences)


def describe_motion(state: SessionState) -> str:
    """Return who moves which axes, that none moves, or that this is unknown."""
    if movers := describe_movers(state):
        return movers
    if state.connection is not ConnectionState.CONNECTED or state.silent_s > 0.0:
        return translate("shell", "Not known: the machine does not answer.")
    if state.activity in (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING):
        return translate("shell", "Axes are moving.")
    return translate("shell", "No axis is moving.")


def describe_stop(request: StopRequest) -> str:
    """Return who requested a stop, when and why."""
    by_operator = request.by == OPERATOR
    text = (
        translate("shell", "Stopped by the operator at {time}")
        if by_operator
        else translate("shell", "Stopped by the program at {time}")
    ).format(time=f"{request.at:%H:%M:%S}")
    return f"{text}: {translate_message(request.why)}" if request.why else text


def describe_moved(robot: Robot, playback: PlaybackState) -> str:
    """Return which axes were moved since the pause and how far, or ""."""
    parts = [
        translate("shell", "{axis} moved {distance}").format(
            axis=get_axis_label(axis),
            distance=format_quantity(abs(distance), robot.unit(axis) or "", digits=2),
        )
        for axis, distance in playback.moved.items()
    ]
    if not parts:
        return ""
    return translate("shell", "{parts} since the pause").format(parts=", ".join(parts))


def format_axes(state: SessionState, axes: Iterable[str]) -> str:
    """Return the names of axes, or "all axes" for all of several."""
    axes = tuple(axes)
    if len(axes) > 1 and state.command and set(axes) >= set(state.command):
        return translate("shell", "all axes")
    return ", ".join(map(get_axis_label, axes))


def capitalise(text: str) -> str:
    """Return a text with a capital first letter; names of axes such as θx are unchanged."""
    return text if text[:1] in "θ" else text[:1].upper() + text[1:]


def format_age(seconds: float) -> str:
    """Return a time span as text: in seconds below a minute, then in minutes."""
    if seconds < 60.0:
        return f"{format_fixed(seconds, 1 if seconds < 10.0 else 0)} s"
    return format_duration(seconds)
