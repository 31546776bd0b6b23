"""Conditions for arming a penetration."""

from typing import NamedTuple

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.penetration.attempt import Attempt
from rotemina.app.motion.penetration.parameters import PenetrationError, PenetrationParameters
from rotemina.app.motion.penetration.thrust import ThrustPlan, plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.abilities import ProfileRunner, VelocityMover
from rotemina.sim.messages import AxisName, message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import Robot

_NANO = "zn"  # moves along the tip as z does, which so makes up for it
LEASE_S = 0.15  # of the approach: without a host it ends after that
_OVERSHOOT_S = 0.2  # of approach: until a contact is sure, seen, and the axis at rest


class TravelMargin(NamedTuple):
    """The travel that a penetration needs at most, and the travel available; m.

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
        """The total travel."""
        return self.approach + self.halt + self.thrust


def armed(session: MotionSession, parameters: PenetrationParameters, owner: str) -> Attempt:
    """Reserve all axes and return the attempt, with its whole path checked.

    Raises
    ------
    InputError
        With what is missing, the value, the bound, and what to do; then nothing is reserved.
    """
    _check_device(session, parameters)
    plan = planned(session, parameters)
    session.reservations.reserve(owner)
    try:
        start = session.snapshot().command[parameters.axis]
        _check_way(session, parameters, plan, start)
    except BaseException:
        session.reservations.set_free(owner)
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
    session.reservations.check(owner)
    _check_way(session, parameters, plan, session.snapshot().command[parameters.axis])


def planned(session: MotionSession, parameters: PenetrationParameters) -> ThrustPlan:
    """Return the thrust for parameters on this robot, at any position.

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


def prepared(session: MotionSession, parameters: PenetrationParameters) -> dict[str, float]:
    """Return where the nano stage must be, m, so that a penetration fits in its range.

    The room that is left over is shared between both ends.

    Raises
    ------
    PenetrationError
        If no place of the axis leaves room enough, or it is not ``zn``: only that can move while z
        holds the tip.
    InputError
        As :func:`planned`.
    """
    plan, name = planned(session, parameters), parameters.axis
    if name != _NANO:
        raise PenetrationError(
            message(
                "engine",
                "axis {axis}: only {nano} can be moved back while the tip stays in place; "
                "move {axis} back manually, or shorten the distance",
            ).fill(axis=AxisName(name), nano=AxisName(_NANO))
        )
    low, high = session.robot.axes[name].range
    needed = travel_margin(session.robot, parameters, plan, low).needed
    if needed > high - low:
        raise PenetrationError(
            message(
                "engine",
                "axis {axis}: the run needs {needed}, but the whole range is {range}; "
                "shorten approach_distance or depth",
            ).fill(axis=AxisName(name), needed=exact(needed, "m"), range=exact(high - low, "m"))
        )
    spare = 0.5 * (high - low - needed)
    return {name: low + spare if parameters.sign > 0.0 else high - spare}


def _check_device(session: MotionSession, parameters: PenetrationParameters) -> None:
    driver = session.driver
    if not isinstance(driver, ProfileRunner):
        raise RefusedError(
            message("engine", "driver {driver} cannot execute profiles; a thrust needs that").fill(
                driver=repr(driver.name)
            )
        )
    if not isinstance(driver, VelocityMover):
        raise RefusedError(
            message(
                "engine", "driver {driver} cannot move at a set speed, which the approach needs"
            ).fill(driver=repr(driver.name))
        )
    if parameters.inject_s > 0.0 and session.tool.on is None:
        raise RefusedError(
            message("engine", "driver {driver} has no tool for injection; set inject_s to 0").fill(
                driver=repr(driver.name)
            )
        )


def _check_axis(robot: Robot, parameters: PenetrationParameters) -> None:
    name = parameters.axis
    if name not in robot.axes:
        raise PenetrationError(
            message(
                "engine", "robot {name} has no axis {axis} to penetrate with; it has {axes}"
            ).fill(name=repr(robot.name), axis=repr(name), axes=", ".join(robot.axes))
        )
    if robot.unit(name) != "m":
        raise PenetrationError(
            message(
                "engine", "axis {axis} of {robot} rotates; a penetration needs a linear axis"
            ).fill(axis=AxisName(name), robot=repr(robot.name))
        )
    axis = robot.axes[name]
    if axis.max_speed is not None and parameters.approach_speed > axis.max_speed:
        raise PenetrationError(
            message(
                "engine",
                "approach_speed = {approach_speed}: axis {name} moves at {max_speed} at most",
            ).fill(
                approach_speed=exact(parameters.approach_speed, "m/s"),
                name=AxisName(name),
                max_speed=exact(axis.max_speed, "m/s"),
            )
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
    session.profiles.check_thrust(name, _sorted(start, farthest), 0.0)
    session.profiles.check_thrust(name, _sorted(contact, farthest), plan.peak_speed)


def _check_room(parameters: PenetrationParameters, taken: TravelMargin) -> None:
    if taken.needed > taken.left:
        raise PenetrationError(
            message(
                "engine",
                "axis {axis} has {left} of travel left {direction}wards, but the run needs "
                "{needed} ({approach} to approach, {halt} to halt, {thrust} to thrust); move "
                "the axis back first, or shorten them",
            ).fill(
                axis=AxisName(parameters.axis),
                left=exact(taken.left, "m"),
                direction=parameters.direction,
                needed=exact(taken.needed, "m"),
                approach=exact(taken.approach, "m"),
                halt=exact(taken.halt, "m"),
                thrust=exact(taken.thrust, "m"),
            )
        )


def _sorted(one: float, other: float) -> tuple[float, float]:
    return min(one, other), max(one, other)
