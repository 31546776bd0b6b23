"""The thrust: its profile as executed by a board, and how the axis followed it."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import scipy

from rotemina.app.motion.penetration.parameters import (
    PenetrationError,
    PenetrationParameters,
    Shaping,
    ThrustShape,
)
from rotemina.drivers.profile import MOST_SEGMENTS, Profile, ProfileSegment
from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.messages import AxisName, message
from rotemina.sim.modes.vibration import damped_modes
from rotemina.sim.quantities import rounded
from rotemina.sim.robot.model import Robot
from rotemina.sim.shaping.cubic_segments import as_cubics
from rotemina.sim.shaping.feed_forward import inverse_of, led
from rotemina.sim.shaping.impulses import shaped, zero_vibration
from rotemina.sim.shaping.move_shape import Shape
from rotemina.sim.shaping.moves import minimum_jerk, s_curve_in, tabled

_ORDERS = {Shaping.ZV: 1, Shaping.ZVD: 2, Shaping.ZVDD: 3}
_FIT = 1e-3  # of the depth, by which cubics may miss the profile
_MOST_DELAY_S = 0.1
_BEFORE = 10  # samples, of which the mean is where the thrust began


class Resonance(NamedTuple):
    """Frequency, Hz, and damping ratio of an axis."""

    frequency_hz: float
    damping_ratio: float


@dataclass(frozen=True)
class ThrustPlan:
    """A thrust.

    Attributes
    ----------
    wanted : Shape
        The profile that the tip is to follow: shaped, where input shaping is on.
    profile : Profile
        What the board runs: the same, or with the model's inverse before it.
    fit_error : float
        Greatest difference of its cubics from what was to be commanded, m.
    """

    wanted: Shape
    profile: Profile
    fit_error: float

    @property
    def average_speed(self) -> float:
        """m/s."""
        return self.wanted.average_speed

    @cached_property
    def peak_speed(self) -> float:
        """Greatest instantaneous speed, m/s."""
        return self.wanted.greatest(1)

    @cached_property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest commanded position, from its start, m."""
        at, places = 0.0, [0.0]
        for segment in self.profile.segments:
            places += [at + extreme for extreme in segment.extremes()]
            at += segment.length
        return min(places), max(places)


@dataclass(frozen=True, slots=True)
class ThrustMeasured:
    """The measured motion of the axis in a thrust, by its own sensor.

    Attributes
    ----------
    depth : float
        How far it went, m.
    error : float
        Greatest distance from the profile, m, after a constant delay is taken off.
    delay_s : float
        That delay, as it fits best: of the hold, the axis and the sampling together.
    average_speed, peak_speed : float
        m/s; the peak is over five samples.
    rate_hz : float
        Of the samples that tell it.
    """

    depth: float
    error: float
    delay_s: float
    average_speed: float
    peak_speed: float
    rate_hz: float


@dataclass(frozen=True, slots=True, eq=False)
class ThrustTrace:
    """The axis' sensor readings of a thrust, for plotting.

    Attributes
    ----------
    time_s, way : (n,)
        Since the profile began, s, the constant delay taken off; and from where it began, m.
    plan : ThrustPlan
        What it was to do.
    """

    time_s: FloatArray
    way: FloatArray
    plan: ThrustPlan


def resonance_of(robot: Robot, axis: str) -> Resonance | None:
    """Return the lightly damped mode that an axis carries most of; None where it has none."""
    if robot.axes[axis].static:
        return None
    modes = damped_modes(robot)
    for number, dominant in enumerate(modes.dominant):
        ratio = float(modes.damping_ratio[number])
        if dominant == axis and 0.0 <= ratio < 1.0 and modes.frequency_hz[number] > 0.0:
            return Resonance(float(modes.frequency_hz[number]), ratio)
    return None


