"""Preview of a penetration: speeds, depth, travel and curves. This module does not use Qt."""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.app.language import describe_error
from rotemina.app.motion.penetration import (
    PenetrationParameters,
    ThrustPlan,
    ThrustTrace,
    compute_travel_margin,
    plan_session_thrust,
)
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.drivers.abilities import MotionProfile
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import format_fixed
from rotemina.sim.robot import Robot

UNKNOWN_TEXT = "–"
_CURVE_POINT_COUNT = 500
# Time that the plot shows before and after the thrust, relative to the duration of the thrust.
_TIME_MARGIN_RATIO = 0.15
# The measured speed is an average over this many samples, as in the log.
_SPEED_SPAN_SAMPLES = 5


class ThrustCurve(NamedTuple):
    """Depth in the cell (m) and speed (m/s) at times (s), each (n,)."""

    time_s: FloatArray
    depth: FloatArray
    speed: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PlanPreview:
    """Plan of a thrust, or the reason why there is none.

    Attributes
    ----------
    parameters : PenetrationParameters
    plan : ThrustPlan or None
    problem : str
        Why there is no plan.
    """

    parameters: PenetrationParameters
    plan: ThrustPlan | None
    problem: str = ""

    def lacks_room(self, robot: Robot, state: SessionState) -> bool:
        """Return whether zn has too little travel here, although its range would be sufficient."""
        axis = self.parameters.axis
        if self.plan is None or axis != "zn" or axis not in state.command:
            return False
        margin = compute_travel_margin(robot, self.parameters, self.plan, state.command[axis])
        return margin.available < margin.needed <= robot.axes[axis].span

    @classmethod
    def plan_for_session(cls, session: MotionSession, parameters: PenetrationParameters) -> Self:
        """Return the plan of a thrust for a session. Planning takes about 10 ms."""
        try:
            return cls(parameters, plan_session_thrust(session, parameters))
        except InputError as error:
            return cls(parameters, None, describe_error(error))

    def format_figures(self, robot: Robot, start: float | None) -> tuple[str, ...]:
        """Return average and peak speed, end depth, travel needed and available, as texts.

        ``start`` is the current position of the axis, m, or None if it is unknown.
        """
        plan, parameters = self.plan, self.parameters
        if plan is None:
            return (UNKNOWN_TEXT,) * 5
        margin = compute_travel_margin(robot, parameters, plan, 0.0 if start is None else start)
        return (
            format_speed(plan.average_speed),
            format_speed(plan.peak_speed),
            format_distance(margin.thrust),
            format_distance(margin.needed),
            UNKNOWN_TEXT if start is None else format_distance(margin.available),
        )


def compute_shown_span(plan: ThrustPlan) -> tuple[float, float]:
    """Return the first and last time in the plot of a thrust, s."""
    margin_s = _TIME_MARGIN_RATIO * plan.target_shape.duration_s
    return -margin_s, plan.target_shape.duration_s + margin_s


def make_desired_curve(plan: ThrustPlan) -> ThrustCurve:
    """Return the desired motion of the tip."""
    time_s = np.linspace(*compute_shown_span(plan), _CURVE_POINT_COUNT)
    is_inside = (time_s > 0.0) & (time_s < plan.target_shape.duration_s)
    speed_polynomial = plan.target_shape.polynomial.derivative()
    speed = np.where(
        is_inside, speed_polynomial(np.clip(time_s, 0.0, plan.target_shape.duration_s)), 0.0
    )
    direction = _get_direction(plan)
    return ThrustCurve(time_s, direction * plan.target_shape.position(time_s), direction * speed)


def make_commanded_curve(plan: ThrustPlan) -> ThrustCurve:
    """Return the motion that the device commands."""
    time_s = np.linspace(*compute_shown_span(plan), _CURVE_POINT_COUNT)
    depth, speed = _sample_profile(plan.profile, time_s)
    return ThrustCurve(time_s, _get_direction(plan) * depth, _get_direction(plan) * speed)


def make_measured_curve(trace: ThrustTrace) -> ThrustCurve:
    """Return the motion that the axis sensor measured. The speed is averaged over five samples."""
    begin_s, end_s = compute_shown_span(trace.plan)
    is_shown = (trace.time_s >= begin_s) & (trace.time_s <= end_s)
    time_s, depth = trace.time_s[is_shown], _get_direction(trace.plan) * trace.travel[is_shown]
    if len(time_s) <= _SPEED_SPAN_SAMPLES:
        return ThrustCurve(time_s, depth, np.zeros(len(time_s)))
    indices = np.arange(len(time_s))
    begin_rows = np.clip(
        indices - _SPEED_SPAN_SAMPLES // 2, 0, len(time_s) - 1 - _SPEED_SPAN_SAMPLES
    )
    end_rows = begin_rows + _SPEED_SPAN_SAMPLES
    return ThrustCurve(
        time_s,
        depth,
        (depth[end_rows] - depth[begin_rows]) / (time_s[end_rows] - time_s[begin_rows]),
    )


def format_distance(distance: float) -> str:
    """Return a distance as text, µm."""
    return f"{format_fixed(1e6 * distance, 2)} µm"


def format_speed(speed: float) -> str:
    """Return a speed as text, µm/s."""
    return f"{format_fixed(1e6 * speed, 0)} µm/s"


def _get_direction(plan: ThrustPlan) -> float:
    return -1.0 if plan.target_shape.length < 0.0 else 1.0


def _sample_profile(profile: MotionProfile, time_s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return position and speed of a profile at times (n,) after its start."""
    position, speed = np.zeros(len(time_s)), np.zeros(len(time_s))
    segment_start = begin_s = 0.0
    for segment in profile.segments:
        tau = (time_s - begin_s) / segment.duration_s
        is_inside, is_past = (tau >= 0.0) & (tau < 1.0), tau >= 1.0
        t = tau[is_inside]
        position[is_inside] = segment_start + ((segment.c3 * t + segment.c2) * t + segment.c1) * t
        speed[is_inside] = (
            (3.0 * segment.c3 * t + 2.0 * segment.c2) * t + segment.c1
        ) / segment.duration_s
        segment_start, begin_s = segment_start + segment.displacement, begin_s + segment.duration_s
        position[is_past] = segment_start
    return position, speed
