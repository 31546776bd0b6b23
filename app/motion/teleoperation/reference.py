"""A reference within limits of range, speed and acceleration, so that the machine can follow it.

Between two steps, the acceleration of the reference stays within its limit ``a``. Such a motion
exists if the change of speed Δv and the distance Δx over a step dt satisfy::

    |Δv| ≤ a dt,      |Δx − (v + v')/2 · dt| ≤ (a² dt² − Δv²) / (4 a)

In addition, the reference can always stop inside the range: ``x + v²/(2a) ≤ high``, and likewise at
the low end. Both conditions hold for any target and any sequence of steps. Source: reachable set of
the double integrator, e.g. A. E. Bryson and Y.-C. Ho, *Applied Optimal Control* (1975).

A target, or an end of the range, is also approached no faster than ``gap/T``. The machine receives
speeds, and each one acts until the next one arrives. A fast axis that braked as late as possible
would receive its stop only after it had passed the target.
"""

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import NamedTuple

from rotemina.app.errors import ScalingError
from rotemina.sim.messages import format_rounded

# This is T. It covers several steps of the loop and several exchanges with the device.
APPROACH_TIME_CONSTANT_S = 0.05


class ReferenceMotion(NamedTuple):
    """Position of a reference, m or rad, and its velocity, per s."""

    position: float
    velocity: float


@dataclass(frozen=True, slots=True)
class CoordinateBounds:
    """Limits of a coordinate's reference: range, m or rad, speed, per s, and acceleration, per s².

    Raises
    ------
    ScalingError
        If a bound is not finite, the range is empty, or speed or acceleration is not above 0.
    """

    low: float
    high: float
    max_speed: float
    max_acceleration: float

    def __post_init__(self) -> None:
        values = self.low, self.high, self.max_speed, self.max_acceleration
        if not all(map(isfinite, values)) or self.low > self.high or min(values[2:]) <= 0.0:
            raise ScalingError(
                "bounds: range {low} to {high}, speed {max_speed}, acceleration "
                "{max_acceleration}: they must be finite, the range not empty, speed and "
                "acceleration above 0",
                low=format_rounded(self.low, 6),
                high=format_rounded(self.high, 6),
                max_speed=format_rounded(self.max_speed, 6),
                max_acceleration=format_rounded(self.max_acceleration, 6),
            )

    def clip(self, position: float) -> float:
        """Return the nearest position inside the range."""
        return min(max(position, self.low), self.high)

    def limit_motion(self, position: float, velocity: float) -> ReferenceMotion:
        """Return the nearest motion that can still stop inside the range."""
        position = self.clip(position)
        max_upward_speed = sqrt(2.0 * self.max_acceleration * (self.high - position))
        max_downward_speed = sqrt(2.0 * self.max_acceleration * (position - self.low))
        max_speed = self.max_speed
        return ReferenceMotion(
            position,
            min(max(velocity, -max_speed, -max_downward_speed), max_speed, max_upward_speed),
        )

    def find_stopping_position(self, motion: ReferenceMotion) -> float:
        """Return the position at which a motion comes to rest under full braking."""
        position, velocity = motion
        return position + velocity * abs(velocity) / (2.0 * self.max_acceleration)

    def limit_speed(self, motion: ReferenceMotion, target_speed: float, dt: float) -> float:
        """Return the reachable speed after ``dt`` s that is nearest to a target speed."""
        position, velocity = motion
        max_change = self.max_acceleration * dt
        max_velocity = self.compute_approach_speed(self.high - position, velocity, dt)
        min_velocity = -self.compute_approach_speed(position - self.low, -velocity, dt)
        target_speed = min(
            max(target_speed, -self.max_speed, min_velocity), self.max_speed, max_velocity
        )
        return min(max(target_speed, velocity - max_change), velocity + max_change)

    def find_position(
        self, motion: ReferenceMotion, velocity: float, dt: float, target: float | None = None
    ) -> float:
        """Return the reachable position after ``dt`` s that is nearest to a target.

        ``velocity`` is the velocity at that time, from :meth:`limit_speed`. Without a target the
        velocity changes linearly over the step.
        """
        acceleration = self.max_acceleration
        uniform_position = motion.position + 0.5 * (motion.velocity + velocity) * dt
        max_deviation = (acceleration * dt) ** 2 - (velocity - motion.velocity) ** 2
        max_deviation = max(max_deviation, 0.0) / (4.0 * acceleration)
        braking_distance = velocity**2 / (2.0 * acceleration)
        position = (
            uniform_position
            if target is None
            else min(
                max(target, uniform_position - max_deviation), uniform_position + max_deviation
            )
        )
        low = self.low + (braking_distance if velocity < 0.0 else 0.0)
        high = self.high - (braking_distance if velocity > 0.0 else 0.0)
        return self.clip(min(max(position, low), high))

    def step_at_speed(self, motion: ReferenceMotion, speed: float, dt: float) -> ReferenceMotion:
        """Return the motion after a step towards a speed, within the limits."""
        velocity = self.limit_speed(motion, speed, dt)
        return ReferenceMotion(self.find_position(motion, velocity, dt), velocity)

    def step_toward(self, motion: ReferenceMotion, target: float, dt: float) -> ReferenceMotion:
        """Return the motion after a step towards a target, without overshoot if possible."""
        target = self.clip(target)
        gap = target - motion.position
        if gap >= 0.0:
            target_speed = self.compute_approach_speed(gap, motion.velocity, dt)
        else:
            target_speed = -self.compute_approach_speed(-gap, -motion.velocity, dt)
        velocity = self.limit_speed(motion, target_speed, dt)
        if target_speed == 0.0 and velocity == 0.0:
            return ReferenceMotion(self._find_end_position(motion, target, dt), 0.0)
        return ReferenceMotion(self.find_position(motion, velocity, dt), velocity)

    def compute_approach_speed(self, gap: float, velocity: float, dt: float) -> float:
        """Return the highest speed v' after ``dt`` s at which to approach a target at ``gap``.

        It is the smaller of two solutions. With ``(v + v') dt/2 + v'²/(2a) = gap`` the motion can
        still stop within the gap. With ``(v + v') dt/2 + v' T = gap`` the remaining gap would be
        covered in T. The speed is 0 if the motion must end within the step.
        """
        half_speed_change = 0.5 * self.max_acceleration * dt
        speed_squared = half_speed_change**2 + self.max_acceleration * (2.0 * gap - velocity * dt)
        stoppable_speed = sqrt(max(speed_squared, 0.0)) - half_speed_change
        decaying_speed = (gap - 0.5 * velocity * dt) / (APPROACH_TIME_CONSTANT_S + 0.5 * dt)
        return max(min(stoppable_speed, decaying_speed), 0.0)

    def _find_end_position(self, motion: ReferenceMotion, target: float, dt: float) -> float:
        """Return where a motion ends that stops within the step, at the target if possible."""
        end_of_hard_stop = self.find_stopping_position(motion)
        end_of_soft_stop = motion.position + 0.5 * motion.velocity * dt
        return self.clip(
            min(
                max(target, min(end_of_hard_stop, end_of_soft_stop)),
                max(end_of_hard_stop, end_of_soft_stop),
            )
        )
