"""Which recording is shown in place of the machine, if any."""

import shlex
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.status import UNDER_WAY, Phase
from rotemina.app.motion.recording.arrow_tables import units_of
from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.replay import Replay
from rotemina.app.motion.recording.replay_pace import PacedReplay
from rotemina.app.motion.session import MotionSession
from rotemina.app.shell.language import translate
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.model import Robot
from rotemina.sim.robot.writing import robot_text


class Replaying(QObject):
    """Holds the replay that is shown; meanwhile the machine accepts no motion, on any path.

    What the screen shows then is not the machine, so nobody could see what moves. A stop is
    always possible.

    Signals
    -------
    changed() : another recording is shown from now on, or the machine again.
    """

    changed = Signal()

    def __init__(self, session: MotionSession, penetration: Penetration) -> None:
        super().__init__()
        self._session, self._penetration = session, penetration
        self.paced: PacedReplay | None = None

    def show(self, replay: Replay) -> None:
        """Show a recording from its begin on.

        Raises
        ------
        RefusedError
            If the machine is not at rest: it must not move out of sight.
        """
        name = replay.recording.path.name
        self._refuse_unless_at_rest(name)
        self._session.bar(
            translate("shell", "a replay of {name} is displayed; go back to live first").format(
                name=name
            )
        )
        try:
            self._refuse_unless_at_rest(name)  # nothing can have begun from here on
        except RefusedError:
            self.end()
            raise
        self.paced = PacedReplay(replay)
        self.paced.play()
        self.changed.emit()

    def end(self) -> None:
        """Show the machine again, which may be moved from now on."""
        self._session.bar(None)
        if self.paced is not None:
            self.paced = None
            self.changed.emit()

    def step(self) -> None:
        """Advance; once a frame."""
        if self.paced is not None:
            self.paced.step()

    def _refuse_unless_at_rest(self, name: str) -> None:
        state, phase = self._session.snapshot(), self._penetration.status.phase
        if phase in UNDER_WAY | {Phase.HELD}:
            raise RefusedError(
                translate(
                    "shell", "{name} cannot be shown: a penetration is {phase}; end it first"
                ).format(name=name, phase=phase)
            )
        moves = state.activity not in (DeviceState.IDLE, DeviceState.CLOSED)
        # In a fault a device may name no activity that anybody could wait for.
        if (moves and state.fault is None) or state.queued:
            raise RefusedError(
                translate(
                    "shell", "{name} cannot be shown: the machine is moving; wait, or stop it first"
                ).format(name=name)
            )


def opened(path: Path, robot: Robot) -> Replay:
    """Open a recording of a robot with the same axes.

    Raises
    ------
    RecordingError
        If it cannot be read, or is of another robot; with the command that shows it.
    RobotFileError
        If the robot file in it is none for this program.
    """
    recording = Recording.open(path)
    if tuple(recording.units.items()) != tuple(units_of(robot).items()):
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


def remark(replay: Replay, robot: Robot) -> str | None:
    """Return what is to be known of a replay on this robot; None for nothing."""
    if replay.recording.metadata.get("robot_file", "") == robot_text(robot):
        return None
    return translate(
        "shell",
        "{name}: recorded with another robot file; ranges and scales on the screen "
        "are those of this window",
    ).format(name=replay.recording.path.name)
