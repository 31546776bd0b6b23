"""Preview of a penetration: speeds, depth, travel, and curves. No Qt."""

from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from rotemina.app.motion.penetration.arming import planned, travel_margin
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.thrust import ThrustPlan, ThrustTrace
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import error_text
from rotemina.drivers.profile import Profile
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import fixed
from rotemina.sim.robot.model import Robot

UNKNOWN = "–"
_POINTS = 500
_BESIDE = 0.15  # of the duration, shown before the thrust and behind it
_SPEED_SPAN = 5  # samples, as the log has it


class Curve(NamedTuple):
    """A way into the cell and its speed over time: s, m and m/s, (n,) each."""

    time_s: FloatArray
    way: FloatArray
    speed: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PlanPreview:
    """A plan, or the reason for none.

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
        """Whether the way is too long from where zn stands, though its range has room for it."""
        axis = self.parameters.axis
        if self.plan is None or axis != "zn" or axis not in state.command:
            return False
        margin = travel_margin(robot, self.parameters, self.plan, state.command[axis])
        return margin.left < margin.needed <= robot.axes[axis].span

    @classmethod
    def of(cls, session: MotionSession, parameters: PenetrationParameters) -> Self:
        """Plan the thrust; it takes some 10 ms."""
        try:
            return cls(parameters, planned(session, parameters))
        except InputError as error:
            return cls(parameters, None, error_text(error))

    def figures(self, robot: Robot, start: float | None) -> tuple[str, ...]:
        """Return average and peak speed, end depth, room needed and left, as texts.

        ``start`` is where the axis stands, m; None while nobody knows.
        """
        plan, p = self.plan, self.parameters
        if plan is None:
            return (UNKNOWN,) * 5
        taken = travel_margin(robot, p, plan, 0.0 if start is None else start)
        return (
            speed_text(plan.average_speed),
            speed_text(plan.peak_speed),
            way_text(taken.thrust),
            way_text(taken.needed),
            UNKNOWN if start is None else way_text(taken.left),
        )


def span_s(plan: ThrustPlan) -> tuple[float, float]:
    """Return the times that a picture of a thrust shows."""
    beside_s = _BESIDE * plan.wanted.duration_s
    return -beside_s, plan.wanted.duration_s + beside_s


def wanted_curve(plan: ThrustPlan) -> Curve:
    """Return what the tip is to do."""
    time_s = np.linspace(*span_s(plan), _POINTS)
    inside = (time_s > 0.0) & (time_s < plan.wanted.duration_s)
    polynomial = plan.wanted.polynomial.derivative()
    speed = np.where(inside, polynomial(np.clip(time_s, 0.0, plan.wanted.duration_s)), 0.0)
    sign = _sign(plan)
    return Curve(time_s, sign * plan.wanted.position(time_s), sign * speed)


def commanded_curve(plan: ThrustPlan) -> Curve:
    """Return what the device puts out."""
    time_s = np.linspace(*span_s(plan), _POINTS)
    way, speed = _values(plan.profile, time_s)
    return Curve(time_s, _sign(plan) * way, _sign(plan) * speed)


def measured_curve(trace: ThrustTrace) -> Curve:
    """Return what the axis' own sensor said; its speed over five samples."""
    begin_s, end_s = span_s(trace.plan)
    shown = (trace.time_s >= begin_s) & (trace.time_s <= end_s)
    time_s, way = trace.time_s[shown], _sign(trace.plan) * trace.way[shown]
    if len(time_s) <= _SPEED_SPAN:
        return Curve(time_s, way, np.zeros(len(time_s)))
    ends = np.arange(len(time_s))
    first = np.clip(ends - _SPEED_SPAN // 2, 0, len(time_s) - 1 - _SPEED_SPAN)
    last = first + _SPEED_SPAN
    return Curve(time_s, way, (way[last] - way[first]) / (time_s[last] - time_s[first]))


def way_text(way: float) -> str:
    """Return a distance as text, µm."""
    return f"{fixed(1e6 * way, 2)} µm"


def speed_text(speed: float) -> str:
    """Return a speed as text, µm/s."""
    return f"{fixed(1e6 * speed, 0)} µm/s"


def _sign(plan: ThrustPlan) -> float:
    return -1.0 if plan.wanted.length < 0.0 else 1.0


def _values(profile: Profile, time_s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return position and speed of a profile at times (n,), from its beginning."""
    way, speed = np.zeros(len(time_s)), np.zeros(len(time_s))
    at = begin_s = 0.0
    for one in profile.segments:
        tau = (time_s - begin_s) / one.duration_s
        inside, behind = (tau >= 0.0) & (tau < 1.0), tau >= 1.0
        t = tau[inside]
        way[inside] = at + ((one.c3 * t + one.c2) * t + one.c1) * t
        speed[inside] = ((3.0 * one.c3 * t + 2.0 * one.c2) * t + one.c1) / one.duration_s
        at, begin_s = at + one.length, begin_s + one.duration_s
        way[behind] = at
    return way, speed
