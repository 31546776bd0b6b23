"""Sentences about the state of the machine: who moves what, who stopped it, what was moved."""

from collections.abc import Iterable

from rotemina.app.display_units import duration_text, label
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.playback import PlaybackState
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.motion.stop import StopRequest
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import translate
from rotemina.drivers.samples import DeviceState
from rotemina.sim.quantities import amount, fixed
from rotemina.sim.robot.model import Robot


def describe_movers(state: SessionState) -> str:
    """Return who moves which axes; "" where nobody does."""
    owned: dict[str, list[str]] = {}
    for axis, owner in state.owners.items():
        owned.setdefault(owner, []).append(axis)
    sentences = [
        translate("shell", "{owner} moves {axes}").format(
            owner=sentence(spoken(owner)), axes=axes_text(state, axes)
        )
        for owner, axes in owned.items()
    ]
    return "; ".join(sentences)


def describe_motion(state: SessionState) -> str:
    """Return who moves which axes, that none moves, or that nobody can know."""
    if movers := describe_movers(state):
        return movers
    if state.connection is not Connection.CONNECTED or state.silent_s > 0.0:
        return translate("shell", "Not known: the machine does not answer.")
    if state.activity in (DeviceState.MOVING, DeviceState.PLAYING, DeviceState.HOMING):
        return translate("shell", "Axes are moving.")
    return translate("shell", "No axis is moving.")


def describe_stop(request: StopRequest) -> str:
    """Return who asked for a stop, when and why."""
    by_operator = request.by == OPERATOR
    text = (
        translate("shell", "Stopped by the operator at {time}")
        if by_operator
        else translate("shell", "Stopped by the program at {time}")
    ).format(time=f"{request.at:%H:%M:%S}")
    return f"{text}: {spoken(request.why)}" if request.why else text


def describe_moved(robot: Robot, playback: PlaybackState) -> str:
    """Return which axes were moved since the pause, and how far; "" if none was."""
    parts = [
        translate("shell", "{axis} moved {distance}").format(
            axis=label(axis),
            distance=amount(abs(distance), robot.unit(axis) or "", digits=2),
        )
        for axis, distance in playback.moved.items()
    ]
    if not parts:
        return ""
    return translate("shell", "{parts} since the pause").format(parts=", ".join(parts))


def axes_text(state: SessionState, axes: Iterable[str]) -> str:
    """Return the names of axes; all of several are called so."""
    axes = tuple(axes)
    if len(axes) > 1 and state.command and set(axes) >= set(state.command):
        return translate("shell", "all axes")
    return ", ".join(map(label, axes))


def sentence(text: str) -> str:
    """Return a text that begins as a sentence does; names of axes keep their letters."""
    return text if text[:1] in "θ" else text[:1].upper() + text[1:]


def age_text(seconds: float) -> str:
    """Return a time as people say it: seconds, then minutes."""
    if seconds < 60.0:
        return f"{fixed(seconds, 1 if seconds < 10.0 else 0)} s"
    return duration_text(seconds)
