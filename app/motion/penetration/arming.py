"""What must be true before a penetration may begin."""

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.attempt import Attempt
from rotemina.app.motion.penetration.errors import PenetrationError
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.thrust import ThrustPlan, plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.abilities import ProfileRunner, VelocityMover
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.wording import readable

LEASE_S = 0.15  # of the approach: without a host it ends after that
_OVERSHOOT_S = 0.2  # of approach: until a contact is sure, seen, and the axis at rest


def armed(session: MotionSession, parameters: PenetrationParameters, owner: str) -> Attempt:
    """Reserve every axis and return the attempt, all of whose way has been checked.

    Raises
    ------
    InputError
        With what is missing, the value, the bound, and what to do; then nothing is reserved.
    """
    _check_device(session, parameters)
    _check_axis(session.robot, parameters)
    session.reserve(owner)
    try:
        plan = plan_thrust(session.robot, parameters, session.setpoint_period_s)
        start = session.snapshot().command[parameters.axis]
        farthest = _check_room(session.robot, parameters, plan, start)
        plan.profile.check(session.robot, start)
        deepest = plan.ends[1] if parameters.sign > 0.0 else -plan.ends[0]
        contact = farthest - parameters.sign * deepest
        name, least = parameters.axis, min(start, farthest)
        session.check_thrust(name, (least, max(start, farthest)), 0.0, owner)
        low, high = sorted((contact, farthest))
        session.check_thrust(name, (low, high), plan.peak_speed, owner)
    except BaseException:
        session.set_free(owner)
        raise
    return Attempt(parameters, plan, start)


def _check_device(session: MotionSession, parameters: PenetrationParameters) -> None:
    driver = session.driver
    if not isinstance(driver, ProfileRunner):
        raise RefusedError(
            f"driver {driver.name!r} cannot run profiles by itself; a thrust needs that"
        )
    if not isinstance(driver, VelocityMover):
        raise RefusedError(
            f"driver {driver.name!r} cannot move at a speed; the approach needs that"
        )
    if parameters.inject_s > 0.0 and session.tool_on is None:
        raise RefusedError(
            f"driver {driver.name!r} has no tool that could inject; set inject_s to 0"
        )


def _check_axis(robot: Robot, parameters: PenetrationParameters) -> None:
    name = parameters.axis
    if name not in robot.axes:
        raise PenetrationError(
            f"robot {robot.name!r} has no axis {name!r} to penetrate with; it has "
            f"{', '.join(robot.axes)}"
        )
    if robot.unit(name) != "m":
        raise PenetrationError(
            f"axis {name} of {robot.name!r} turns; a penetration needs a way in m"
        )
    axis = robot.axes[name]
    if axis.max_speed is not None and parameters.approach_speed > axis.max_speed:
        raise PenetrationError(
            f"approach_speed = {readable(parameters.approach_speed, 'm')}/s: axis {name} goes at "
            f"{readable(axis.max_speed, 'm')}/s at most"
        )


def _check_room(
    robot: Robot, parameters: PenetrationParameters, plan: ThrustPlan, start: float
) -> float:
    """Return the farthest position of all, m; refuse if it is beyond the range."""
    low, high = plan.ends
    thrust = high if parameters.sign > 0.0 else -low
    reserve = parameters.approach_speed * _OVERSHOOT_S
    needed = parameters.approach_distance + reserve + thrust
    ends = robot.axes[parameters.axis].range
    left = ends[1] - start if parameters.sign > 0.0 else start - ends[0]
    if needed > left:
        raise PenetrationError(
            f"axis {parameters.axis}: {readable(left, 'm')} of its range are left "
            f"{parameters.direction}wards, {readable(needed, 'm')} are needed "
            f"({readable(parameters.approach_distance, 'm')} to approach, "
            f"{readable(reserve, 'm')} to halt, {readable(thrust, 'm')} to thrust); move the axis "
            "back first, or shorten them"
        )
    return start + parameters.sign * needed
