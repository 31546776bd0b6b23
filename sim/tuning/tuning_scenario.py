"""Test references of a loop: a step within the limits of the axis, and a triangle."""

from dataclasses import dataclass
from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.effects import AxisProperties
from rotemina.sim.errors import TuningError
from rotemina.sim.robot import Axis
from rotemina.sim.shaping import (
    MotionLimits,
    make_minimum_jerk,
    make_shortest_minimum_jerk,
)
from rotemina.sim.units import format_exact

# Distance of the step and swing of the triangle as shares of the range, and the largest frequency
# of the triangle.
STEP_RANGE_RATIO, TRIANGLE_RANGE_RATIO, MAX_TRIANGLE_HZ = 0.6, 0.5, 10.0
# Rest before the motion begins.
_REST_S = 0.01
# Shortest duration of a step, in periods of the resonance.
_MIN_STEP_PERIODS = 1.5
# Hold after a step, in periods of the resonance; 60 ms at 420 Hz.
_HOLD_PERIODS = 25.0
_TRIANGLE_PERIODS = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class TuningScenario:
    """A reference (n,), m or rad, that begins with ``begin_s`` seconds of rest."""

    name: str
    reference: FloatArray
    begin_s: float

    @property
    def target(self) -> float:
        """Final value of the reference."""
        return float(self.reference[-1])

    @property
    def distance(self) -> float:
        """Final value minus initial value."""
        return float(self.reference[-1] - self.reference[0])


def make_step(axis: Axis, rate_hz: float, distance: float | None = None) -> TuningScenario:
    """Return a minimum-jerk move about mid-range, as short as the limits of the axis allow.

    Raises
    ------
    TuningError
        If the distance is zero or does not fit into the range.
    """
    distance = STEP_RANGE_RATIO * axis.span if distance is None else distance
    middle = _find_middle(axis, distance, "step")
    pace_hz = AxisProperties.of(axis).pace_hz
    limits = MotionLimits(axis.max_speed or inf, axis.max_acceleration or inf)
    duration_s = _MIN_STEP_PERIODS / pace_hz
    if axis.max_speed or axis.max_acceleration:
        duration_s = max(duration_s, make_shortest_minimum_jerk(distance, limits).duration_s)
    move = make_minimum_jerk(distance, duration_s)
    total_s = _REST_S + duration_s + _HOLD_PERIODS / pace_hz
    time_s = np.arange(round(total_s * rate_hz) + 1) / rate_hz
    start = middle - 0.5 * distance
    return TuningScenario("step", make_read_only(start + move.position(time_s - _REST_S)), _REST_S)


def make_triangle(
    axis: Axis, rate_hz: float, frequency_hz: float | None = None, swing: float | None = None
) -> TuningScenario:
    """Return a triangle about mid-range, by default at a tenth of the resonance, at most 10 Hz.

    It stays within the limits of the axis: its frequency is reduced to respect the speed limit, and
    its corners are rounded over at least a period of the resonance to respect the acceleration
    limit.

    Raises
    ------
    TuningError
        If the swing is zero or does not fit into the range.
    """
    swing = TRIANGLE_RANGE_RATIO * axis.span if swing is None else swing
    middle = _find_middle(axis, swing, "triangle")
    if frequency_hz is None:
        frequency_hz = min(MAX_TRIANGLE_HZ, 0.1 * AxisProperties.of(axis).pace_hz)
    if axis.max_speed:
        frequency_hz = min(frequency_hz, 0.5 * axis.max_speed / abs(swing))
    rounding_s = 1.0 / AxisProperties.of(axis).pace_hz
    if axis.max_acceleration:
        rounding_s = max(rounding_s, 4.0 * abs(swing) * frequency_hz / axis.max_acceleration)
    total_s = _REST_S + _TRIANGLE_PERIODS / frequency_hz
    time_s = np.arange(round(total_s * rate_hz) + 1) / rate_hz - _REST_S
    # Averaging the triangle over this time replaces its corners by parabolas. The mean follows
    # from the integral of the triangle.
    rounding_s = min(rounding_s, 0.5 / frequency_hz)
    integral_at_end, integral_at_begin = (
        _integrate_triangle(np.maximum(frequency_hz * (time_s + shift), 0.0))
        for shift in (0.0, -rounding_s)
    )
    height = (integral_at_end - integral_at_begin) / (frequency_hz * rounding_s)
    return TuningScenario("triangle", make_read_only(middle + swing * height), _REST_S)


def _integrate_triangle(phase: FloatArray) -> FloatArray:
    """Return the integral from 0 of a triangle of period 1 that starts at 0 and rises to ½."""
    period = np.floor(phase)
    # The integral over a whole period is 0.
    x = phase - period
    first_rise, fall, last_rise = x**2, 0.125 - (x - 0.5) ** 2, (x - 1.0) ** 2
    return np.asarray(np.where(x < 0.25, first_rise, np.where(x < 0.75, fall, last_rise)))


def _find_middle(axis: Axis, length: float, name: str) -> float:
    if length == 0.0 or not abs(length) <= axis.span:
        raise TuningError(
            "{name} of {length}: must be no more than the axis' range, {most}, and not zero",
            name=name,
            length=format_exact(length, axis.unit or "", size=axis.span),
            most=format_exact(axis.span, axis.unit or ""),
        )
    return 0.5 * sum(axis.range)
