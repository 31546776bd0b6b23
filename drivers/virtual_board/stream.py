"""The queue of set-points in a board."""

from collections import deque
from typing import NamedTuple

import numpy as np

from rotemina.drivers.mc68hc11.codes import SETPOINTS
from rotemina.sim.arrays import FloatArray

_INDICES = 256
_SEEN = 128  # indices back that count as had already


class Point(NamedTuple):
    """Where the axes are to be at a tick, steps."""

    tick: int
    position: tuple[int, ...]


class Stream:
    """Set-points on their way: the next index alone is taken, and each acts when its tick comes."""

    def __init__(self) -> None:
        self._queue: deque[Point] = deque()
        self._next = 0
        self._complete = True  # the one with nothing left is here
        self._acted: Point | None = None
        self.speeds: tuple[float, ...] = ()  # steps a tick, between the latest two

    @property
    def playing(self) -> bool:
        """Whether set-points wait, or must still come."""
        return bool(self._queue) or not self._complete

    @property
    def full(self) -> bool:
        """Whether no other one has room."""
        return len(self._queue) >= SETPOINTS

    @property
    def next_tick(self) -> int | None:
        """When the next one acts."""
        return self._queue[0].tick if self._queue else None

    @property
    def last_tick(self) -> int | None:
        """When the last one that waits acts."""
        return self._queue[-1].tick if self._queue else None

    def expects(self, index: int) -> bool:
        """Return whether it is this one's turn."""
        if self.playing:
            return index == self._next and not self._complete
        return index == 0

    def has_had(self, index: int) -> bool:
        """Return whether this one came before."""
        return 1 <= (self._next - index) % _INDICES <= _SEEN

    def take(self, index: int, left: int, point: Point) -> None:
        """Queue the one whose turn it is."""
        if not self.playing:
            self._acted, self.speeds = None, ()
        self._queue.append(point)
        self._next = (index + 1) % _INDICES
        self._complete = left == 0

    def due(self, tick: int) -> Point | None:
        """Return the set-point that acts from this tick on, None if it is still the one before."""
        point = None
        while self._queue and self._queue[0].tick <= tick:
            point = self._queue.popleft()
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
        last = self.last_tick
        count = 0 if last is None else max(min(ticks, last - tick), 0)
        commands = np.tile(np.array(held), (count, 1))
        for point in self._queue:
            commands[max(point.tick - tick - 1, 0) :] = point.position[: len(held)]
        return commands

    @property
    def ran_empty(self) -> bool:
        """Whether others must come, and none is here."""
        return not self._queue and not self._complete

    def clear(self) -> None:
        """Forget what waits."""
        self._queue.clear()
        self._complete = True
        self._acted, self.speeds = None, ()
