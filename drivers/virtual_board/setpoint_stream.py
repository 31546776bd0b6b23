"""The stream of set-points in a board: queued segments, and their commands over time."""

from collections import deque
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from rotemina.drivers.mc68hc11.host_messages import BeginStream, Differences
from rotemina.drivers.mc68hc11.protocol_codes import QUEUE
from rotemina.drivers.virtual_board.clock import MASK
from rotemina.sim.arrays import FloatArray, IntArray

_INDICES = 256
_SEEN = 128  # indices back that count as had already


class Point(NamedTuple):
    """Where the axes are to be at a tick, whole steps; ``begins`` a segment."""

    tick: int
    position: tuple[int, ...]
    begins: bool


class Stream:
    """Segments on their way: the next index alone is taken, and each begins where one ends.

    Times are the board's own, for a tick of its is what its crystal says.
    """

    def __init__(self) -> None:
        self._points: deque[Point] = deque()
        self._waiting = 0  # segments that have not begun
        self._next = 0
        self._left = 0  # segments that must still come
        self._hold = 1
        self._fraction = 0
        self._place: list[int] = []  # of the last point that was taken, with its fraction
        self._end_us = 0  # of the last segment that was taken: when the next one begins
        self._acted: Point | None = None
        self.speeds: tuple[float, ...] = ()  # steps a tick, between the latest two

    @property
    def playing(self) -> bool:
        """Whether set-points wait, or must still come."""
        return bool(self._points) or self._left > 0

    @property
    def full(self) -> bool:
        """Whether no other segment has room."""
        return self._waiting >= QUEUE

    @property
    def expected(self) -> int:
        """The index that is taken next; 0 while nothing plays."""
        return self._next % _INDICES if self.playing else 0

    @property
    def starts_us(self) -> int:
        """The board's time at which the segment begins that is taken next."""
        return self._end_us

    @property
    def begun(self) -> bool:
        """Whether a segment was taken already."""
        return self._next > 0

    @property
    def hold(self) -> int:
        """Ticks between two changes of the command."""
        return self._hold

    def begin(self, asked: BeginStream, position: Sequence[int]) -> None:
        """Wait for segments that lead away from a position, whole steps."""
        self.clear()
        self._next, self._left = 0, asked.segments
        self._hold, self._fraction = asked.hold, asked.fraction
        half = 1 << asked.fraction >> 1  # whole steps are cut off, not rounded
        self._place = [(one << asked.fraction) + half for one in position]
        self._end_us = asked.time_us

    def expects(self, index: int) -> bool:
        """Return whether it is this one's turn."""
        return self._left > 0 and index == self._next % _INDICES

    def has_had(self, index: int) -> bool:
        """Return whether this one came before."""
        return 1 <= (self._next - index) % _INDICES <= min(self._next, _SEEN)

    def places(self, ticks: int, axes: Differences) -> IntArray:
        """Return the commands (changes, axes) of a segment, with their fractions."""
        count = np.arange(1, ticks // self._hold + 1, dtype=np.int64)[:, None]
        first, second = np.array(axes, dtype=np.int64).T
        return np.asarray(self._place + count * first + count * (count + 1) // 2 * second)

    def steps(self, places: IntArray) -> IntArray:
        """Return the whole steps of commands."""
        return places >> self._fraction

    @property
    def latest(self) -> IntArray:
        """Where the last segment that was taken ends (axes,), whole steps."""
        return np.array(self._place, dtype=np.int64) >> self._fraction

    def take(
        self, places: IntArray, tick_at: Callable[[int], int], tick_us: float, ticks: int
    ) -> None:
        """Queue the segment whose turn it is; ``tick_at`` returns the tick of a board's time."""
        for number, position in enumerate(self.steps(places).tolist()):
            at_us = self._end_us + round(number * self._hold * tick_us) & MASK
            self._points.append(Point(tick_at(at_us), tuple(position), begins=number == 0))
        self._place = places[-1].tolist()
        self._end_us = self._end_us + round(ticks * tick_us) & MASK
        self._waiting += 1
        self._next += 1
        self._left -= 1

    @property
    def next_tick(self) -> int | None:
        """When the next one acts."""
        return self._points[0].tick if self._points else None

    def due(self, tick: int) -> Point | None:
        """Return the set-point that acts from this tick on, None if it is still the one before."""
        point = None
        while self._points and self._points[0].tick <= tick:
            point = self._points.popleft()
            self._waiting -= point.begins
        if point is None:
            return None
        if self._acted is not None and point.tick > self._acted.tick:
            ticks = point.tick - self._acted.tick
            both = zip(point.position, self._acted.position, strict=True)
            self.speeds = tuple((now - before) / ticks for now, before in both)
        self._acted = point
        return point

    def preview(self, tick: int, ticks: int, held: tuple[float, ...]) -> FloatArray:
        """Return the commands (n ≤ ticks, axes) behind a tick, as far as set-points say."""
        count = max(min(ticks, self._points[-1].tick - tick), 0) if self._points else 0
        commands = np.tile(np.array(held), (count, 1))
        for point in self._points:
            if point.tick - tick > count:
                break
            commands[max(point.tick - tick - 1, 0) :] = point.position[: len(held)]
        return commands

    @property
    def starves(self) -> bool:
        """Whether others must come, and none is here."""
        return not self._points and self._left > 0

    def clear(self) -> None:
        """Forget what waits."""
        self._points.clear()
        self._waiting = self._left = 0
        self._acted, self.speeds = None, ()
