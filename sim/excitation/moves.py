"""Moves from rest to rest within speed and acceleration limits, used by many excitations.

Between two rows the judge of limits sees a second difference; it never exceeds the greatest
acceleration of a continuous motion with continuous speed, so these bounds hold at any rate.
"""

from math import ceil, inf, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray

# Peaks of the minimum-jerk move's speed, acceleration and jerk over stroke/T, stroke/T², stroke/T³.
QUINTIC_SPEED = 15.0 / 8.0
QUINTIC_ACCELERATION = 10.0 / sqrt(3.0)
QUINTIC_JERK = 60.0

_ON_A_ROW = 1e-9  # of a row: a duration that is this much longer than whole rows is whole


def longest_stroke(duration_s: float, speed: float, acceleration: float) -> float:
    """Return the longest way from rest to rest in a time, m or rad; bounds may be infinite.

    ``v (T - v/a)`` where the speed v is reached, else ``a T²/4``.
    """
    if speed == inf:
        return inf if acceleration == inf else acceleration * duration_s**2 / 4.0
    starting = speed / acceleration
    if starting <= duration_s / 2.0:
        return speed * (duration_s - starting)
    return acceleration * duration_s**2 / 4.0


def shortest_duration(stroke: float, speed: float, acceleration: float) -> float:
    """Return the least time for a distance (>= 0) from rest to rest, s; 0 without limits."""
    if speed == inf or stroke * acceleration <= speed**2:
        return 2.0 * sqrt(stroke / acceleration)
    return stroke / speed + speed / acceleration


def shortest_quintic(stroke: float, speed: float, acceleration: float, jerk: float) -> float:
    """Return the least time of a minimum-jerk move over ``stroke`` >= 0, s."""
    by_jerk: float = (QUINTIC_JERK * stroke / jerk) ** (1.0 / 3.0)
    by_acceleration = sqrt(QUINTIC_ACCELERATION * stroke / acceleration)
    return max(QUINTIC_SPEED * stroke / speed, by_acceleration, by_jerk)


def rows_of(duration_s: float, rate_hz: float) -> int:
    """Return the rows in which a move of at least this duration fits, 1 or more."""
    return max(1, ceil(duration_s * rate_hz - _ON_A_ROW))


def cruise_speed(stroke: float, duration_s: float, acceleration: float) -> float:
    """Return the speed of the trapezoid that covers ``stroke`` in a time at an acceleration.

    The lesser solution of ``v (T - v/a) = S``, written so that a may be infinite.
    """
    rest = max(duration_s**2 - 4.0 * abs(stroke) / acceleration, 0.0)
    return 2.0 * abs(stroke) / (duration_s + sqrt(rest))


def trapezoid(
    start: float, end: float, rows: int, rate_hz: float, acceleration: float
) -> FloatArray:
    """Return the (rows,) positions after ``start``: parabola, constant speed, parabola to ``end``.

    With an infinite acceleration it is a line, over one row a jump.
    """
    duration = rows / rate_hz
    stroke = abs(end - start)
    speed = cruise_speed(stroke, duration, acceleration)
    if speed == 0.0:
        return np.full(rows, end)
    starting = min(speed / acceleration, duration / 2.0)
    since = np.arange(1, rows + 1) / rate_hz
    left = duration - since
    way = speed * (since - starting / 2.0)
    if starting > 0.0:
        rate = speed / starting
        way = np.where(since < starting, 0.5 * rate * since**2, way)
        way = np.where(left < starting, stroke - 0.5 * rate * left**2, way)
    positions = start + np.copysign(way, end - start)
    positions[-1] = end
    return np.asarray(positions)


def quintic(start: float, end: float, rows: int) -> FloatArray:
    """Return the (rows,) positions after ``start`` of the minimum-jerk move to ``end``.

    ``10 s³ - 15 s⁴ + 6 s⁵``: speed and acceleration are 0 at both ends and the jerk is bounded
    (Flash and Hogan, J. Neurosci. 5, 1985).
    """
    share = np.arange(1, rows + 1) / rows
    positions = start + (end - start) * share**3 * (10.0 + share * (6.0 * share - 15.0))
    positions[-1] = end
    return np.asarray(positions)
