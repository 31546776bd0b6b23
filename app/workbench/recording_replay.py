"""The recording that is shown instead of the machine."""

import shlex
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.errors import RecordingError, RequestRefusedError
from rotemina.app.language import translate
from rotemina.app.motion.penetration import RUNNING_PHASES, PenetrationController, PenetrationPhase
from rotemina.app.motion.recording import PacedReplay, Recording, Replay, find_axis_units
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import DeviceState
from rotemina.sim.robot import Robot
from rotemina.sim.robot_files import format_robot


class ReplayControl(QObject):
    """Control of the replay that is shown; meanwhile the machine accepts no motion.

    During a replay the screen does not show the machine, so nobody could see what moves. A stop is
    always possible.

    Signals
    -------
    changed() : the window now shows another recording, or the machine again.
    """

    changed = Signal()

    def __init__(self, session: MotionSession, penetration: PenetrationController) -> None:
        super().__init__()
        self._session, self._penetration = session, penetration
        self.paced: PacedReplay | None = None

    def show(self, replay: Replay) -> None:
        """Show a recording from its beginning.

        Raises
        ------
        RequestRefusedError
            If the machine is not at rest, because it must not move unseen.
        """
        name = replay.recording.path.name
        self._refuse_unless_at_rest(name)
        self._session.bar_motion(
            translate("shell", "a replay of {name} is displayed; go back to live first").format(
                name=name
            )
        )
        try:
            # Checked again, because a motion may have begun before motion was barred.
            self._refuse_unless_at_rest(name)
        except RequestRefusedError:
            self.end()
            raise
        self.paced = PacedReplay(replay)
        self.paced.play()
        self.changed.emit()

    def end(self) -> None:
        """Show the machine again and permit motion."""
        self._session.bar_motion(None)
        if self.paced is not None:
            self.paced = None
            self.changed.emit()

    def step(self) -> None:
        """Advance the replay; called once per frame."""
        if self.paced is not None:
            self.paced.step()

    def _refuse_unless_at_rest(self, name: str) -> None:
        state, phase = self._session.snapshot(), self._penetration.status.phase
        if phase in RUNNING_PHASES | {PenetrationPhase.HELD}:
            raise RequestRefusedError(
                translate(
                    "shell", "{name} cannot be shown: a penetration is {phase}; end it first"
                ).format(name=name, phase=phase)
            )
        is_moving = state.activity not in (DeviceState.IDLE, DeviceState.CLOSED)
        # In a fault a device may report an activity that never ends.
        if (is_moving and state.fault is None) or state.queued:
            raise RequestRefusedError(
                translate(
                    "shell", "{name} cannot be shown: the machine is moving; wait, or stop it first"
                ).format(name=name)
            )


def open_recording(path: Path, robot: Robot) -> Replay:
    """Open a recording of a robot with the same axes.

    Raises
    ------
    RecordingError
        If it cannot be read or belongs to another robot; the message contains the command that
        shows it.
    RobotFileError
        If the robot file in it is invalid.
    """
    recording = Recording.open(path)
    if tuple(recording.units.items()) != tuple(find_axis_units(robot).items()):
        file = "robot.toml"
        raise RecordingError(
            translate(
                "shell",
                "{name}: recorded on robot {robot!r} with axes {axes}, but the robot of "
                "this window has {here}. Start a window for that robot: rotemina recording "
                "info --robot-file {path} > {file} && rotemina --robot {file}",
            ).format(
                name=path.name,
                robot=recording.metadata.get("robot", ""),
                axes=", ".join(recording.axes),
                here=", ".join(robot.axes),
                path=shlex.quote(str(path)),
                file=file,
            )
        )
    return Replay(recording)


def find_mismatch(replay: Replay, robot: Robot) -> str | None:
    """Return a warning if a replay was recorded with another robot file, else None."""
    if replay.recording.metadata.get("robot_file", "") == format_robot(robot):
        return None
    return translate(
        "shell",
        "{name}: recorded with another robot file; ranges and scales on the screen "
        "are those of this window",
    ).format(name=replay.recording.path.name)