def plan_thrust(robot: Robot, parameters: PenetrationParameters, hold_s: float) -> ThrustPlan:
    """Return the thrust for parameters; ``hold_s`` is the hold time of each command.

    Raises
    ------
    PenetrationError
        If the axis has no resonance to shape for, or the shaper leaves no time to move.
    ShapingError
        If a table is none, or 16 cubics miss the profile.
    """
    depth = parameters.sign * parameters.depth
    order = _ORDERS.get(parameters.shaping, 0)
    resonance = resonance_of(robot, parameters.axis)
    if resonance is None and parameters.shaping is not Shaping.NONE:
        raise PenetrationError(
            message(
                "engine",
                "shaping = {shaping}: axis {axis} of {robot} has no resonance in its "
                "robot file; choose 'none'",
            ).fill(
                shaping=repr(str(parameters.shaping)),
                axis=AxisName(parameters.axis),
                robot=robot.name,
            )
        )
    if resonance is None:
        wanted = commanded = _plain(parameters, depth, parameters.duration_s)
    elif order:
        shaper = zero_vibration(*resonance, order)
        left_s = parameters.duration_s - shaper.duration_s
        if left_s < 0.25 * parameters.duration_s:
            raise PenetrationError(
                message(
                    "engine",
                    "duration_s = {duration} s: input shaping {shaping} takes {taken} s of "
                    "it; use at least {least} s, or another shaping",
                ).fill(
                    duration=rounded(parameters.duration_s, 6),
                    shaping=repr(str(parameters.shaping)),
                    taken=rounded(shaper.duration_s, 3),
                    least=rounded(shaper.duration_s / 0.75, 3),
                )
            )
        wanted = commanded = shaped(_plain(parameters, depth, left_s), shaper)
    else:
        wanted = commanded = _plain(parameters, depth, parameters.duration_s)
        if parameters.shaping is Shaping.INVERSE:
            commanded = led(wanted, inverse_of(*resonance, hold_s))
    fit = as_cubics(commanded, MOST_SEGMENTS, _FIT * parameters.depth)
    return ThrustPlan(wanted, Profile(parameters.axis, _segments(fit.shape)), fit.error)


def thrust_response(
    plan: ThrustPlan, time_s: FloatArray, measured: FloatArray, begin_s: float
) -> ThrustMeasured:
    """Return how readings (n,) followed a thrust that was triggered at about ``begin_s``.

    Raises
    ------
    PenetrationError
        If there are no samples before or after it.
    """
    wanted = plan.wanted
    way = _way(time_s, measured, begin_s)

    def squares(delay_s: float) -> float:
        return float(np.sum((way - wanted.position(time_s - begin_s - delay_s)) ** 2))

    # The sum is smooth, but flat far away: looked at coarsely first.
    coarse = np.linspace(0.0, _MOST_DELAY_S, 101)
    near_s = float(coarse[np.argmin([squares(one) for one in coarse])])
    bounds = (near_s - coarse[1], near_s + coarse[1])
    delay_s = float(scipy.optimize.minimize_scalar(squares, bounds=bounds, method="bounded").x)
    error = np.abs(way - wanted.position(time_s - begin_s - delay_s)).max()
    after = way[time_s > begin_s + delay_s + wanted.duration_s]
    if not len(after):
        raise PenetrationError(
            message("engine", "thrust: none of {count} samples lies after it").fill(
                count=len(time_s)
            )
        )
    depth = float(np.mean(after))
    rate_hz = (len(time_s) - 1) / float(time_s[-1] - time_s[0])
    span = min(5, len(way) - 1)
    speeds = np.abs(way[span:] - way[:-span]) / (time_s[span:] - time_s[:-span])
    return ThrustMeasured(
        abs(depth),
        float(error),
        delay_s,
        abs(depth) / wanted.duration_s,
        float(speeds.max()),
        rate_hz,
    )


def thrust_trace(
    plan: ThrustPlan, time_s: FloatArray, measured: FloatArray, begin_s: float, delay_s: float
) -> ThrustTrace:
    """Return readings (n,) and the profile that they followed by ``delay_s``; as `followed`."""
    since_s = read_only(np.asarray(time_s - begin_s - delay_s))
    return ThrustTrace(since_s, read_only(_way(time_s, measured, begin_s)), plan)


def _way(time_s: FloatArray, measured: FloatArray, begin_s: float) -> FloatArray:
    """Return readings (n,) from where the thrust began, m."""
    before = measured[time_s <= begin_s][-_BEFORE:]
    if not len(before):
        raise PenetrationError(
            message("engine", "thrust: none of {count} samples lies before it").fill(
                count=len(time_s)
            )
        )
    return np.asarray(measured - float(np.mean(before)))


def _plain(parameters: PenetrationParameters, depth: float, duration_s: float) -> Shape:
    if parameters.shape is ThrustShape.MINIMUM_JERK:
        return minimum_jerk(depth, duration_s)
    if parameters.shape is ThrustShape.TABLE:
        times, shares = np.array(parameters.table).T
        return tabled(duration_s * times, depth * shares)
    return s_curve_in(depth, duration_s, ramp=parameters.ramp)


def _segments(shape: Shape) -> tuple[ProfileSegment, ...]:
    """Return a move of cubics as a board's segments."""
    spans = np.diff(shape.breaks_s)
    rows = np.zeros((4, len(spans)))
    rows[4 - len(shape.coefficients) :] = shape.coefficients
    scaled = rows[:3] * spans ** np.array([[3.0], [2.0], [1.0]])
    return tuple(
        ProfileSegment(float(span), float(c1), float(c2), float(c3))
        for span, (c3, c2, c1) in zip(spans, scaled.T, strict=True)
    )
