"""The thrust: its plan, the profile that a board executes, and its measured motion."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy

from rotemina.app.errors import PenetrationError
from rotemina.app.motion.penetration.parameters import (
    InputShaping,
    PenetrationParameters,
    ThrustShape,
)
from rotemina.drivers.abilities import (
    MAX_SEGMENTS,
    MotionProfile,
    ProfileSegment,
)
from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.messages import AxisName, format_rounded
from rotemina.sim.modes import compute_damped_modes
from rotemina.sim.robot import Robot
from rotemina.sim.shaping import (
    MoveShape,
    apply_lead,
    apply_shaper,
    fit_cubics,
    interpolate_table,
    invert_axis,
    make_minimum_jerk,
    make_s_curve,
    make_zero_vibration_shaper,
)

_SHAPER_ORDERS = {InputShaping.ZV: 1, InputShaping.ZVD: 2, InputShaping.ZVDD: 3}
# The cubics may differ from the profile by this fraction of the depth.
_FIT_TOLERANCE_RATIO = 1e-3
# Largest delay between profile and measured motion.
_MAX_DELAY_S = 0.1
# The start position of the thrust is the mean of this many samples before it.
_START_SAMPLE_COUNT = 10


class AxisResonance(NamedTuple):
    """Frequency, Hz, and damping ratio of an axis' resonance."""

    frequency_hz: float
    damping_ratio: float


@dataclass(frozen=True)
class ThrustPlan:
    """Plan of a thrust.

    Attributes
    ----------
    target_shape : MoveShape
        The desired motion of the tip, including input shaping if it is used.
    profile : MotionProfile
        The motion that the board executes: the target shape, or the target shape filtered by the
        inverse of the axis model.
    fit_error : float
        Largest difference between the cubics of the profile and the planned command, m.
    """

    target_shape: MoveShape
    profile: MotionProfile
    fit_error: float

    @property
    def average_speed(self) -> float:
        """Depth divided by duration, m/s."""
        return self.target_shape.average_speed

    @cached_property
    def peak_speed(self) -> float:
        """Highest instantaneous speed, m/s."""
        return self.target_shape.max_magnitude(1)

    @cached_property
    def command_range(self) -> tuple[float, float]:
        """Lowest and highest commanded position, relative to the start, m."""
        segment_start, positions = 0.0, [0.0]
        for segment in self.profile.segments:
            positions += [segment_start + extreme for extreme in segment.find_extremes()]
            segment_start += segment.displacement
        return min(positions), max(positions)


@dataclass(frozen=True, slots=True)
class MeasuredThrust:
    """Motion of the axis in a thrust, as measured by its own sensor.

    Attributes
    ----------
    depth : float
        Depth that was reached, m.
    error : float
        Largest distance from the profile, m, after a constant delay has been removed.
    delay_s : float
        The delay that fits best. Holding of commands, the axis and the sampling contribute to it.
    average_speed, peak_speed : float
        Speeds in m/s. The peak is measured over five samples.
    rate_hz : float
        Rate of the samples.
    """

    depth: float
    error: float
    delay_s: float
    average_speed: float
    peak_speed: float
    rate_hz: float


@dataclass(frozen=True, slots=True, eq=False)
class ThrustTrace:
    """Sensor readings of the axis during a thrust, for plots.

    Attributes
    ----------
    time_s, travel : (n,)
        Time since the profile began minus the constant delay, s; distance from the start, m.
    plan : ThrustPlan
        Plan of this thrust.
    """

    time_s: FloatArray
    travel: FloatArray
    plan: ThrustPlan


def find_resonance(robot: Robot, axis: str) -> AxisResonance | None:
    """Return the underdamped mode that an axis dominates, or None."""
    if robot.axes[axis].static:
        return None
    modes = compute_damped_modes(robot)
    for number, dominant in enumerate(modes.dominant):
        ratio = float(modes.damping_ratio[number])
        if dominant == axis and 0.0 <= ratio < 1.0 and modes.frequency_hz[number] > 0.0:
            return AxisResonance(float(modes.frequency_hz[number]), ratio)
    return None


