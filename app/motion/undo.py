"""Safe paths between two positions, and the one back to the previous: retract, travel, approach."""

from collections import deque
from collections.abc import Mapping

from rotemina.app.motion.mailbox import RefusedError
from rotemina.sim.messages import message
from rotemina.sim.robot.model import Robot

CLEARANCE = 1e-3  # m above both ends, where the range allows
_LIFT = "z"
_KEPT = 50


def safe_path(
    robot: Robot, now: Mapping[str, float], goal: Mapping[str, float]
) -> tuple[dict[str, float], ...]:
    """Return the segments of a path: raise the tip above both ends, move across, lower it.

    An obstacle present when one end was left may still be in between.

    Parameters
    ----------
    robot : Robot
        One that has no z goes straight.
    now : mapping axis -> float
        Where the axes are, m or rad.
    goal : mapping axis -> float
        Where they are to be; an axis that is not in it stays.
    """
    if _LIFT not in robot.axes or _LIFT not in now:
        return (dict(goal),)
    down = goal.get(_LIFT, now[_LIFT])
    across = {axis: at for axis, at in goal.items() if axis != _LIFT}
    if all(abs(now.get(axis, at) - at) == 0.0 for axis, at in across.items()):
        return ({_LIFT: down},)
    above = min(max(now[_LIFT], down) + CLEARANCE, robot.axes[_LIFT].range[1])
    return ({_LIFT: above}, across, {_LIFT: down})


class Undo:
    """Where the axes rested before each move, latest last.

    A way back lifts the tip above both ends, goes across, and comes down at last: whatever stood
    between them when the move was made may still stand there.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._places: deque[dict[str, float]] = deque(maxlen=_KEPT)

    def __len__(self) -> int:
        return len(self._places)

    def note(self, place: Mapping[str, float]) -> None:
        """Keep where the axes rest before a move."""
        if place and (not self._places or self._places[-1] != place):
            self._places.append(dict(place))

    def leads_from(self, now: Mapping[str, float]) -> bool:
        """Whether there is a previous position other than the present one."""
        return any(place != now for place in self._places)

    def forget(self) -> None:
        """Keep nothing: positions of before a lost connection mean nothing."""
        self._places.clear()

    def back(self, now: Mapping[str, float]) -> tuple[dict[str, float], ...]:
        """Return the segments of the way back to the latest place that is not here, and drop it.

        Raises
        ------
        RefusedError
            If there is none.
        """
        while self._places and self._places[-1] == now:
            self._places.pop()
        if not self._places:
            raise RefusedError(message("engine", "there is no previous position"))
        goal = self._places.pop()
        return safe_path(self._robot, now, goal)
