"""A reference within range, speed and acceleration that the machine can follow.

Between two steps the reference is some motion whose acceleration stays within its bound ``a``. That
is so where the change of speed Δv over a step dt, and the way, satisfy::

    |Δv| ≤ a dt,      |way − (v + v')/2 · dt| ≤ (a² dt² − Δv²) / (4 a)

and it can always still stop inside the range: ``x + v²/(2a) ≤ high`` and likewise at the low end.
Both hold whatever is wished, and however the steps vary. Source: reachable set of the double
integrator, e.g. A. E. Bryson and Y.-C. Ho, *Applied Optimal Control* (1975).

A target, and an end of the range, is approached no faster than ``gap/T`` as well. The machine is
told speeds, and each acts until the next one has come over the line: a brisk axis that braked as
late as it may would be told to stop when it has long gone by.
"""

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import NamedTuple

from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded

APPROACH_S = 0.05  # T: several steps of the loop and turns of the line


class ScalingError(InputError):
    """A law or its parameters that an axis cannot be driven by."""


class Motion(NamedTuple):
    """Where a reference is, m or rad, and how fast it goes, per s."""

    position: float
    velocity: float


@dataclass(frozen=True, slots=True)
class Bounds:
    """What a coordinate's reference keeps to: m or rad, per s, per s².

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
                message(
                    "engine",
                    "bounds: range {low} to {high}, speed {max_speed}, acceleration "
                    "{max_acceleration}: they must be finite, the range not empty, speed and "
                    "acceleration above 0",
                ).fill(
                    low=rounded(self.low, 6),
                    high=rounded(self.high, 6),
                    max_speed=rounded(self.max_speed, 6),
                    max_acceleration=rounded(self.max_acceleration, 6),
                )
            )

    def clip(self, position: float) -> float:
        """Return the nearest position inside the range."""
        return min(max(position, self.low), self.high)

    def begin(self, position: float, velocity: float) -> Motion:
        """Return the nearest motion that can be gone on with: it may still stop in the range."""
        position = self.clip(position)
        up = sqrt(2.0 * self.max_acceleration * (self.high - position))
        down = sqrt(2.0 * self.max_acceleration * (position - self.low))
        fastest = self.max_speed
        return Motion(position, min(max(velocity, -fastest, -down), fastest, up))

    def stopping_place(self, motion: Motion) -> float:
        """Return where a motion comes to rest under full braking."""
        position, velocity = motion
        return position + velocity * abs(velocity) / (2.0 * self.max_acceleration)

    def speed(self, motion: Motion, wanted: float, dt: float) -> float:
        """Return the speed after ``dt`` s that is nearest to the wanted."""
        position, velocity = motion
        most = self.max_acceleration * dt
        up = self.approach_speed(self.high - position, velocity, dt)
        down = -self.approach_speed(position - self.low, -velocity, dt)
        wanted = min(max(wanted, -self.max_speed, down), self.max_speed, up)
        return min(max(wanted, velocity - most), velocity + most)

    def place(
        self, motion: Motion, velocity: float, dt: float, wanted: float | None = None
    ) -> float:
        """Return the position after ``dt`` s nearest to the wanted, at a speed from :meth:`speed`.

        Without a wanted the speed changes evenly on the way.
        """
        most = self.max_acceleration
        middle = motion.position + 0.5 * (motion.velocity + velocity) * dt
        room = (most * dt) ** 2 - (velocity - motion.velocity) ** 2
        room = max(room, 0.0) / (4.0 * most)
        braking = velocity**2 / (2.0 * most)
        place = middle if wanted is None else min(max(wanted, middle - room), middle + room)
        low = self.low + (braking if velocity < 0.0 else 0.0)
        high = self.high - (braking if velocity > 0.0 else 0.0)
        return self.clip(min(max(place, low), high))

    def at_speed(self, motion: Motion, speed: float, dt: float) -> Motion:
        """Go over to a speed as fast as allowed."""
        velocity = self.speed(motion, speed, dt)
        return Motion(self.place(motion, velocity, dt), velocity)

    def toward(self, motion: Motion, target: float, dt: float) -> Motion:
        """Go to a target as fast as it may be approached; not past it where that is possible."""
        target = self.clip(target)
        gap = target - motion.position
        if gap >= 0.0:
            wanted = self.approach_speed(gap, motion.velocity, dt)
        else:
            wanted = -self.approach_speed(-gap, -motion.velocity, dt)
        velocity = self.speed(motion, wanted, dt)
        if wanted == 0.0 and velocity == 0.0:
            return Motion(self._landing(motion, target, dt), 0.0)
        return Motion(self.place(motion, velocity, dt), velocity)

    def approach_speed(self, gap: float, velocity: float, dt: float) -> float:
        """Return the greatest speed after ``dt`` s, per s, at which ``gap`` may be approached.

        It is the lesser of v' that solves ``(v + v') dt/2 + v'²/(2a) = gap``, from which one still
        stops within the gap, and that of ``(v + v') dt/2 + v' T = gap``, at which what then is left
        lasts for T; 0 where the motion must end within the step.
        """
        half = 0.5 * self.max_acceleration * dt
        square = half**2 + self.max_acceleration * (2.0 * gap - velocity * dt)
        stopping = sqrt(max(square, 0.0)) - half
        slowing = (gap - 0.5 * velocity * dt) / (APPROACH_S + 0.5 * dt)
        return max(min(stopping, slowing), 0.0)

    def _landing(self, motion: Motion, target: float, dt: float) -> float:
        """Return where a motion that ends within the step does: on the target if it can."""
        hard = self.stopping_place(motion)
        soft = motion.position + 0.5 * motion.velocity * dt
        return self.clip(min(max(target, min(hard, soft)), max(hard, soft)))
