"""Checks and reservation of the axes when a penetration is armed."""

from typing import NamedTuple

from rotemina.app.errors import PenetrationError, RequestRefusedError
from rotemina.app.motion.penetration.attempt import PenetrationAttempt
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.thrust import ThrustPlan, plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.abilities import ProfileRunner, VelocityMover
from rotemina.sim.messages import AxisName
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

# zn moves the tip in the same direction as z, so z can compensate for the motion of zn.
_NANO_AXIS = "zn"
# The approach ends after this time if the host no longer renews it.
APPROACH_LEASE_S = 0.15
# The approach may continue for this long after a contact, until the contact is certain, the host
# has received it, and the axis is at rest.
_APPROACH_OVERRUN_S = 0.2


class TravelMargin(NamedTuple):
    """Travel that a penetration may need, and travel that is available, m.

    Attributes
    ----------
    approach, halt, thrust : float
        Parts of the needed travel. The thrust is that of the commands.
    available : float
        From the position of the axis to the end of its range.
    """

    approach: float
    halt: float
    thrust: float
    available: float

    @property
    def needed(self) -> float:
        """Total travel that the penetration may need."""
        return self.approach + self.halt + self.thrust


def prepare_attempt(
    session: MotionSession, parameters: PenetrationParameters, owner: str
) -> PenetrationAttempt:
    """Check the whole path, reserve all axes, and return the attempt.

    Raises
    ------
    InputError
        If a condition is not met; then nothing is reserved. The message names the condition, the
        value, the bound and what to do.
    """
    _check_device(session, parameters)
    plan = plan_session_thrust(session, parameters)
    session.reservations.reserve(owner)
    try:
        start = session.snapshot().command[parameters.axis]
        _check_travel(session, parameters, plan, start)
    except BaseException:
        session.reservations.end_reservations(owner)
        raise
    return PenetrationAttempt(parameters, plan, start)


def check_can_arm(
    session: MotionSession, parameters: PenetrationParameters, plan: ThrustPlan, owner: str
) -> None:
    """Make the same checks as :func:`prepare_attempt`, but reserve nothing.

    Raises
    ------
    InputError
        See :func:`prepare_attempt`.
    """
    _check_device(session, parameters)
    session.reservations.check(owner)
    _check_travel(session, parameters, plan, session.snapshot().command[parameters.axis])


def plan_session_thrust(session: MotionSession, parameters: PenetrationParameters) -> ThrustPlan:
    """Return the thrust for the session's robot, whatever its position.

    Raises
    ------
    InputError
        If the robot does not have the axis. See also :func:`plan_thrust`.
    """
    _check_axis(session.robot, parameters)
    return plan_thrust(session.robot, parameters, session.setpoint_period_s)


def compute_travel_margin(
    robot: Robot, parameters: PenetrationParameters, plan: ThrustPlan, start: float
) -> TravelMargin:
    """Return the needed and the available travel if the axis starts at ``start``, m."""
    low_thrust, high_thrust = plan.command_range
    axis_range = robot.axes[parameters.axis].range
    return TravelMargin(
        parameters.approach_distance,
        parameters.approach_speed * _APPROACH_OVERRUN_S,
        high_thrust if parameters.sign > 0.0 else -low_thrust,
        axis_range[1] - start if parameters.sign > 0.0 else start - axis_range[0],
    )


