"""Safe paths between two positions (up, across, down), and the path back to an earlier one."""

from collections import deque
from collections.abc import Mapping

from rotemina.app.errors import RequestRefusedError
from rotemina.sim.robot import Robot

# The tip rises this far above both ends, if the range permits.
CLEARANCE_M = 1e-3
_LIFT_AXIS = "z"
_MAX_POSITION_COUNT = 50


def plan_safe_path(
    robot: Robot, now: Mapping[str, float], goal: Mapping[str, float]
) -> tuple[dict[str, float], ...]:
    """Return the waypoints of a path: raise the tip above both ends, move across, lower it.

    Parameters
    ----------
    robot : Robot
        A robot without an axis z moves directly.
    now : mapping axis -> float
        Current positions, m or rad.
    goal : mapping axis -> float
        Target positions, m or rad. Other axes stay where they are.
    """
    if _LIFT_AXIS not in robot.axes or _LIFT_AXIS not in now:
        return (dict(goal),)
    end_height = goal.get(_LIFT_AXIS, now[_LIFT_AXIS])
    lateral_targets = {axis: target for axis, target in goal.items() if axis != _LIFT_AXIS}
    if all(abs(now.get(axis, target) - target) == 0.0 for axis, target in lateral_targets.items()):
        return ({_LIFT_AXIS: end_height},)
    travel_height = min(
        max(now[_LIFT_AXIS], end_height) + CLEARANCE_M, robot.axes[_LIFT_AXIS].range[1]
    )
    return ({_LIFT_AXIS: travel_height}, lateral_targets, {_LIFT_AXIS: end_height})


class UndoHistory:
    """Positions at which the axes rested before each move, latest last.

    The path back rises above both ends, moves across, and descends, because an obstacle that the
    move went around may still be there.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._positions: deque[dict[str, float]] = deque(maxlen=_MAX_POSITION_COUNT)

    def __len__(self) -> int:
        return len(self._positions)

    def note(self, position: Mapping[str, float]) -> None:
        """Add the position at which the axes rest before a move."""
        if position and (not self._positions or self._positions[-1] != position):
            self._positions.append(dict(position))

    def has_previous(self, now: Mapping[str, float]) -> bool:
        """Return whether there is a previous position other than the current one."""
        return any(position != now for position in self._positions)

    def forget(self) -> None:
        """Forget all positions, for example because the connection was lost."""
        self._positions.clear()

    def plan_return(self, now: Mapping[str, float]) -> tuple[dict[str, float], ...]:
        """Return the waypoints of a safe path to the latest other position, and drop it.

        Raises
        ------
        RequestRefusedError
            If there is no such position.
        """
        while self._positions and self._positions[-1] == now:
            self._positions.pop()
        if not self._positions:
            raise RequestRefusedError("there is no previous position")
        goal = self._positions.pop()
        return plan_safe_path(self._robot, now, goal)
