"""Reports of a board about its axes: telemetry, captures, and answers to polls."""

from collections import deque
from dataclasses import dataclass, field
from math import inf

from rotemina.drivers.mc68hc11.protocol import CaptureSamples, Telemetry, WireMessage
from rotemina.drivers.virtual_board.sampling import FirmwareCapture, SamplingSchedule

# A board has room for this many frames of captured samples.
_MAX_WAITING_FRAMES = 12
_REPORTS_PER_INPUTS = 4


@dataclass(slots=True)
class BoardReporter:
    """Schedules of telemetry and of a capture, and the reports that wait for a poll.

    If ``waits_for_poll`` is set, captured samples are sent only when the board is polled.
    """

    waits_for_poll: bool
    telemetry: SamplingSchedule | None = None
    capture: FirmwareCapture | None = None
    latest: Telemetry | None = None
    _is_latest_unsent: bool = False
    _waiting_frames: deque[CaptureSamples] = field(default_factory=deque)
    _sample_count: int = 0
    _poll_count: int = 0

    @property
    def next_tick(self) -> float:
        """Next tick at which a reading is needed."""
        telemetry_tick = self.telemetry.next_tick if self.telemetry is not None else inf
        capture_tick = self.capture.due_tick if self.capture is not None else None
        return min(telemetry_tick, inf if capture_tick is None else capture_tick)

    def set_telemetry(self, schedule: SamplingSchedule | None) -> None:
        """Set the schedule of telemetry, or end it."""
        self.telemetry, self.latest, self._is_latest_unsent = schedule, None, False

    def set_capture(self, capture: FirmwareCapture | None) -> None:
        """Begin a capture, or end it."""
        self.capture = capture
        self._waiting_frames.clear()

    def is_sample_due(self, tick: int) -> bool:
        """Return whether telemetry is due at a tick."""
        return self.telemetry is not None and self.telemetry.next_tick <= tick

    def take_sample(self, sample: Telemetry, tick: int) -> bool:
        """Store the sample that was due. Return whether a frame of inputs must follow it."""
        assert self.telemetry is not None, "a sample is due only with telemetry on"
        self.telemetry.advance(tick)
        self.latest, self._is_latest_unsent = sample, True
        self._sample_count += 1
        return self._sample_count % _REPORTS_PER_INPUTS == 0

    def take_captured_frames(self, tick: int) -> list[WireMessage]:
        """Return the frame of captured samples that is due, if any. On a bus, store it for a poll.

        The machine must be simulated up to the tick.
        """
        if self.capture is None or self.capture.due_tick is None or self.capture.due_tick > tick:
            return []
        report = self.capture.take_frame()
        if self.capture.due_tick is None:
            self.capture = None
        if self.waits_for_poll and len(self._waiting_frames) < _MAX_WAITING_FRAMES:
            self._waiting_frames.append(report)
        return [report]

    def answer_poll(self) -> WireMessage | None:
        """Return the answer to a poll, or None if a new sample must be taken for it."""
        if self._waiting_frames and not self._is_latest_unsent:
            return self._waiting_frames.popleft()
        self._is_latest_unsent = False
        return self.latest

    def count_poll(self) -> bool:
        """Count a poll. Return whether it must be answered with inputs."""
        self._poll_count += 1
        return self._poll_count % _REPORTS_PER_INPUTS == 0
