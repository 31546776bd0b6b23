"""Trajectory from taught points: all axes move together from point to point, with pauses."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import ExcitationRequestError
from rotemina.sim.excitation import compute_shortest_quintic, count_rows, make_quintic
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Axis, Robot
from rotemina.sim.trajectory import check_target

RATE_HZ = 1000.0
MAX_PAUSE_S = 3600.0
MAX_ROWS = 5_000_000
# The moves use this fraction of the maximum acceleration, to excite less vibration.
_ACCELERATION_FRACTION = 0.5
# An axis without a declared maximum speed crosses its range in this time.
_DEFAULT_CROSSING_S = 1.0


@dataclass(frozen=True, slots=True)
class TaughtPoint:
    """Point that the operator has taught.

    Attributes
    ----------
    place : mapping from axis to float
        The positions of all axes, m and rad.
    speed : float
        The speed of the move to the point, relative to the maximum speed of each axis.
    pause_s : float
        Time for which the machine rests at the point.
    """

    place: Mapping[str, float]
    speed: float = 0.5
    pause_s: float = 0.0


def make_taught_trajectory(robot: Robot, points: Sequence[TaughtPoint], name: str) -> Record:
    """Return a record of minimum-jerk moves from point to point.

    The slowest axis of each move sets its duration.

    Raises
    ------
    ExcitationRequestError
        If there are fewer than two points, or if a speed, a pause or the total duration is out of
        bounds.
    OutOfLimitsError
        If a point is outside the range of an axis.
    """
    if len(points) < 2:
        raise ExcitationRequestError(
            message("trajectory", "{n} points: a trajectory needs two or more; add another").fill(
                n=len(points)
            )
        )
    for number, point in enumerate(points, 1):
        _check_point(robot, number, point)
    axes = tuple(robot.axes)
    positions = np.array([[point.place[axis] for axis in axes] for point in points])
    segments = [positions[:1]]
    row_count = 1
    for (start, target), point in zip(pairwise(positions), points[1:], strict=True):
        duration_s = _compute_duration_s(robot, np.abs(target - start), point.speed)
        move_rows = count_rows(duration_s, RATE_HZ)
        pause_rows = round(point.pause_s * RATE_HZ)
        row_count += move_rows + pause_rows
        if row_count > MAX_ROWS:
            raise ExcitationRequestError(
                message(
                    "trajectory",
                    "the points take more than {hours} h; shorten pauses or increase speeds",
                ).fill(hours=format_rounded(MAX_ROWS / RATE_HZ / 3600.0, 2))
            )
        columns = [make_quintic(a, b, move_rows) for a, b in zip(start, target, strict=True)]
        segments += [np.column_stack(columns), np.tile(target, (pause_rows, 1))]
    commands = np.concatenate(segments)
    signals = {(axis, Tap.CMD): commands[:, column] for column, axis in enumerate(axes)}
    units = {axis: robot.unit(axis) or "m" for axis in axes}
    return Record.from_signals(np.arange(len(commands)) / RATE_HZ, signals, units, {"name": name})


def _check_point(robot: Robot, number: int, point: TaughtPoint) -> None:
    for axis in robot.axes:
        check_target(robot, axis, point.place[axis])
    if not 0.0 < point.speed <= 1.0:
        raise ExcitationRequestError(
            message(
                "trajectory",
                "point {number}: the speed of {speed} % must be above 0 and at most 100 %",
            ).fill(number=number, speed=format_rounded(100.0 * point.speed))
        )
    if not 0.0 <= point.pause_s <= MAX_PAUSE_S:
        raise ExcitationRequestError(
            message(
                "trajectory", "point {number}: the pause of {pause} s must be 0 to {most} s"
            ).fill(
                number=number, pause=format_rounded(point.pause_s), most=format_rounded(MAX_PAUSE_S)
            )
        )


def _compute_duration_s(robot: Robot, strokes: FloatArray, speed: float) -> float:
    return max(
        compute_shortest_quintic(float(stroke), *_find_speed_and_acceleration(axis, speed), inf)
        for axis, stroke in zip(robot.axes.values(), strokes, strict=True)
    )


def _find_speed_and_acceleration(axis: Axis, speed: float) -> tuple[float, float]:
    max_speed = axis.max_speed or axis.span / _DEFAULT_CROSSING_S
    return speed * max_speed, _ACCELERATION_FRACTION * (axis.max_acceleration or inf)
