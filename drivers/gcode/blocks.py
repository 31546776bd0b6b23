"""Motion queue of the emulated controller: straight blocks, which its axes follow."""

from collections import deque
from collections.abc import Sequence
from math import inf, sqrt

# The axes brake between two blocks if the cosine of the angle between them is smaller.
_MIN_STRAIGHT_COSINE = 0.9999
# A target counts as reached at a shorter distance, mm or degrees.
_ARRIVAL_DISTANCE = 1e-7


class _Block:
    """A straight path, mm or degrees, with its unit direction vector and its speed limit, per s."""

    def __init__(self, start: Sequence[float], end: Sequence[float]) -> None:
        displacements = [target - origin for origin, target in zip(start, end, strict=True)]
        self.length = sqrt(sum(component * component for component in displacements))
        self.direction = [
            component / self.length if self.length else 0.0 for component in displacements
        ]
        self.end = tuple(end)
        self.max_speed = inf

    def is_aligned_with(self, other: "_Block") -> bool:
        pairs = zip(self.direction, other.direction, strict=True)
        return sum(a * b for a, b in pairs) > _MIN_STRAIGHT_COSINE


class MotionQueue:
    """Queue of straight blocks, along which the axes accelerate and brake.

    The axis with the lowest limits along a block determines its speed and acceleration.

    Parameters
    ----------
    position : sequence of float
        Current position of each axis, mm or degrees.
    rates, accelerations : sequence of float
        Limits of each axis, per minute and per s².
    """

    def __init__(
        self, position: Sequence[float], rates: Sequence[float], accelerations: Sequence[float]
    ) -> None:
        self.position = list(position)
        self.speed = 0.0
        self._queue: deque[_Block] = deque()
        self.set_limits(rates, accelerations)

    def set_limits(self, rates: Sequence[float], accelerations: Sequence[float]) -> None:
        """Set the limits of each axis, per minute and per s²."""
        self._rates = [rate / 60.0 for rate in rates]
        self._accelerations = list(accelerations)

    @property
    def block_count(self) -> int:
        """Number of blocks that are waiting or being executed."""
        return len(self._queue)

    @property
    def has_blocks(self) -> bool:
        """Whether any block is left in the queue."""
        return bool(self._queue)

    @property
    def is_moving(self) -> bool:
        """Whether the speed is greater than zero."""
        return self.speed > 0.0

    @property
    def end(self) -> tuple[float, ...]:
        """End of the last block, or the current position if there are no blocks."""
        return self._queue[-1].end if self._queue else tuple(self.position)

    def round_to_steps(self, steps: Sequence[float]) -> list[float]:
        """Return the position rounded to whole steps, given each axis' steps per mm or degree."""
        return [
            round(position * steps_per_unit) / steps_per_unit
            for position, steps_per_unit in zip(self.position, steps, strict=True)
        ]

    def add(self, end: Sequence[float], speed: float) -> None:
        """Append a straight path to `end`, with a speed of at most `speed`, per s."""
        block = _Block(self.end, end)
        if block.length < _ARRIVAL_DISTANCE:
            return
        block.max_speed = min(speed, self._find_bound(block, self._rates))
        self._queue.append(block)

    def set_position(self, axis: int, position: float) -> None:
        """Set the position of an axis at rest without moving it."""
        self.position[axis] = position

    def clear(self) -> None:
        """Remove all blocks; the axes stop at once."""
        self._queue.clear()
        self.speed = 0.0

    halt = clear

    def step(self, dt_s: float, *, hold: bool) -> None:
        """Advance the axes by a time step. During a `hold` they brake, and the blocks are kept."""
        remaining_s = dt_s
        while self._queue and remaining_s > 0.0:
            block = self._queue[0]
            acceleration = self._find_bound(block, self._accelerations)
            target_speed = (
                0.0
                if hold
                else min(block.max_speed, self._find_stoppable_speed(acceleration, dt_s))
            )
            change = acceleration * remaining_s
            self.speed = min(max(target_speed, self.speed - change), self.speed + change)
            if self.speed <= 0.0:
                return
            remaining_length = self._find_remaining_length(block)
            distance = min(self.speed * remaining_s, remaining_length)
            self._advance(block, distance, remaining_length)
            remaining_s = (
                remaining_s - distance / self.speed if distance == remaining_length else 0.0
            )
            if self._queue and self._queue[0] is not block:
                continue
            if not self._queue:
                self.speed = 0.0

    def _advance(self, block: _Block, distance: float, remaining_length: float) -> None:
        if remaining_length - distance < _ARRIVAL_DISTANCE:
            self.position = list(block.end)
            self._queue.popleft()
            if self._queue and not self._queue[0].is_aligned_with(block):
                self.speed = 0.0
        else:
            pairs = zip(self.position, block.direction, strict=True)
            self.position = [position + distance * component for position, component in pairs]

    def _find_stoppable_speed(self, acceleration: float, dt_s: float) -> float:
        """Return the greatest speed from which the axes can halt at the end of the aligned blocks.

        The axes keep this speed v for one more time step dt, and then brake with the acceleration a
        to the end of the remaining length L: v dt + v²/2a = L.
        """
        remaining_length, previous = 0.0, None
        for block in self._queue:
            if previous is not None and not block.is_aligned_with(previous):
                break
            remaining_length += (
                self._find_remaining_length(block) if previous is None else block.length
            )
            previous = block
        return acceleration * (sqrt(dt_s**2 + 2.0 * remaining_length / acceleration) - dt_s)

    def _find_remaining_length(self, block: _Block) -> float:
        pairs = zip(block.end, self.position, strict=True)
        return sqrt(sum((end - position) ** 2 for end, position in pairs))

    def _find_bound(self, block: _Block, bounds: Sequence[float]) -> float:
        """Return the bound along a block that keeps every axis within its own bound."""
        pairs = zip(bounds, block.direction, strict=True)
        return min(bound / abs(component) for bound, component in pairs if component)
