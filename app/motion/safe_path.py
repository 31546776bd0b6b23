"""A safe path between two positions: retract, travel, approach."""

from collections.abc import Mapping

from rotemina.sim.robot.model import Robot

CLEARANCE = 1e-3  # m above both ends, where the range allows
_LIFT = "z"


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
