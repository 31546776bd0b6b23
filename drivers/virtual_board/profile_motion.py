"""Profile of one axis, which a board executes by itself by adding up differences."""

from binascii import crc_hqx

import numpy as np

from rotemina.drivers.mc68hc11 import UNITS_PER_STEP, evaluate_segments
from rotemina.drivers.mc68hc11.protocol import LoadSegments, QuadraticSegment
from rotemina.sim.arrays import FloatArray, IntArray

_CRC_INITIAL = 0xFFFF


class OnBoardProfile:
    """Profile in a board. It is first loaded, then armed, and finally executed."""

    def __init__(self) -> None:
        self.axis = 0
        self._announced_count = 0
        self._segments: list[QuadraticSegment] = []
        # Payloads of the segments, for the checksum.
        self._payloads: list[bytes] = []
        # The trigger that an armed profile waits for.
        self.trigger: int | None = None
        # Tick at which the running profile began.
        self.start_tick: int | None = None
        self._start_position = 0.0
        # Position after each tick, in steps · 2^-16 from the start, computed at its first use.
        self._path: IntArray | None = None

    @property
    def running(self) -> bool:
        """Whether the profile is running."""
        return self.start_tick is not None

    @property
    def complete(self) -> bool:
        """Whether all announced segments have been loaded."""
        return 0 < self._announced_count == len(self._segments)

    @property
    def checksum(self) -> int:
        """CRC over the payloads of all segments."""
        return crc_hqx(b"".join(self._payloads), _CRC_INITIAL)

    @property
    def duration_ticks(self) -> int:
        """Duration in ticks."""
        return sum(segment.ticks for segment in self._segments)

    def begin(self, axis: int, segments: int) -> None:
        """Prepare for a new profile of an axis with a number of segments."""
        self.clear()
        self.axis, self._announced_count = axis, segments

    def add_segments(self, message: LoadSegments) -> bool:
        """Add the next segments. Return whether they are the next ones, or repeat earlier ones."""
        segments, loaded_segments = list(message.unpack_segments()), self._segments
        if message.index < len(loaded_segments):
            return loaded_segments[message.index : message.index + len(segments)] == segments
        if (
            message.index != len(loaded_segments)
            or len(loaded_segments) + len(segments) > self._announced_count
        ):
            return False
        loaded_segments += segments
        self._payloads.append(message.pack())
        return True

    def start(self, tick: int, position: float) -> None:
        """Start the motion from a position, steps, at a tick."""
        self.start_tick, self._start_position, self.trigger = tick, position, None

    def end(self) -> None:
        """End the motion. The profile may be armed again."""
        self.start_tick = self.trigger = None

    def clear(self) -> None:
        """Delete the profile."""
        self.end()
        self._announced_count, self._path = 0, None
        self._segments.clear()
        self._payloads.clear()

    def compute_max_speed(self) -> float:
        """Return the maximum speed of all segments, steps per tick."""
        return (
            float(np.abs(np.diff(evaluate_segments(self._segments), prepend=0)).max())
            / UNITS_PER_STEP
        )

    def evaluate_positions(self, elapsed: IntArray) -> FloatArray:
        """Return the commanded positions (n,), steps, given the ticks (n,) since the start."""
        if self._path is None:
            self._path = np.append(0, evaluate_segments(self._segments))
        displacement = self._path[np.clip(elapsed, 0, len(self._path) - 1)]
        return np.asarray(self._start_position + np.floor(displacement / UNITS_PER_STEP + 0.5))
