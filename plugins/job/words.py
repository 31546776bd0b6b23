"""Text about running jobs. Free of Qt."""

from pathlib import Path
from typing import NamedTuple

from rotemina.app.display_units import duration_text, size_text
from rotemina.app.motion.ownership import PLAYBACK
from rotemina.app.motion.penetration.status import PenetrationStatus, Phase
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.state_words import describe_moved, describe_movers
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.job import tr
from rotemina.plugins.penetration.words import headline
from rotemina.sim.robot.model import Robot


class Running(NamedTuple):
    """The state of a job.

    Attributes
    ----------
    name, doing : str
    time : str
        That is left, or has passed; it may be empty.
    share : float or None
        That is done, 0 to 1; None: nobody knows.
    """

    name: str
    doing: str = ""
    time: str = ""
    share: float | None = None


def playback(state: PlaybackState, name: str, robot: Robot) -> Running:
    """Return the state of a playback, or that ``name`` is ready to be played."""
    if not name:
        return Running(tr("No trajectory is loaded"))
    if state.phase is PlaybackPhase.IDLE:
        return Running(name, tr("loaded"))
    row = tr("row {row} of {rows}").format(row=max(state.row, 0) + 1, rows=state.rows)
    if state.phase is PlaybackPhase.PAUSED:
        row = describe_moved(robot, state) or tr("paused, {row}").format(row=row)
    left_s = (state.duration_s - state.path_s) / state.speed
    left = tr("{time} left").format(time=duration_text(left_s))
    share = state.path_s / state.duration_s if state.duration_s else 0.0
    return Running(name, row, left, share)


def penetration(status: PenetrationStatus) -> Running | None:
    """Return the state of a penetration; None while nothing is armed."""
    if status.phase is Phase.DISARMED:
        return None
    return Running(headline(status), spoken(status.reason) if status.reason else "")


def recording(path: Path, since_s: float, size: int, failure: str | None) -> Running:
    """Return the state of a recording: name, duration and size, or why there is none."""
    doing = tr("not recording: {why}").format(why=failure) if failure else ""
    return Running(path.name, doing or size_text(size), duration_text(since_s))


def motion(state: SessionState) -> Running | None:
    """Return who moves what; None where nothing moves, or what does has a card of its own."""
    if state.activity in (DeviceState.IDLE, DeviceState.CLOSED, DeviceState.PLAYING):
        return None
    if PLAYBACK in state.owners.values():
        return None
    return Running(describe_movers(state) or tr("The axes are moving"))
