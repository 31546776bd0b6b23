"""A short motion of consecutive cubic segments, which the device executes without the host."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import copysign, sqrt
from typing import TYPE_CHECKING

import numpy as np

from rotemina.sim.compatibility import FormerMember, serve_former_names
from rotemina.sim.errors import InputError
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import check_target
from rotemina.sim.units import format_exact

MAX_SEGMENTS = 16
_ROUNDING_FACTOR = 1.0 + 1e-9


@dataclass(frozen=True, slots=True)
class ProfileSegment:
    """``x = x0 + c1 τ + c2 τ² + c3 τ³`` with τ from 0 to 1 over ``duration_s``; m or rad.

    x0 is the position at the end of the previous segment.
    """

    duration_s: float
    c1: float
    c2: float
    c3: float

    @property
    def displacement(self) -> float:
        """Displacement from the start to the end of the segment, m or rad."""
        return self.c1 + self.c2 + self.c3

    def find_extremes(self) -> Iterator[float]:
        """Yield the displacements at the end and at the turning points, m or rad."""
        yield self.displacement
        for tau in self._find_turning_points():
            if 0.0 < tau < 1.0:
                yield ((self.c3 * tau + self.c2) * tau + self.c1) * tau

    def _find_turning_points(self) -> Iterator[float]:
        # The speed is a τ² + 2 b τ + c. The roots are computed in a form without cancellation.
        a, b, c = 3.0 * self.c3, self.c2, self.c1
        discriminant = b * b - a * c
        if discriminant < 0.0:
            return
        q = -(b + copysign(sqrt(discriminant), b))
        # A root of 1 or more is outside the segment, and its quotient might overflow.
        if abs(q) < abs(a):
            yield q / a
        if abs(c) < abs(q):
            yield c / q

    def compute_max_speed(self) -> float:
        """Return the largest speed, m/s or rad/s."""
        # The extremes of the speed are at both ends, and where the acceleration is zero.
        extreme_taus = [0.0, 1.0]
        if self.c3:
            extreme_taus.append(float(np.clip(-self.c2 / (3.0 * self.c3), 0.0, 1.0)))
        speeds = [
            abs(self.c1 + 2.0 * self.c2 * tau + 3.0 * self.c3 * tau**2) for tau in extreme_taus
        ]
        return max(speeds) / self.duration_s

    def compute_max_acceleration(self) -> float:
        """Return the largest acceleration in the segment, m/s² or rad/s²."""
        # The acceleration is linear in time, so its extremes are at the ends.
        end_values = (abs(2.0 * self.c2), abs(2.0 * self.c2 + 6.0 * self.c3))
        return max(end_values) / self.duration_s**2

    # Former names, which work for one more release.
    extremes = FormerMember("find_extremes")
    greatest_acceleration = FormerMember("compute_max_acceleration")
    greatest_speed = FormerMember("compute_max_speed")
    length = FormerMember("displacement")


@dataclass(frozen=True, slots=True)
class MotionProfile:
    """A motion of one axis from its current position."""

    axis: str
    segments: tuple[ProfileSegment, ...]

    @property
    def duration_s(self) -> float:
        """Total duration, s."""
        return sum(segment.duration_s for segment in self.segments)

    def check(self, robot: Robot, start: float) -> None:
        """Check that the axis can execute the profile from ``start``, m or rad.

        Raises
        ------
        InputError
            If it cannot. The message contains the segment, the value and the bound.
        """
        check_target(robot, self.axis, start)
        if not 1 <= len(self.segments) <= MAX_SEGMENTS:
            raise InputError(
                "profile of {axis}: {segments} segments: must be 1 to {most_segments}",
                axis=self.axis,
                segments=len(self.segments),
                most_segments=MAX_SEGMENTS,
            )
        axis, unit = robot.axes[self.axis], robot.unit(self.axis) or ""
        position = start
        for number, segment in enumerate(self.segments, 1):
            where = f"profile of {self.axis}, segment {number}"
            values = (segment.duration_s, segment.c1, segment.c2, segment.c3)
            if not np.isfinite(values).all() or segment.duration_s <= 0.0:
                raise InputError(
                    "{where}: duration and coefficients must be finite, and the duration positive",
                    where=where,
                )
            for extreme in segment.find_extremes():
                try:
                    check_target(robot, self.axis, position + extreme)
                except InputError as error:
                    raise InputError("{where}: {error}", where=where, error=str(error)) from error
            speed = segment.compute_max_speed()
            if axis.max_speed is not None and speed > axis.max_speed * _ROUNDING_FACTOR:
                bound = format_exact(axis.max_speed, f"{unit}/s")
                raise InputError(
                    "{where}: {speed}: must be at most {most}",
                    where=where,
                    speed=format_exact(speed, f"{unit}/s"),
                    most=bound,
                )
            acceleration = segment.compute_max_acceleration()
            if (
                axis.max_acceleration is not None
                and acceleration > axis.max_acceleration * _ROUNDING_FACTOR
            ):
                bound = format_exact(axis.max_acceleration, f"{unit}/s²")
                raise InputError(
                    "{where}: {acceleration}: must be at most {most}",
                    where=where,
                    acceleration=format_exact(acceleration, f"{unit}/s²"),
                    most=bound,
                )
            position += segment.displacement


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        MOST_SEGMENTS="MAX_SEGMENTS",
        Profile="MotionProfile",
    )