def plan_thrust(robot: Robot, parameters: PenetrationParameters, hold_s: float) -> ThrustPlan:
    """Plan the thrust for parameters; the device holds each command for ``hold_s``.

    Raises
    ------
    PenetrationError
        If the robot file has no resonance of the axis, or the shaper leaves no time to move.
    ShapingError
        If a table is invalid, or 16 cubics cannot match the profile.
    """
    depth = parameters.sign * parameters.depth
    order = _SHAPER_ORDERS.get(parameters.shaping, 0)
    resonance = find_resonance(robot, parameters.axis)
    if resonance is None and parameters.shaping is not InputShaping.NONE:
        raise PenetrationError(
            "shaping = {shaping}: axis {axis} of {robot} has no resonance in its "
            "robot file; choose 'none'",
            shaping=repr(str(parameters.shaping)),
            axis=AxisName(parameters.axis),
            robot=robot.name,
        )
    if resonance is None:
        target_shape = command_shape = _make_unshaped_thrust(
            parameters, depth, parameters.duration_s
        )
    elif order:
        shaper = make_zero_vibration_shaper(*resonance, order)
        move_s = parameters.duration_s - shaper.duration_s
        if move_s < 0.25 * parameters.duration_s:
            raise PenetrationError(
                "duration_s = {duration} s: input shaping {shaping} takes {taken} s of "
                "it; use at least {least} s, or another shaping",
                duration=format_rounded(parameters.duration_s, 6),
                shaping=repr(str(parameters.shaping)),
                taken=format_rounded(shaper.duration_s, 3),
                least=format_rounded(shaper.duration_s / 0.75, 3),
            )
        target_shape = command_shape = apply_shaper(
            _make_unshaped_thrust(parameters, depth, move_s), shaper
        )
    else:
        target_shape = command_shape = _make_unshaped_thrust(
            parameters, depth, parameters.duration_s
        )
        if parameters.shaping is InputShaping.INVERSE:
            command_shape = apply_lead(target_shape, invert_axis(*resonance, hold_s))
    fit = fit_cubics(command_shape, MAX_SEGMENTS, _FIT_TOLERANCE_RATIO * parameters.depth)
    return ThrustPlan(
        target_shape, MotionProfile(parameters.axis, _to_segments(fit.shape)), fit.error
    )


def evaluate_thrust(
    plan: ThrustPlan, time_s: FloatArray, measured: FloatArray, begin_s: float
) -> MeasuredThrust:
    """Measure the thrust in readings (n,); it was triggered at about ``begin_s``.

    Raises
    ------
    PenetrationError
        If there are no samples before or after the thrust.
    """
    target_shape = plan.target_shape
    travel = _compute_travel(time_s, measured, begin_s)

    def compute_misfit(delay_s: float) -> float:
        return float(np.sum((travel - target_shape.position(time_s - begin_s - delay_s)) ** 2))

    # The misfit is smooth, but flat far from its minimum, so a coarse search comes first.
    grid_s = np.linspace(0.0, _MAX_DELAY_S, 101)
    coarse_delay_s = float(grid_s[np.argmin([compute_misfit(delay) for delay in grid_s])])
    bounds = (coarse_delay_s - grid_s[1], coarse_delay_s + grid_s[1])
    delay_s = float(
        scipy.optimize.minimize_scalar(compute_misfit, bounds=bounds, method="bounded").x
    )
    error = np.abs(travel - target_shape.position(time_s - begin_s - delay_s)).max()
    final_travel = travel[time_s > begin_s + delay_s + target_shape.duration_s]
    if not len(final_travel):
        raise PenetrationError(
            "thrust: no sample was taken after it (samples: {count})", count=len(time_s)
        )
    depth = float(np.mean(final_travel))
    rate_hz = (len(time_s) - 1) / float(time_s[-1] - time_s[0])
    sample_span = min(5, len(travel) - 1)
    speeds = np.abs(travel[sample_span:] - travel[:-sample_span]) / (
        time_s[sample_span:] - time_s[:-sample_span]
    )
    return MeasuredThrust(
        abs(depth),
        float(error),
        delay_s,
        abs(depth) / target_shape.duration_s,
        float(speeds.max()),
        rate_hz,
    )


def make_thrust_trace(
    plan: ThrustPlan, time_s: FloatArray, measured: FloatArray, begin_s: float, delay_s: float
) -> ThrustTrace:
    """Return the trace of readings (n,) of a thrust, with the delay ``delay_s`` removed."""
    since_s = make_read_only(np.asarray(time_s - begin_s - delay_s))
    return ThrustTrace(since_s, make_read_only(_compute_travel(time_s, measured, begin_s)), plan)


def _compute_travel(time_s: FloatArray, measured: FloatArray, begin_s: float) -> FloatArray:
    """Return readings (n,) relative to the start of the thrust, m."""
    start_readings = measured[time_s <= begin_s][-_START_SAMPLE_COUNT:]
    if not len(start_readings):
        raise PenetrationError(
            "thrust: no sample was taken before it (samples: {count})", count=len(time_s)
        )
    return np.asarray(measured - float(np.mean(start_readings)))


def _make_unshaped_thrust(
    parameters: PenetrationParameters, depth: float, duration_s: float
) -> MoveShape:
    if parameters.shape is ThrustShape.MINIMUM_JERK:
        return make_minimum_jerk(depth, duration_s)
    if parameters.shape is ThrustShape.TABLE:
        time_fractions, depth_fractions = np.array(parameters.table).T
        return interpolate_table(duration_s * time_fractions, depth * depth_fractions)
    return make_s_curve(depth, duration_s, ramp=parameters.ramp)


def _to_segments(shape: MoveShape) -> tuple[ProfileSegment, ...]:
    durations_s = np.diff(shape.breaks_s)
    rows = np.zeros((4, len(durations_s)))
    rows[4 - len(shape.coefficients) :] = shape.coefficients
    scaled_rows = rows[:3] * durations_s ** np.array([[3.0], [2.0], [1.0]])
    return tuple(
        ProfileSegment(float(duration_s), float(c1), float(c2), float(c3))
        for duration_s, (c3, c2, c1) in zip(durations_s, scaled_rows.T, strict=True)
    )
