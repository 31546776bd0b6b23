"""Moves from rest to rest: S-curve, minimum jerk (also the shortest within limits), table."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite, sqrt

import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ShapingError
from rotemina.sim.shaping.move_shape import MoveShape

MAX_TABLE_ROWS = 1000
# Largest speed, acceleration and jerk of the polynomial 10 τ³ − 15 τ⁴ + 6 τ⁵.
_QUINTIC_SPEED, _QUINTIC_ACCELERATION, _QUINTIC_JERK = 15.0 / 8.0, 10.0 / sqrt(3.0), 60.0


@dataclass(frozen=True, slots=True)
class MotionLimits:
    """Limits of speed, acceleration and jerk of a move, per s, s² and s³.

    A limit is infinite if there is none.
    """

    speed: float = inf
    acceleration: float = inf
    jerk: float = inf

    def __post_init__(self) -> None:
        for name in ("speed", "acceleration", "jerk"):
            if not getattr(self, name) > 0.0:
                raise ShapingError(
                    "{name} limit of a move: {value}: must be more than 0",
                    name=name,
                    value=getattr(self, name),
                )


def make_s_curve(
    distance: float, duration_s: float, *, ramp: float = 0.3, rounding: float = 1.0
) -> MoveShape:
    """Return an S-curve of a given duration.

    The speed between the ramps is ``distance / ((1 − ramp) duration)``.

    Parameters
    ----------
    distance : float
        m or rad.
    duration_s : float
    ramp : float
        Share of the time for speeding up, and again for slowing down.
    rounding : float
        Share of a ramp in which the acceleration changes.

    Raises
    ------
    ShapingError
        If ``ramp`` is not in (0, ½], ``rounding`` not in (0, 1], distance or duration is not
        finite, or one of them is zero.
    """
    _check_distance(distance)
    _check_duration(duration_s)
    if not 0.0 < ramp <= 0.5 or not 0.0 < rounding <= 1.0:
        raise ShapingError(
            "S-curve: ramp {ramp}, rounding {rounding}: must be more than 0, and at most 0.5 and 1",
            ramp=ramp,
            rounding=rounding,
        )
    rounding_s = 0.5 * rounding * ramp * duration_s
    constant_s = ramp * duration_s - 2.0 * rounding_s
    return _make_seven_pieces(distance, rounding_s, constant_s, (1.0 - 2.0 * ramp) * duration_s)


def make_minimum_jerk(distance: float, duration_s: float) -> MoveShape:
    """Return the move ``distance (10 τ³ − 15 τ⁴ + 6 τ⁵)``.

    Of all moves of this duration it has the smallest ∫ jerk².

    Source: Flash and Hogan, Journal of Neuroscience 5 (1985) 1688–1703.
    """
    _check_distance(distance)
    _check_duration(duration_s)
    powers = duration_s ** -np.arange(5.0, -1.0, -1.0)
    coefficients = distance * powers * np.array([6.0, -15.0, 10.0, 0.0, 0.0, 0.0])
    return MoveShape(np.array([0.0, duration_s]), coefficients[:, None])


def make_shortest_minimum_jerk(distance: float, limits: MotionLimits) -> MoveShape:
    """Return the minimum-jerk move that just reaches the tightest of its limits."""
    _check_distance(distance)
    length = abs(distance)
    duration_s = max(
        _QUINTIC_SPEED * length / limits.speed,
        sqrt(_QUINTIC_ACCELERATION * length / limits.acceleration),
        (_QUINTIC_JERK * length / limits.jerk) ** (1.0 / 3.0),
    )
    if duration_s == 0.0:
        raise ShapingError("a minimum-jerk move needs a limit of speed, acceleration or jerk")
    return make_minimum_jerk(distance, duration_s)


def interpolate_table(time_s: Sequence[float], position: Sequence[float]) -> MoveShape:
    """Return a move through the rows of a table that is at rest at both ends.

    Between rows it is cubic, and it is monotonic where the table is (Fritsch and Carlson, SIAM J.
    Numer. Anal. 17 (1980) 238–246). The speed is continuous; the acceleration may jump.

    Raises
    ------
    ShapingError
        If the table is invalid. The message names the row.
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
    return MoveShape(spline.x, spline.c)


def _check_table(times: FloatArray, values: FloatArray) -> None:
    if times.ndim != 1 or times.shape != values.shape or not 2 <= len(times) <= MAX_TABLE_ROWS:
        raise ShapingError(
            "profile table: {size} times and {values_size} positions: both numbers must be "
            "equal, 2 to {most_rows}",
            size=times.size,
            values_size=values.size,
            most_rows=MAX_TABLE_ROWS,
        )
    if times[0] != 0.0 or values[0] != 0.0:
        raise ShapingError(
            "profile table, row 1: {times} s, {values}: it must begin at 0, 0",
            times=times[0],
            values=values[0],
        )
    is_invalid = ~(np.isfinite(times) & np.isfinite(values))
    is_invalid[1:] |= ~(np.diff(times) > 0.0)
    if is_invalid.any():
        row = int(np.argmax(is_invalid))
        raise ShapingError(
            "profile table, row {row}: {times} s, {values}: numbers must be finite, and "
            "times must rise from row to row",
            row=row + 1,
            times=times[row],
            values=values[row],
        )
    if values[-1] == 0.0:
        raise ShapingError("profile table, row {count}: it ends where it began", count=len(values))


def _make_seven_pieces(
    distance: float, rounding_s: float, constant_s: float, cruise_s: float
) -> MoveShape:
    """Return an S-curve with given times of changing and constant acceleration, and of cruise.

    Pieces of zero duration are left out.
    """
    spans = np.array([rounding_s, constant_s, rounding_s, cruise_s] + 3 * [0.0])
    spans[4:] = spans[2::-1]
    speed = distance / (cruise_s + 2.0 * rounding_s + constant_s)
    acceleration = speed / (rounding_s + constant_s)
    jerk = acceleration / rounding_s
    jerks = jerk * np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0])
    is_kept = spans > 1e-9 * rounding_s
    rows, x, v, a = [], 0.0, 0.0, 0.0
    for span, j in zip(spans[is_kept], jerks[is_kept], strict=True):
        rows.append((j / 6.0, a / 2.0, v, x))
        x += span * (v + span * (a / 2.0 + span * j / 6.0))
        v += span * (a + span * j / 2.0)
        a += span * j
    return MoveShape(np.concatenate([[0.0], np.cumsum(spans[is_kept])]), np.array(rows).T)


def _check_distance(distance: float) -> None:
    if not isfinite(distance) or distance == 0.0:
        raise ShapingError(
            "profile: distance {distance}: must be finite and not zero", distance=distance
        )


def _check_duration(duration_s: float) -> None:
    if not isfinite(duration_s) or duration_s <= 0.0:
        raise ShapingError(
            "profile: duration {duration_s} s: must be finite and positive", duration_s=duration_s
        )
