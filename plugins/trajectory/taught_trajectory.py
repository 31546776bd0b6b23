"""A trajectory of points that were taught: from one to the next, all axes together, with pauses."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.excitation.moves import quintic, rows_of, shortest_quintic
from rotemina.sim.excitation.quantity import ExcitationError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, Robot
from rotemina.sim.trajectory.axis_limits import check_target

RATE_HZ = 1000.0
LONGEST_PAUSE_S = 3600.0
MOST_ROWS = 5_000_000
_ACCELERATION = 0.5  # of an axis' greatest: what rings is excited less
_USUAL_CROSSING_S = 1.0  # of an axis without declared speed


@dataclass(frozen=True, slots=True)
class TaughtPoint:
    """A place of all axes, m and rad.

    ``speed`` is the share of the greatest of each axis on the way there, ``pause_s`` how long it
    rests there.
    """

    place: Mapping[str, float]
    speed: float = 0.5
    pause_s: float = 0.0


def taught(robot: Robot, points: Sequence[TaughtPoint], name: str) -> Record:
    """Return minimum-jerk moves from point to point; the slowest axis of each sets its time.

    Raises
    ------
    ExcitationError
        If there are fewer than two points, or a speed, a pause or the whole is beyond its bounds.
    OutOfLimitsError
        If a point is outside of an axis' range.
    """
    if len(points) < 2:
        raise ExcitationError(
            message("trajectory", "{n} points: a trajectory needs two or more; add another").fill(
                n=len(points)
            )
        )
    for number, point in enumerate(points, 1):
        _check(robot, number, point)
    axes = tuple(robot.axes)
    places = np.array([[point.place[axis] for axis in axes] for point in points])
    parts = [places[:1]]
    count = 1
    for (before, after), point in zip(pairwise(places), points[1:], strict=True):
        rows = rows_of(_duration_s(robot, np.abs(after - before), point.speed), RATE_HZ)
        rest = round(point.pause_s * RATE_HZ)
        count += rows + rest
        if count > MOST_ROWS:
            raise ExcitationError(
                message(
                    "trajectory",
                    "the points take more than {hours} h; shorten pauses or increase speeds",
                ).fill(hours=rounded(MOST_ROWS / RATE_HZ / 3600.0, 2))
            )
        columns = [quintic(a, b, rows) for a, b in zip(before, after, strict=True)]
        parts += [np.column_stack(columns), np.tile(after, (rest, 1))]
    commands = np.concatenate(parts)
    signals = {(axis, Tap.CMD): commands[:, k] for k, axis in enumerate(axes)}
    units = {axis: robot.unit(axis) or "m" for axis in axes}
    return Record.from_signals(np.arange(len(commands)) / RATE_HZ, signals, units, {"name": name})


def _check(robot: Robot, number: int, point: TaughtPoint) -> None:
    for axis in robot.axes:
        check_target(robot, axis, point.place[axis])
    if not 0.0 < point.speed <= 1.0:
        raise ExcitationError(
            message(
                "trajectory",
                "point {number}: the speed of {speed} % must be above 0 and at most 100 %",
            ).fill(number=number, speed=rounded(100.0 * point.speed))
        )
    if not 0.0 <= point.pause_s <= LONGEST_PAUSE_S:
        raise ExcitationError(
            message(
                "trajectory", "point {number}: the pause of {pause} s must be 0 to {most} s"
            ).fill(number=number, pause=rounded(point.pause_s), most=rounded(LONGEST_PAUSE_S))
        )


def _duration_s(robot: Robot, strokes: FloatArray, speed: float) -> float:
    """Return the least time in which all axes make their way, s."""
    return max(
        shortest_quintic(float(stroke), *_bounds(axis, speed), inf)
        for axis, stroke in zip(robot.axes.values(), strokes, strict=True)
    )


def _bounds(axis: Axis, speed: float) -> tuple[float, float]:
    greatest = axis.max_speed or axis.span / _USUAL_CROSSING_S
    return speed * greatest, _ACCELERATION * (axis.max_acceleration or inf)
