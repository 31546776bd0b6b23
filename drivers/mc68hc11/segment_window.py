"""Sliding window for the segments of a stream: several may be sent before an acknowledgement."""

from collections.abc import Callable

from rotemina.drivers.contract import Permit
from rotemina.drivers.mc68hc11.dialogue import OutgoingFrame
from rotemina.drivers.mc68hc11.protocol import (
    RESYNC_BYTES,
    FrameRefused,
    RefusalReason,
    SerialFrame,
    StreamSegment,
    Telemetry,
    WireMessage,
    encode_frame,
)

# A second difference has 24 bits, and is at most twice the distance between two set-points.
MAX_SETPOINT_DISTANCE_STEPS = ((1 << 23) - 1) // 2
# Set-points are rounded to whole steps, so their distance may exceed the one at maximum speed by
# this number of steps.
ROUNDING_STEPS = 1.0
# Some adapters forward telemetry only every 16 ms, so several segments may be unacknowledged.
MAX_UNACKNOWLEDGED_SEGMENTS = 8
_INDEX_COUNT = 256
_RETRY_REASONS = (RefusalReason.OUT_OF_ORDER, RefusalReason.QUEUE_FULL)


class SegmentWindow:
    """Sliding window of segments for one board that has begun a stream.

    Parameters
    ----------
    address : int
    count : int
        Number of all segments.
    make_segment : callable
        Return the segment with a given number.
    compute_report_delay_s : callable
        Return the time until telemetry must show that the board has a segment, s.
    permit : Permit
        Permit of the playback, with which every segment passes the gate.
    """

    def __init__(
        self,
        address: int,
        count: int,
        make_segment: Callable[[int], StreamSegment],
        compute_report_delay_s: Callable[[], float],
        permit: Permit,
    ) -> None:
        self._permit = permit
        self._address = address
        self._count = count
        self._make_segment = make_segment
        self._compute_report_delay_s = compute_report_delay_s
        # Number of segments that the board has reported to have.
        self._acknowledged_count = 0
        self._next_segment = 0
        # Number of segments that may be sent so far.
        self._released_count = 0
        # Segments that were sent but not acknowledged, by the number of their frame.
        self._in_flight: dict[int, int] = {}
        # Host time by which telemetry must report the first segment that is not acknowledged.
        self._report_due_s = float("inf")
        # Number of segments that have been sent at least once.
        self._sent_count = 0
        self._resync_needed = False
        self._not_before_s = float("-inf")
        self.repeat_count = 0
        self.refusal: int | None = None

    @property
    def acknowledged_count(self) -> int:
        """Number of segments that the board has reported to have."""
        return self._acknowledged_count

    def release(self, count: int) -> None:
        """Allow the first ``count`` segments to be sent. A later call cannot allow fewer."""
        self._released_count = min(max(count, self._released_count), self._count)

    def has_segment_to_send(self, now_s: float) -> bool:
        """Return whether the next segment should be sent now."""
        if self.refusal is not None or now_s < self._not_before_s:
            return False
        if self._in_flight and now_s >= self._report_due_s:
            self._go_back()
        return (
            self._next_segment < self._released_count
            and self._next_segment - self._acknowledged_count < MAX_UNACKNOWLEDGED_SEGMENTS
        )

    def take_frame(self, now_s: float, number: int, out_s: float) -> OutgoingFrame:
        """Return the frame of the next segment. Its bytes have left the line after ``out_s``."""
        index = self._next_segment
        message = self._make_segment(index)
        if not self._in_flight:
            self._report_due_s = now_s + out_s + self._compute_report_delay_s()
        self._in_flight[number] = index
        self._next_segment += 1
        frame = encode_frame(SerialFrame(self._address, number, StreamSegment.TYPE, message.pack()))
        if index < self._sent_count:
            self.repeat_count += 1
        self._sent_count = max(self._sent_count, self._next_segment)
        if self._resync_needed:
            self._resync_needed = False
            return OutgoingFrame(RESYNC_BYTES + frame, self._permit, starts_motion=False)
        return OutgoingFrame(frame, self._permit, starts_motion=False)

    def receive(self, message: WireMessage, now_s: float) -> None:
        """Handle a message: telemetry acknowledges segments, and a refusal rejects one."""
        if isinstance(message, Telemetry):
            new_count = (message.next_segment_index - self._acknowledged_count) % _INDEX_COUNT
            if 0 < new_count <= self._sent_count - self._acknowledged_count:
                self._acknowledged_count += new_count
                self._next_segment = max(self._next_segment, self._acknowledged_count)
                self._in_flight = {
                    number: index
                    for number, index in self._in_flight.items()
                    if index >= self._acknowledged_count
                }
                self._report_due_s = now_s + self._compute_report_delay_s()
        elif isinstance(message, FrameRefused) and message.number in self._in_flight:
            if message.reason not in _RETRY_REASONS:
                self.refusal = message.reason
                return
            if message.reason == RefusalReason.QUEUE_FULL:
                self._not_before_s = now_s + self._compute_report_delay_s()
            self._go_back()

    def _go_back(self) -> None:
        """Send the first segment that is not acknowledged again, and all later ones."""
        self._in_flight.clear()
        self._next_segment = self._acknowledged_count
        self._resync_needed = True
