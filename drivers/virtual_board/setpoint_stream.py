"""Stream of set-points in a board: its queued segments, and the commands over time."""

from collections import deque
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from rotemina.drivers.mc68hc11.protocol import QUEUE_SEGMENTS, AxisDifferences, BeginStream
from rotemina.drivers.virtual_board.clock import TIME_MASK
from rotemina.sim.arrays import FloatArray, IntArray

_INDEX_COUNT = 256
# A segment with the index of one of this many previous segments counts as repeated.
_MAX_REPEATED_INDICES = 128


class StreamPoint(NamedTuple):
    """Set-point: the commands at a tick, whole steps.

    ``begins_segment`` says whether the set-point is the first one of its segment.
    """

    tick: int
    position: tuple[int, ...]
    begins_segment: bool


class SetpointStream:
    """Queue of segments. Only the segment with the next index is accepted.

    Each segment continues the previous one. Times are board times, because the board's own crystal
    determines its ticks.
    """

    def __init__(self) -> None:
        self._points: deque[StreamPoint] = deque()
        # Number of queued segments that have not begun.
        self._waiting_count = 0
        self._next_number = 0
        # Number of segments that must still be received.
        self._remaining_count = 0
        self._hold = 1
        self._fraction = 0
        # Position at the latest set-point that was received, including fractional bits.
        self._latest_position: list[int] = []
        # Board time at which the latest received segment ends and the next one begins.
        self._end_us = 0
        self._latest_point: StreamPoint | None = None
        # Speeds between the latest two set-points that took effect, steps per tick.
        self.speeds: tuple[float, ...] = ()

    @property
    def playing(self) -> bool:
        """Whether set-points are queued or must still be received."""
        return bool(self._points) or self._remaining_count > 0

    @property
    def full(self) -> bool:
        """Whether the queue has no room for another segment."""
        return self._waiting_count >= QUEUE_SEGMENTS

    @property
    def expected_index(self) -> int:
        """Index of the next segment, or 0 while no stream plays."""
        return self._next_number % _INDEX_COUNT if self.playing else 0

    @property
    def next_start_us(self) -> int:
        """Board time at which the next segment begins."""
        return self._end_us

    @property
    def has_begun(self) -> bool:
        """Whether a segment has been received."""
        return self._next_number > 0

    @property
    def hold(self) -> int:
        """Number of ticks between two changes of the command."""
        return self._hold

    def begin(self, command: BeginStream, position: Sequence[int]) -> None:
        """Begin a stream that starts at a position, whole steps, and wait for its segments."""
        self.clear()
        self._next_number, self._remaining_count = 0, command.segments
        self._hold, self._fraction = command.hold, command.fraction
        # Adding half a step makes the later truncation of the fraction round to the nearest step.
        half_step = 1 << command.fraction >> 1
        self._latest_position = [(steps << command.fraction) + half_step for steps in position]
        self._end_us = command.time_us

    def is_expected(self, index: int) -> bool:
        """Return whether this index is the next one."""
        return self._remaining_count > 0 and index == self._next_number % _INDEX_COUNT

    def has_taken(self, index: int) -> bool:
        """Return whether the segment with this index was received before."""
        return (
            1
            <= (self._next_number - index) % _INDEX_COUNT
            <= min(self._next_number, _MAX_REPEATED_INDICES)
        )

    def compute_positions(self, ticks: int, axes: AxisDifferences) -> IntArray:
        """Return the commands (changes, axes) of a segment, including fractional bits."""
        count = np.arange(1, ticks // self._hold + 1, dtype=np.int64)[:, None]
        first, second = np.array(axes, dtype=np.int64).T
        return np.asarray(self._latest_position + count * first + count * (count + 1) // 2 * second)

    def to_steps(self, positions: IntArray) -> IntArray:
        """Return commands in whole steps."""
        return positions >> self._fraction

    @property
    def latest_steps(self) -> IntArray:
        """Position (axes,) at the end of the latest segment, whole steps."""
        return np.array(self._latest_position, dtype=np.int64) >> self._fraction

    def take_segment(
        self, positions: IntArray, tick_at: Callable[[int], int], tick_us: float, ticks: int
    ) -> None:
        """Queue the next segment.

        ``tick_at`` returns the tick of a board time. The segment lasts for ``ticks`` ticks of
        ``tick_us`` each.
        """
        for number, position in enumerate(self.to_steps(positions).tolist()):
            at_us = self._end_us + round(number * self._hold * tick_us) & TIME_MASK
            self._points.append(
                StreamPoint(tick_at(at_us), tuple(position), begins_segment=number == 0)
            )
        self._latest_position = positions[-1].tolist()
        self._end_us = self._end_us + round(ticks * tick_us) & TIME_MASK
        self._waiting_count += 1
        self._next_number += 1
        self._remaining_count -= 1

    @property
    def next_tick(self) -> int | None:
        """Tick at which the next set-point takes effect."""
        return self._points[0].tick if self._points else None

    def take_due_point(self, tick: int) -> StreamPoint | None:
        """Return the set-point that takes effect at a tick, or None if there is none."""
        point = None
        while self._points and self._points[0].tick <= tick:
            point = self._points.popleft()
            self._waiting_count -= point.begins_segment
        if point is None:
            return None
        if self._latest_point is not None and point.tick > self._latest_point.tick:
            ticks = point.tick - self._latest_point.tick
            positions = zip(point.position, self._latest_point.position, strict=True)
            self.speeds = tuple((new - old) / ticks for new, old in positions)
        self._latest_point = point
        return point

    def preview(self, tick: int, ticks: int, held: tuple[float, ...]) -> FloatArray:
        """Return the commands (n ≤ ticks, axes) after a tick, up to the last queued set-point.

        ``held`` is the current position, which is kept until the next set-point.
        """
        count = max(min(ticks, self._points[-1].tick - tick), 0) if self._points else 0
        commands = np.tile(np.array(held), (count, 1))
        for point in self._points:
            if point.tick - tick > count:
                break
            commands[max(point.tick - tick - 1, 0) :] = point.position[: len(held)]
        return commands

    @property
    def is_starving(self) -> bool:
        """Whether set-points must still be received, but none is queued."""
        return not self._points and self._remaining_count > 0

    def clear(self) -> None:
        """End the stream and drop all queued set-points."""
        self._points.clear()
        self._waiting_count = self._remaining_count = 0
        self._latest_point, self.speeds = None, ()
