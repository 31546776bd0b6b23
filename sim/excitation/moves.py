"""Moves from rest to rest within speed and acceleration limits, used by many excitations.

The check of limits computes second differences between rows. These never exceed the maximum
acceleration of a motion with continuous speed, so the limits hold at any rate.
"""

from math import ceil, inf, sqrt

import numpy as np

from rotemina.sim.arrays import FloatArray

# Peak speed, acceleration and jerk of a minimum-jerk move, over stroke/T, stroke/T², stroke/T³.
QUINTIC_SPEED = 15.0 / 8.0
QUINTIC_ACCELERATION = 10.0 / sqrt(3.0)
QUINTIC_JERK = 60.0

# A duration may exceed whole rows by this fraction of a row.
_ROW_TOLERANCE = 1e-9


def compute_longest_stroke(duration_s: float, speed: float, acceleration: float) -> float:
    """Return the longest distance from rest to rest in a given time, m or rad.

    The limits may be infinite. The distance is ``v (T - v/a)`` if the speed v is reached, otherwise
    ``a T²/4``.
    """
    if speed == inf:
        return inf if acceleration == inf else acceleration * duration_s**2 / 4.0
    acceleration_s = speed / acceleration
    if acceleration_s <= duration_s / 2.0:
        return speed * (duration_s - acceleration_s)
    return acceleration * duration_s**2 / 4.0


def compute_shortest_duration(stroke: float, speed: float, acceleration: float) -> float:
    """Return the shortest time for a distance (>= 0) from rest to rest, s; 0 without limits."""
    if speed == inf or stroke * acceleration <= speed**2:
        return 2.0 * sqrt(stroke / acceleration)
    return stroke / speed + speed / acceleration


def compute_shortest_quintic(
    stroke: float, speed: float, acceleration: float, jerk: float
) -> float:
    """Return the shortest time of a minimum-jerk move over ``stroke`` >= 0, s."""
    jerk_limited_s: float = (QUINTIC_JERK * stroke / jerk) ** (1.0 / 3.0)
    acceleration_limited_s = sqrt(QUINTIC_ACCELERATION * stroke / acceleration)
    return max(QUINTIC_SPEED * stroke / speed, acceleration_limited_s, jerk_limited_s)


def count_rows(duration_s: float, rate_hz: float) -> int:
    """Return the number of rows that a move of at least this duration needs, 1 or more."""
    return max(1, ceil(duration_s * rate_hz - _ROW_TOLERANCE))


def compute_cruise_speed(stroke: float, duration_s: float, acceleration: float) -> float:
    """Return the cruise speed of a trapezoid that covers ``stroke`` in a given time.

    It is the smaller solution of ``v (T - v/a) = S``, in a form that permits an infinite a.
    """
    discriminant = max(duration_s**2 - 4.0 * abs(stroke) / acceleration, 0.0)
    return 2.0 * abs(stroke) / (duration_s + sqrt(discriminant))


def make_trapezoid(
    start: float, end: float, rows: int, rate_hz: float, acceleration: float
) -> FloatArray:
    """Return the (rows,) positions after ``start``: parabola, constant speed, parabola to ``end``.

    With an infinite acceleration the move is a straight line, or a jump if it has one row.
    """
    duration_s = rows / rate_hz
    stroke = abs(end - start)
    speed = compute_cruise_speed(stroke, duration_s, acceleration)
    if speed == 0.0:
        return np.full(rows, end)
    acceleration_s = min(speed / acceleration, duration_s / 2.0)
    elapsed_s = np.arange(1, rows + 1) / rate_hz
    remaining_s = duration_s - elapsed_s
    distance = speed * (elapsed_s - acceleration_s / 2.0)
    if acceleration_s > 0.0:
        ramp_acceleration = speed / acceleration_s
        distance = np.where(
            elapsed_s < acceleration_s, 0.5 * ramp_acceleration * elapsed_s**2, distance
        )
        distance = np.where(
            remaining_s < acceleration_s,
            stroke - 0.5 * ramp_acceleration * remaining_s**2,
            distance,
        )
    positions = start + np.copysign(distance, end - start)
    positions[-1] = end
    return np.asarray(positions)


def make_quintic(start: float, end: float, rows: int) -> FloatArray:
    """Return the (rows,) positions after ``start`` of the minimum-jerk move to ``end``.

    With ``10 s³ - 15 s⁴ + 6 s⁵``, speed and acceleration are 0 at both ends and the jerk is bounded
    (Flash and Hogan, J. Neurosci. 5, 1985).
    """
    progress = np.arange(1, rows + 1) / rows
    positions = start + (end - start) * progress**3 * (10.0 + progress * (6.0 * progress - 15.0))
    positions[-1] = end
    return np.asarray(positions)
