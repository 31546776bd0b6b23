"""Whether the device's position can be trusted: what causes doubt, and what resolves it."""

from collections.abc import Iterable

from rotemina.app.motion.following_error_watch import PositionWatch
from rotemina.drivers.samples import Samples
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

LOST = message("engine", "the connection was lost")


class PositionTrust:
    """Doubt about axes; while there is any, motion is locked.

    An axis is believed again when its switch was found, or when someone who has looked confirms
    all of them. Used on the worker's thread.

    Parameters
    ----------
    robot : Robot
    """

    def __init__(self, robot: Robot) -> None:
        self._watch = PositionWatch(robot)
        self._doubtful: frozenset[str] = frozenset()
        #: Why the position may be wrong; None while it is believed.
        self.reason: str | None = None

    def restart(self) -> None:
        """Forget past readings, as after a gap; a doubt stays."""
        self._watch.restart()

    def doubt(self, reason: str, axes: Iterable[str]) -> None:
        """Distrust the positions of axes; the first reason is the reported one."""
        self._doubtful |= frozenset(axes)
        self.reason = self.reason or reason

    def judge(self, samples: Samples) -> tuple[str | None, tuple[str, ...]]:
        """Return why the machine must stop now, if it must, and reasons only to report."""
        judged = self._watch.judge(samples)
        if judged.lock is None:
            return None, judged.alarms
        news = judged.axis not in self._doubtful
        self.doubt(judged.lock, (judged.axis,))
        return judged.lock if news else None, judged.alarms

    def homed(self, axes: Iterable[str]) -> None:
        """Believe axes whose switches were found."""
        self._doubtful -= frozenset(axes)
        if not self._doubtful:
            self.reason = None

    def confirm(self) -> None:
        """Trust all positions, on an operator's confirmation."""
        self._doubtful, self.reason = frozenset(), None
        self._watch.restart()
