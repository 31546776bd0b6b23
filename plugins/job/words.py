"""Texts about running jobs. Does not use Qt."""

from pathlib import Path
from typing import NamedTuple

from rotemina.app.language import format_duration, format_file_size, translate_message
from rotemina.app.motion.device import PLAYBACK
from rotemina.app.motion.penetration import PenetrationPhase, PenetrationStatus
from rotemina.app.motion.playback import PlaybackPhase, PlaybackState
from rotemina.app.motion.state import SessionState
from rotemina.app.workbench import describe_moved, describe_movers
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.job import tr
from rotemina.plugins.penetration import format_headline
from rotemina.sim.robot import Robot


class JobState(NamedTuple):
    """State of a job as shown on its card.

    Attributes
    ----------
    name, activity : str
    time : str
        The remaining or the elapsed time; may be empty.
    share : float or None
        The completed fraction, 0 to 1, or None if it is unknown.
    """

    name: str
    activity: str = ""
    time: str = ""
    share: float | None = None


def describe_playback_job(state: PlaybackState, name: str, robot: Robot) -> JobState:
    """Return the state of the playback; ``name`` is the loaded trajectory, or "" for none."""
    if not name:
        return JobState(tr("No trajectory is loaded"))
    if state.phase is PlaybackPhase.IDLE:
        return JobState(name, tr("loaded"))
    activity = tr("row {row} of {rows}").format(row=max(state.row, 0) + 1, rows=state.rows)
    if state.phase is PlaybackPhase.PAUSED:
        activity = describe_moved(robot, state) or tr("paused, {row}").format(row=activity)
    remaining_s = (state.duration_s - state.path_s) / state.speed
    time_left = tr("{time} left").format(time=format_duration(remaining_s))
    fraction = state.path_s / state.duration_s if state.duration_s else 0.0
    return JobState(name, activity, time_left, fraction)


def describe_penetration_job(status: PenetrationStatus) -> JobState | None:
    """Return the state of a penetration, or None while none is armed."""
    if status.phase is PenetrationPhase.DISARMED:
        return None
    return JobState(
        format_headline(status), translate_message(status.reason) if status.reason else ""
    )


def describe_recording_job(
    path: Path, elapsed_s: float, byte_count: int, failure: str | None
) -> JobState:
    """Return the state of a recording: name, duration, and size or the reason for a failure."""
    failure_text = tr("not recording: {why}").format(why=failure) if failure else ""
    return JobState(
        path.name, failure_text or format_file_size(byte_count), format_duration(elapsed_s)
    )


def describe_motion_job(state: SessionState) -> JobState | None:
    """Return who moves which axes.

    Return None if nothing moves, or if a trajectory is playing, which has a separate card.
    """
    if state.activity in (DeviceState.IDLE, DeviceState.CLOSED, DeviceState.PLAYING):
        return None
    if PLAYBACK in state.owners.values():
        return None
    return JobState(describe_movers(state) or tr("The axes are moving"))