def compute_start_targets(
    session: MotionSession, parameters: PenetrationParameters
) -> dict[str, float]:
    """Return where the nano stage must start, m, for a penetration to fit into its range.

    The travel that is left over is divided equally between both ends.

    Raises
    ------
    PenetrationError
        If the range is too short, or the axis is not ``zn``, the only axis that can move while z
        holds the tip.
    InputError
        See :func:`plan_session_thrust`.
    """
    plan, axis = plan_session_thrust(session, parameters), parameters.axis
    if axis != _NANO_AXIS:
        raise PenetrationError(
            "axis {axis}: only {nano} can be moved back while the tip stays in place; "
            "move {axis} back manually, or shorten the distance",
            axis=AxisName(axis),
            nano=AxisName(_NANO_AXIS),
        )
    low, high = session.robot.axes[axis].range
    needed = compute_travel_margin(session.robot, parameters, plan, low).needed
    if needed > high - low:
        raise PenetrationError(
            "axis {axis}: the run needs {needed}, but the whole range is {range}; "
            "shorten approach_distance or depth",
            axis=AxisName(axis),
            needed=format_exact(needed, "m"),
            range=format_exact(high - low, "m"),
        )
    end_clearance = 0.5 * (high - low - needed)
    return {axis: low + end_clearance if parameters.sign > 0.0 else high - end_clearance}


def _check_device(session: MotionSession, parameters: PenetrationParameters) -> None:
    driver = session.driver
    if not isinstance(driver, ProfileRunner):
        raise RequestRefusedError(
            "driver {driver} cannot execute profiles; a thrust needs that", driver=repr(driver.name)
        )
    if not isinstance(driver, VelocityMover):
        raise RequestRefusedError(
            "driver {driver} cannot move at a set speed, which the approach needs",
            driver=repr(driver.name),
        )
    if parameters.inject_s > 0.0 and session.tool.is_on is None:
        raise RequestRefusedError(
            "driver {driver} has no tool for injection; set inject_s to 0", driver=repr(driver.name)
        )


def _check_axis(robot: Robot, parameters: PenetrationParameters) -> None:
    name = parameters.axis
    if name not in robot.axes:
        raise PenetrationError(
            "robot {name} has no axis {axis} to penetrate with; it has {axes}",
            name=repr(robot.name),
            axis=repr(name),
            axes=", ".join(robot.axes),
        )
    if robot.unit(name) != "m":
        raise PenetrationError(
            "axis {axis} of {robot} rotates; a penetration needs a linear axis",
            axis=AxisName(name),
            robot=repr(robot.name),
        )
    axis = robot.axes[name]
    if axis.max_speed is not None and parameters.approach_speed > axis.max_speed:
        raise PenetrationError(
            "approach_speed = {approach_speed}: axis {name} moves at {max_speed} at most",
            approach_speed=format_exact(parameters.approach_speed, "m/s"),
            name=AxisName(name),
            max_speed=format_exact(axis.max_speed, "m/s"),
        )


def _check_travel(
    session: MotionSession, parameters: PenetrationParameters, plan: ThrustPlan, start: float
) -> None:
    """Refuse a path that leaves the range or the bounds of the tip, or too fast a thrust."""
    axis, margin = parameters.axis, compute_travel_margin(session.robot, parameters, plan, start)
    _check_margin(parameters, margin)
    plan.profile.check(session.robot, start)
    farthest_position = start + parameters.sign * margin.needed
    latest_contact = farthest_position - parameters.sign * margin.thrust
    session.profiles.check_thrust(axis, _sort_pair(start, farthest_position), 0.0)
    session.profiles.check_thrust(
        axis, _sort_pair(latest_contact, farthest_position), plan.peak_speed
    )


def _check_margin(parameters: PenetrationParameters, margin: TravelMargin) -> None:
    if margin.needed > margin.available:
        raise PenetrationError(
            "axis {axis} has {left} of travel left {direction}wards, but the run needs "
            "{needed} ({approach} to approach, {halt} to halt, {thrust} to thrust); move "
            "the axis back first, or shorten them",
            axis=AxisName(parameters.axis),
            left=format_exact(margin.available, "m"),
            direction=parameters.direction,
            needed=format_exact(margin.needed, "m"),
            approach=format_exact(margin.approach, "m"),
            halt=format_exact(margin.halt, "m"),
            thrust=format_exact(margin.thrust, "m"),
        )


def _sort_pair(a: float, b: float) -> tuple[float, float]:
    return min(a, b), max(a, b)
