"""What must be true before a penetration may begin."""

from typing import NamedTuple

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


class TravelMargin(NamedTuple):
    """The way that a penetration takes at most, and what the range leaves for it; m.

    Attributes
    ----------
    approach, halt, thrust : float
        The parts of the way; the thrust as it is commanded.
    left : float
        From where the axis stands to the end of its range.
    """

    approach: float
    halt: float
    thrust: float
    left: float

    @property
    def needed(self) -> float:
        """All of the way."""
        return self.approach + self.halt + self.thrust


def armed(session: MotionSession, parameters: PenetrationParameters, owner: str) -> Attempt:
    """Reserve every axis and return the attempt, all of whose way has been checked.

    Raises
    ------
    InputError
        With what is missing, the value, the bound, and what to do; then nothing is reserved.
    """
    _check_device(session, parameters)
    plan = planned(session, parameters)
    session.reserve(owner)
    try:
        start = session.snapshot().command[parameters.axis]
        _check_way(session, parameters, plan, start)
    except BaseException:
        session.set_free(owner)
        raise
    return Attempt(parameters, plan, start)


def check_now(
    session: MotionSession, parameters: PenetrationParameters, plan: ThrustPlan, owner: str
) -> None:
    """Refuse what :func:`armed` would refuse now, by the same checks; nothing is reserved.

    Raises
    ------
    InputError
        As :func:`armed`.
    """
    _check_device(session, parameters)
    session.check_reservable(owner)
    _check_way(session, parameters, plan, session.snapshot().command[parameters.axis])


def planned(session: MotionSession, parameters: PenetrationParameters) -> ThrustPlan:
    """Return the thrust of parameters on this robot, wherever it stands.

    Raises
    ------
    InputError
        If the robot has no such axis, or as :func:`plan_thrust`.
    """
    _check_axis(session.robot, parameters)
    return plan_thrust(session.robot, parameters, session.setpoint_period_s)


def travel_margin(
    robot: Robot, parameters: PenetrationParameters, plan: ThrustPlan, start: float
) -> TravelMargin:
    """Return the room that is needed and left, from a position ``start`` of the axis, m."""
    low, high = plan.ends
    ends = robot.axes[parameters.axis].range
    return TravelMargin(
        parameters.approach_distance,
        parameters.approach_speed * _OVERSHOOT_S,
        high if parameters.sign > 0.0 else -low,
        ends[1] - start if parameters.sign > 0.0 else start - ends[0],
    )


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


def _check_way(
    session: MotionSession, parameters: PenetrationParameters, plan: ThrustPlan, start: float
) -> None:
    """Refuse a way that leaves the range or the tip's bounds, or a thrust that is too fast."""
    name, taken = parameters.axis, travel_margin(session.robot, parameters, plan, start)
    _check_room(parameters, taken)
    plan.profile.check(session.robot, start)
    farthest = start + parameters.sign * taken.needed
    contact = farthest - parameters.sign * taken.thrust
    session.check_thrust(name, _sorted(start, farthest), 0.0)
    session.check_thrust(name, _sorted(contact, farthest), plan.peak_speed)


def _check_room(parameters: PenetrationParameters, taken: TravelMargin) -> None:
    if taken.needed > taken.left:
        raise PenetrationError(
            f"axis {parameters.axis}: {readable(taken.left, 'm')} of its range are left "
            f"{parameters.direction}wards, {readable(taken.needed, 'm')} are needed "
            f"({readable(taken.approach, 'm')} to approach, {readable(taken.halt, 'm')} to halt, "
            f"{readable(taken.thrust, 'm')} to thrust); move the axis back first, or shorten them"
        )


def _sorted(one: float, other: float) -> tuple[float, float]:
    return min(one, other), max(one, other)
