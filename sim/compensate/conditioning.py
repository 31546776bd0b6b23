"""A conditioning sweep, which gives an inverse and its axis the same history.

An inverse that is switched on does not know the history of its axis, which determines the position
of an axis with hysteresis. A sweep through the inverse over its whole training range erases the
earlier history of both (Mayergoyz, "Mathematical Models of Hysteresis" (1991), sec. 1.2). It does
not stop creep.
"""

from math import inf, isfinite

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.inverse import Inverse, InverseExceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.errors import CompensationError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.shaping import (
    MotionLimits,
    make_minimum_jerk,
    make_shortest_minimum_jerk,
)
from rotemina.sim.units import format_exact

SWEEP_NAME = "conditioning sweep"
_RATE_HZ = 500.0
# Shortest duration of each of the three legs, and the rest after it.
_MIN_LEG_S, _REST_S = 0.8, 0.2
# Distances from the ends of the range at which the sweep turns, as shares of the span. The smallest
# feasible one is used.
_INSET_SHARES = (0.01, 0.03, 0.05, 0.08, 0.12, 0.16, 0.2)
# The start may be outside the range by this share of the span.
_SLACK_SHARE = 1e-3


def make_conditioning_sweep(robot: Robot, model: InverseModel, start: float) -> Record:
    """Return a path from ``start`` (m or rad) to the high end, the low end, and back.

    It must be played with the inverse on. It turns as close to the ends of the training range as
    the command range of the machine allows, within the axis' speed and acceleration limits.

    Raises
    ------
    CompensationError
        If ``start`` is outside the training range of the inverse, or no sweep is possible.
    """
    axis = robot.axes[model.axis]
    low, high = (
        max(model.desired_range[0], axis.range[0]),
        min(model.desired_range[1], axis.range[1]),
    )
    if not low - _SLACK_SHARE * model.span <= start <= high + _SLACK_SHARE * model.span:
        raise CompensationError(
            "axis {axis}: a sweep from {start}: must begin between {low} and {high}, the "
            "training range of its inverse",
            axis=model.axis,
            start=format_exact(start, model.unit, size=high),
            low=format_exact(low, model.unit, size=high),
            high=format_exact(high, model.unit),
        )
    limits = MotionLimits(axis.max_speed or inf, axis.max_acceleration or inf)
    signal = next(
        (
            path
            for share in _INSET_SHARES
            if _is_feasible(
                model, path := _make_sweep(start, low, high, share * model.span, limits)
            )
        ),
        None,
    )
    if signal is None:
        raise CompensationError(
            "axis {axis}: every sweep between {low} and {high} needs commands outside "
            "the limits of the machine; move the axis to mid-range first",
            axis=model.axis,
            low=format_exact(low, model.unit, size=high),
            high=format_exact(high, model.unit),
        )
    return Record.from_signals(
        np.arange(len(signal)) / _RATE_HZ,
        {(model.axis, Tap.CMD): signal},
        {model.axis: model.unit},
        {"name": SWEEP_NAME},
    )


def _make_sweep(
    start: float, low: float, high: float, inset: float, limits: MotionLimits
) -> FloatArray:
    parts, position = [np.array([start])], start
    for end in (high - inset, low + inset, start):
        parts.append(_make_leg(position, end, limits))
        position = end
    return np.concatenate(parts)


def _is_feasible(model: InverseModel, path: FloatArray) -> bool:
    inverse = Inverse(model, 1.0 / _RATE_HZ)
    inverse.run(path)
    return not inverse.exceedance & InverseExceedance.COMMAND


def _make_leg(start: float, end: float, limits: MotionLimits) -> FloatArray:
    rest_rows = round(_REST_S * _RATE_HZ)
    if end == start:
        return np.full(rest_rows, end)
    duration_s = _MIN_LEG_S
    if isfinite(limits.speed) or isfinite(limits.acceleration):
        duration_s = max(duration_s, make_shortest_minimum_jerk(end - start, limits).duration_s)
    time_s = np.arange(1, round(duration_s * _RATE_HZ) + rest_rows + 1) / _RATE_HZ
    move = make_minimum_jerk(end - start, duration_s)
    return np.asarray(start + move.position(np.minimum(time_s, duration_s)))
