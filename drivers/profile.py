"""A short motion executed by the device itself: consecutive cubic segments."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import copysign, sqrt

import numpy as np

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.axis_limits import check_target

MOST_SEGMENTS = 16
_SLACK = 1.0 + 1e-9


@dataclass(frozen=True, slots=True)
class ProfileSegment:
    """``x = x0 + c1 τ + c2 τ² + c3 τ³`` with τ from 0 to 1 over ``duration_s``; m or rad.

    x0 is where the segment before ended.
    """

    duration_s: float
    c1: float
    c2: float
    c3: float

    @property
    def length(self) -> float:
        """From its beginning to its end."""
        return self.c1 + self.c2 + self.c3

    def extremes(self) -> Iterator[float]:
        """Yield the end and the turning points, from the segment's beginning."""
        yield self.length
        for turn in self._turns():
            if 0.0 < turn < 1.0:
                yield ((self.c3 * turn + self.c2) * turn + self.c1) * turn

    def _turns(self) -> Iterator[float]:
        """Yield where the speed is zero, τ; as roots of a quadratic that lose no digits."""
        a, b, c = 3.0 * self.c3, self.c2, self.c1  # a τ² + 2 b τ + c
        inside = b * b - a * c
        if inside < 0.0:
            return
        q = -(b + copysign(sqrt(inside), b))
        # A division that overflows belongs to a turn far outside of the segment.
        if abs(q) < abs(a):
            yield q / a
        if abs(c) < abs(q):
            yield c / q

    def greatest_speed(self) -> float:
        """Return the greatest speed, m/s or rad/s."""
        places = [0.0, 1.0]
        if self.c3:
            places.append(float(np.clip(-self.c2 / (3.0 * self.c3), 0.0, 1.0)))
        speeds = [abs(self.c1 + 2.0 * self.c2 * at + 3.0 * self.c3 * at**2) for at in places]
        return max(speeds) / self.duration_s

    def greatest_acceleration(self) -> float:
        """Return the greatest acceleration within the segment, m/s² or rad/s²."""
        ends = (abs(2.0 * self.c2), abs(2.0 * self.c2 + 6.0 * self.c3))
        return max(ends) / self.duration_s**2


@dataclass(frozen=True, slots=True)
class Profile:
    """A motion of one axis from its present position."""

    axis: str
    segments: tuple[ProfileSegment, ...]

    @property
    def duration_s(self) -> float:
        """How long it takes."""
        return sum(one.duration_s for one in self.segments)

    def check(self, robot: Robot, start: float) -> None:
        """Refuse a profile that the axis cannot do from ``start``, m or rad.

        Raises
        ------
        InputError
            With the segment, the value and the bound.
        """
        check_target(robot, self.axis, start)
        if not 1 <= len(self.segments) <= MOST_SEGMENTS:
            raise InputError(
                message(
                    "engine", "profile of {axis}: {segments} segments: must be 1 to {most_segments}"
                ).fill(axis=self.axis, segments=len(self.segments), most_segments=MOST_SEGMENTS)
            )
        axis, unit = robot.axes[self.axis], robot.unit(self.axis) or ""
        at = start
        for number, segment in enumerate(self.segments, 1):
            where = f"profile of {self.axis}, segment {number}"
            numbers = (segment.duration_s, segment.c1, segment.c2, segment.c3)
            if not np.isfinite(numbers).all() or segment.duration_s <= 0.0:
                raise InputError(
                    message(
                        "engine", "{where}: duration and coefficients must be finite, time positive"
                    ).fill(where=where)
                )
            for extreme in segment.extremes():
                try:
                    check_target(robot, self.axis, at + extreme)
                except InputError as error:
                    raise InputError(
                        message("engine", "{where}: {error}").fill(where=where, error=str(error))
                    ) from error
            speed = segment.greatest_speed()
            if axis.max_speed is not None and speed > axis.max_speed * _SLACK:
                most = exact(axis.max_speed, f"{unit}/s")
                raise InputError(
                    message("engine", "{where}: {speed}: must be at most {most}").fill(
                        where=where, speed=exact(speed, f"{unit}/s"), most=most
                    )
                )
            acceleration = segment.greatest_acceleration()
            if axis.max_acceleration is not None and acceleration > axis.max_acceleration * _SLACK:
                most = exact(axis.max_acceleration, f"{unit}/s²")
                raise InputError(
                    message("engine", "{where}: {acceleration}: must be at most {most}").fill(
                        where=where, acceleration=exact(acceleration, f"{unit}/s²"), most=most
                    )
                )
            at += segment.length
