"""Moves from rest to rest: S-curve, minimum jerk, a table; the shortest ones within limits."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, sqrt

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.shaping.errors import ShapingError
from rotemina.sim.shaping.move_shape import Shape

MOST_ROWS = 1000  # of a table
# Of 10 τ³ − 15 τ⁴ + 6 τ⁵: the greatest speed, acceleration and jerk.
_QUINTIC_SPEED, _QUINTIC_ACCELERATION, _QUINTIC_JERK = 15.0 / 8.0, 10.0 / sqrt(3.0), 60.0


@dataclass(frozen=True, slots=True)
class MotionLimits:
    """Greatest speed, acceleration and jerk of a move, per s, s² and s³; infinite where none."""

    speed: float = inf
    acceleration: float = inf
    jerk: float = inf

    def __post_init__(self) -> None:
        for name in ("speed", "acceleration", "jerk"):
            if not getattr(self, name) > 0.0:
                raise ShapingError(
                    message("engine", "{name} limit of a move: {value}: must be more than 0").fill(
                        name=name, value=getattr(self, name)
                    )
                )


def s_curve_in(
    distance: float, duration_s: float, *, ramp: float = 0.3, rounding: float = 1.0
) -> Shape:
    """Return an S-curve of this duration.

    ``ramp`` is the share of the time in which it speeds up, and again in which it slows down;
    ``rounding`` the share of a ramp in which the acceleration changes. The speed between the ramps
    is ``distance / ((1 − ramp) duration)``.

    Raises
    ------
    ShapingError
        If the ramp is none of 0 to ½, the rounding none of 0 to 1, or distance or time is none.
    """
    _check_distance(distance)
    _check_duration(duration_s)
    if not 0.0 < ramp <= 0.5 or not 0.0 < rounding <= 1.0:
        raise ShapingError(
            message(
                "engine",
                "S-curve: ramp {ramp}, rounding {rounding}: must be more than 0, and at most "
                "0.5 and 1",
            ).fill(ramp=ramp, rounding=rounding)
        )
    rounding_s = 0.5 * rounding * ramp * duration_s
    steady_s = ramp * duration_s - 2.0 * rounding_s
    return _seven_pieces(distance, rounding_s, steady_s, (1.0 - 2.0 * ramp) * duration_s)


def minimum_jerk(distance: float, duration_s: float) -> Shape:
    """Return ``distance (10 τ³ − 15 τ⁴ + 6 τ⁵)``: of all moves in this time, least ∫ jerk².

    Source: Flash and Hogan, Journal of Neuroscience 5 (1985) 1688–1703.
    """
    _check_distance(distance)
    _check_duration(duration_s)
    powers = duration_s ** -np.arange(5.0, -1.0, -1.0)
    row = distance * powers * np.array([6.0, -15.0, 10.0, 0.0, 0.0, 0.0])
    return Shape(np.array([0.0, duration_s]), row[:, None])


def shortest_minimum_jerk(distance: float, limits: MotionLimits) -> Shape:
    """Return the minimum-jerk move that meets the tightest of its limits with equality."""
    _check_distance(distance)
    way = abs(distance)
    duration_s = max(
        _QUINTIC_SPEED * way / limits.speed,
        sqrt(_QUINTIC_ACCELERATION * way / limits.acceleration),
        (_QUINTIC_JERK * way / limits.jerk) ** (1.0 / 3.0),
    )
    if duration_s == 0.0:
        raise ShapingError(
            message("engine", "a minimum-jerk move needs a limit of speed, acceleration or jerk")
        )
    return minimum_jerk(distance, duration_s)


def tabled(time_s: Sequence[float], position: Sequence[float]) -> Shape:
    """Return a move through the rows of a table, at rest at both ends.

    Between rows it is cubic and never turns where the table does not (Fritsch and Carlson, SIAM J.
    Numer. Anal. 17 (1980) 238–246); speed has no jumps, acceleration may.

    Raises
    ------
    ShapingError
        With the row.
    """
    times = np.asarray(time_s, dtype=np.float64)
    values = np.asarray(position, dtype=np.float64)
    _check_table(times, values)
    if len(times) == 2:
        slopes = np.zeros(2)
    else:
        slopes = np.array(scipy.interpolate.PchipInterpolator(times, values).derivative()(times))
        slopes[0] = slopes[-1] = 0.0
    spline = scipy.interpolate.CubicHermiteSpline(times, values, slopes)
    return Shape(spline.x, spline.c)


def _check_table(times: FloatArray, values: FloatArray) -> None:
    if times.ndim != 1 or times.shape != values.shape or not 2 <= len(times) <= MOST_ROWS:
        raise ShapingError(
            message(
                "engine",
                "profile table: {size} times and {values_size} positions: must be equally "
                "many, 2 to {most_rows}",
            ).fill(size=times.size, values_size=values.size, most_rows=MOST_ROWS)
        )
    if times[0] != 0.0 or values[0] != 0.0:
        raise ShapingError(
            message(
                "engine", "profile table, row 1: {times} s, {values}: it must begin at 0, 0"
            ).fill(times=times[0], values=values[0])
        )
    wrong = ~(np.isfinite(times) & np.isfinite(values))
    wrong[1:] |= ~(np.diff(times) > 0.0)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ShapingError(
            message(
                "engine",
                "profile table, row {row}: {times} s, {values}: numbers must be finite, and times "
                "rise from row to row",
            ).fill(row=row + 1, times=times[row], values=values[row])
        )
    if values[-1] == 0.0:
        raise ShapingError(
            message("engine", "profile table, row {count}: it ends where it began").fill(
                count=len(values)
            )
        )


def _seven_pieces(distance: float, rounding_s: float, steady_s: float, cruise_s: float) -> Shape:
    """Return an S-curve of these times; pieces of no length are left out."""
    spans = np.array([rounding_s, steady_s, rounding_s, cruise_s] + 3 * [0.0])
    spans[4:] = spans[2::-1]
    speed = distance / (cruise_s + 2.0 * rounding_s + steady_s)
    acceleration = speed / (rounding_s + steady_s)
    jerk = acceleration / rounding_s
    jerks = jerk * np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0])
    kept = spans > 1e-9 * rounding_s
    rows, x, v, a = [], 0.0, 0.0, 0.0
    for span, j in zip(spans[kept], jerks[kept], strict=True):
        rows.append((j / 6.0, a / 2.0, v, x))
        x += span * (v + span * (a / 2.0 + span * j / 6.0))
        v += span * (a + span * j / 2.0)
        a += span * j
    return Shape(np.concatenate([[0.0], np.cumsum(spans[kept])]), np.array(rows).T)


def _check_distance(distance: float) -> None:
    if not isfinite(distance) or distance == 0.0:
        raise ShapingError(
            message("engine", "profile: distance {distance}: must be finite and not zero").fill(
                distance=distance
            )
        )


def _check_duration(duration_s: float) -> None:
    if not isfinite(duration_s) or duration_s <= 0.0:
        raise ShapingError(
            message("engine", "profile: duration {duration_s} s: must be finite and positive").fill(
                duration_s=duration_s
            )
        )
