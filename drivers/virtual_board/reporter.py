"""Reports of a board about its axes: due samples, and data to be polled."""

from collections import deque
from dataclasses import dataclass, field
from math import inf

from rotemina.drivers.mc68hc11.board_messages import Captured, Telemetry
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.drivers.virtual_board.sampling import Capture, Schedule

_WAITING = 12  # frames of captured samples that a board has room for
_INPUTS_EVERY = 4


@dataclass(slots=True)
class Reporter:
    """The schedules of telemetry and of a capture, and what they have brought.

    ``waits``: captured samples are said when they are polled for.
    """

    waits: bool
    telemetry: Schedule | None = None
    capture: Capture | None = None
    latest: Telemetry | None = None
    _news: bool = False
    _waiting: deque[Captured] = field(default_factory=deque)
    _samples: int = 0
    _polls: int = 0

    @property
    def next_tick(self) -> float:
        """The next tick of which a reading is needed."""
        telemetry = self.telemetry.tick if self.telemetry is not None else inf
        due = self.capture.due if self.capture is not None else None
        return min(telemetry, inf if due is None else due)

    def set_telemetry(self, schedule: Schedule | None) -> None:
        """Take samples on another schedule, or none."""
        self.telemetry, self.latest, self._news = schedule, None, False

    def set_capture(self, capture: Capture | None) -> None:
        """Begin a capture, or end it."""
        self.capture = capture
        self._waiting.clear()

    def wants_sample(self, tick: int) -> bool:
        """Return whether telemetry is due."""
        return self.telemetry is not None and self.telemetry.tick <= tick

    def take_sample(self, sample: Telemetry, tick: int) -> bool:
        """Keep the sample that was due; return whether inputs follow it."""
        assert self.telemetry is not None, "it was due"
        self.telemetry.go_on(tick)
        self.latest, self._news = sample, True
        self._samples += 1
        return self._samples % _INPUTS_EVERY == 0

    def take_captured(self, tick: int) -> list[Message]:
        """Return the captured samples that make a frame now; on a bus they wait to be polled.

        The machine is simulated up to the tick.
        """
        if self.capture is None or self.capture.due is None or self.capture.due > tick:
            return []
        report = self.capture.taken()
        if self.capture.due is None:
            self.capture = None
        if self.waits and len(self._waiting) < _WAITING:
            self._waiting.append(report)
        return [report]

    def polled(self) -> Message | None:
        """Return what a poll is answered by; None for a sample that is taken for it."""
        if self._waiting and not self._news:
            return self._waiting.popleft()
        self._news = False
        return self.latest

    def tells_inputs(self) -> bool:
        """Count a poll; return whether it is answered by inputs."""
        self._polls += 1
        return self._polls % _INPUTS_EVERY == 0
