"""A sweep that gives an inverse and its axis the same history.

An inverse that is put on does not know what its axis went through, which decides where an axis with
hysteresis stands. A swing through the inverse over all that it saw wipes out what was before, in
the axis and in the inverse alike (Mayergoyz, "Mathematical Models of Hysteresis" (1991), sec. 1.2).
What creeps continues creeping.
"""

from math import inf, isfinite

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance, Inverse
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot
from rotemina.sim.shaping.moves import MotionLimits, minimum_jerk, shortest_minimum_jerk

NAME = "conditioning sweep"
_RATE_HZ = 500.0
_LEG_S, _REST_S = 0.8, 0.2  # of each of the three legs at least; after it
_INSETS = (0.01, 0.03, 0.05, 0.08, 0.12, 0.16, 0.2)  # of the span: how far from the ends it turns
_SLACK = 1e-3  # of the span


def conditioning(robot: Robot, model: InverseModel, start: float) -> Record:
    """Return a path from ``start`` (m or rad) to the high end, the low end, and back.

    It is to be played with the inverse on. It turns as near to the ends of what the inverse saw
    as commands stay inside the machine's range; the axis' speed and acceleration are kept.

    Raises
    ------
    CompensationError
        If ``start`` is beyond what the inverse saw.
    """
    axis = robot.axes[model.axis]
    low, high = (
        max(model.desired_range[0], axis.range[0]),
        min(model.desired_range[1], axis.range[1]),
    )
    if not low - _SLACK * model.span <= start <= high + _SLACK * model.span:
        raise CompensationError(
            message(
                "engine",
                "axis {axis}: a sweep from {start}: must begin between {low} and {high}, the "
                "training range of its inverse",
            ).fill(
                axis=model.axis,
                start=exact(start, model.unit, size=high),
                low=exact(low, model.unit, size=high),
                high=exact(high, model.unit),
            )
        )
    limits = MotionLimits(axis.max_speed or inf, axis.max_acceleration or inf)
    signal = next(
        (
            path
            for share in _INSETS
            if _can_be_told(model, path := _sweep(start, low, high, share * model.span, limits))
        ),
        None,
    )
    if signal is None:
        raise CompensationError(
            message(
                "engine",
                "axis {axis}: every sweep between {low} and {high} needs commands outside "
                "the limits of the machine; move the axis to mid-range first",
            ).fill(
                axis=model.axis, low=exact(low, model.unit, size=high), high=exact(high, model.unit)
            )
        )
    return Record.from_signals(
        np.arange(len(signal)) / _RATE_HZ,
        {(model.axis, Tap.CMD): signal},
        {model.axis: model.unit},
        {"name": NAME},
    )


def _sweep(start: float, low: float, high: float, inset: float, limits: MotionLimits) -> FloatArray:
    """Return the way (n,) by the high end and the low one."""
    path, at = [np.array([start])], start
    for end in (high - inset, low + inset, start):
        path.append(_leg(at, end, limits))
        at = end
    return np.concatenate(path)


def _can_be_told(model: InverseModel, path: FloatArray) -> bool:
    inverse = Inverse(model, 1.0 / _RATE_HZ)
    inverse.run(path)
    return not inverse.beyond & Exceedance.COMMAND


def _leg(start: float, end: float, limits: MotionLimits) -> FloatArray:
    """Return a move (n,) of minimum jerk with the rest after it."""
    rest = round(_REST_S * _RATE_HZ)
    if end == start:
        return np.full(rest, end)
    duration_s = _LEG_S
    if isfinite(limits.speed) or isfinite(limits.acceleration):
        duration_s = max(duration_s, shortest_minimum_jerk(end - start, limits).duration_s)
    time_s = np.arange(1, round(duration_s * _RATE_HZ) + rest + 1) / _RATE_HZ
    move = minimum_jerk(end - start, duration_s)
    return np.asarray(start + move.position(np.minimum(time_s, duration_s)))
