"""A motion that a board makes alone, at its own control rate: cubic segments of one axis."""

from binascii import crc_hqx
from collections.abc import Sequence

import numpy as np

from rotemina.drivers.mc68hc11.requests import Segment
from rotemina.sim.arrays import FloatArray

_START = 0xFFFF  # of the check
_US = 1e6


class Profile:
    """Segments, as they are loaded, armed, and played from a tick on."""

    def __init__(self) -> None:
        self.axis = 0
        self._announced = 0
        self._segments: list[Segment] = []
        self.trigger: int | None = None  # what it waits for
        self.since: int | None = None  # the tick at which it began
        self._from = 0.0

    @property
    def running(self) -> bool:
        """Whether it moves its axis."""
        return self.since is not None

    @property
    def complete(self) -> bool:
        """Whether all announced segments are here."""
        return 0 < self._announced == len(self._segments)

    @property
    def check(self) -> int:
        """The check over the payloads of all segments."""
        return crc_hqx(b"".join(one.packed() for one in self._segments), _START)

    @property
    def duration_us(self) -> int:
        """How long it takes."""
        return sum(one.duration_us for one in self._segments)

    def begin(self, axis: int, segments: int) -> None:
        """Announce a new one."""
        self.clear()
        self.axis, self._announced = axis, segments

    def add(self, segment: Segment) -> bool:
        """Take the segment whose turn it is, or one that is here already; tell whether it is."""
        if segment.index < len(self._segments):
            return self._segments[segment.index] == segment
        if segment.index != len(self._segments) or self.complete or not self._announced:
            return False
        self._segments.append(segment)
        return True

    def start(self, tick: int, position: float) -> None:
        """Begin to move from a position, steps, at a tick."""
        self.since, self._from, self.trigger = tick, position, None

    def end(self) -> None:
        """Move no more; it may be armed again."""
        self.since = self.trigger = None

    def clear(self) -> None:
        """Forget it."""
        self.end()
        self._announced = 0
        self._segments.clear()

    def greatest_speed(self) -> float:
        """Return the greatest speed of all segments, steps/s."""
        return max(_fastest(one) for one in self._segments)

    def positions(self, elapsed_us: FloatArray) -> FloatArray:
        """Return where the axis is to be, steps, at times (n,) after the begin, µs."""
        found = np.full(len(elapsed_us), self._from)
        begin_us = 0
        for one in self._segments:
            share = np.clip((elapsed_us - begin_us) / one.duration_us, 0.0, 1.0)
            found += share * (one.c1 + share * (one.c2 + share * one.c3))
            begin_us += one.duration_us
        return found


def _fastest(segment: Segment) -> float:
    shares: Sequence[float] = (0.0, 1.0)
    if segment.c3:
        turning = -segment.c2 / (3.0 * segment.c3)
        shares = (0.0, 1.0, min(max(turning, 0.0), 1.0))
    slopes = [segment.c1 + s * (2.0 * segment.c2 + s * 3.0 * segment.c3) for s in shares]
    return max(map(abs, slopes)) * _US / segment.duration_us
