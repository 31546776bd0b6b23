"""A motion executed by a board at its own rate: summed differences of one axis."""

from binascii import crc_hqx

import numpy as np

from rotemina.drivers.mc68hc11.host_messages import Quadratic, Segments
from rotemina.drivers.mc68hc11.profile_upload import FRACTION, ticks_of
from rotemina.sim.arrays import FloatArray, IntArray

_START = 0xFFFF  # of the check


class Profile:
    """Segments, as they are loaded, armed, and played from a tick on."""

    def __init__(self) -> None:
        self.axis = 0
        self._announced = 0
        self._segments: list[Quadratic] = []
        self._told: list[bytes] = []  # payloads, for the check
        self.trigger: int | None = None  # what it waits for
        self.since: int | None = None  # the tick at which it began
        self._from = 0.0
        self._path: IntArray | None = None  # behind each tick, kept once it was asked for

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
        return crc_hqx(b"".join(self._told), _START)

    @property
    def ticks(self) -> int:
        """How long it takes."""
        return sum(one.ticks for one in self._segments)

    def begin(self, axis: int, segments: int) -> None:
        """Announce a new one."""
        self.clear()
        self.axis, self._announced = axis, segments

    def add(self, told: Segments) -> bool:
        """Take segments whose turn it is, or that are here already; return whether they are."""
        segments, own = list(told.segments()), self._segments
        if told.index < len(own):
            return own[told.index : told.index + len(segments)] == segments
        if told.index != len(own) or len(own) + len(segments) > self._announced:
            return False
        own += segments
        self._told.append(told.packed())
        return True

    def start(self, tick: int, position: float) -> None:
        """Begin to move from a position, steps, at a tick."""
        self.since, self._from, self.trigger = tick, position, None

    def end(self) -> None:
        """End the motion; it may be armed again."""
        self.since = self.trigger = None

    def clear(self) -> None:
        """Forget it."""
        self.end()
        self._announced, self._path = 0, None
        self._segments.clear()
        self._told.clear()

    def greatest_speed(self) -> float:
        """Return the greatest speed of all segments, steps a tick."""
        return float(np.abs(np.diff(ticks_of(self._segments), prepend=0)).max()) / FRACTION

    def positions(self, elapsed: IntArray) -> FloatArray:
        """Return where the axis is to be, steps, so many ticks (n,) after the begin."""
        if self._path is None:
            self._path = np.append(0, ticks_of(self._segments))
        way = self._path[np.clip(elapsed, 0, len(self._path) - 1)]
        return np.asarray(self._from + np.floor(way / FRACTION + 0.5))
