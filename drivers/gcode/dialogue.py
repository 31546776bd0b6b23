"""The dialogue with a controller: one line at a time, single bytes past all lines.

At most one status query is outstanding. GRBL numbers nothing, so a query that stays without an
answer is abandoned, and the next one waits until a late answer would have arrived.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from rotemina.drivers.clock import Clock
from rotemina.drivers.gcode.grbl_reports import Answer, Message, Status, Welcome, parse_report
from rotemina.drivers.gcode.jog_guard import JogGuard
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.serial_port import Port, UrgentBytes

QUERY, RESET, JOG_CANCEL = b"?", UrgentBytes(b"\x18"), UrgentBytes(b"\x85")
#: Brakes the axes, whatever moves them. In a jog grblHAL ignores a feed hold; the jog cancel also
#: removes a jog that still waits in its input, which would begin after the hold.
HALT = UrgentBytes(JOG_CANCEL + b"!")
_MAX_LINE_BYTES = 256  # longer than any line of a controller
_KEPT_BYTES = 2048  # of what was sent and received, to explain a contact that fails
_SMOOTHING = 0.1
#: A status is dated in the middle of its round trip: on a fast line this is the error, s.
MIN_STAMP_ERROR_S = 0.01
# Of a round trip: an answer that takes longer than this leaves its moment open.
_USUAL_ROUND_TRIPS = 1.5
# A query is abandoned after this, and as many round trips.
_PATIENCE_S, _PATIENCE_ROUND_TRIPS = 0.2, 3.0
# Until a round trip is known: longer than any line that is accepted takes.
_FIRST_PATIENCE_S = 2.0
_DRAIN_S = 0.1  # and a round trip: a late answer arrives in this time, or not at all


@dataclass(frozen=True, slots=True)
class Reception:
    """A message as it arrived.

    Attributes
    ----------
    message : Message
    asked_s, received_s : float
        Host times between which the controller took a status; both of arrival for the rest.
    time_s : float or None
        The most likely moment of a status; None where the answer took too long to tell.
    fresh : bool
        Whether a status was requested after everything that was sent to the controller.
    """

    message: Message
    asked_s: float
    received_s: float
    time_s: float | None = None
    fresh: bool = False


class Dialogue:
    """One controller at the end of a port; used by one thread, `send_realtime` by any.

    Parameters
    ----------
    port : Port
    clock : callable
        The host's time, s.
    baud : int
    """

    def __init__(self, port: Port, clock: Clock, baud: int) -> None:
        #: What every line passes.
        self.guard = JogGuard()
        self._port = port
        self._clock = clock
        self._byte_s = 10.0 / baud
        self._rest = b""
        self._first_sent = self._first_received = b""
        self._sent = self._received = self._rejected = self._repeated = 0
        self._round_trip_s: float | None = None
        #: The line that waits for its answer, and since when, s.
        self.awaited: str | None = None
        self.awaited_since_s = 0.0
        #: When the status that waits for its report was asked for, s; None while none does.
        self.asked_s: float | None = None
        self.heard_s = clock()
        #: Whether an answer may take any time, as while it homes: that says nothing of the line.
        self.may_be_silent = False
        self._drained_s = float("-inf")
        # Every act makes reports of before it stale: what was asked for earlier may tell of before.
        self._acts = 0
        self._asked_acts = 0

    @property
    def round_trip_s(self) -> float:
        """From a query to its answer, smoothed, s; 0 before the first."""
        return self._round_trip_s or 0.0

    @property
    def stamp_error_s(self) -> float:
        """By how much the time of a status may be wrong, s: it was taken within the round trip."""
        return max(MIN_STAMP_ERROR_S, 0.5 * _USUAL_ROUND_TRIPS * self.round_trip_s)

    @property
    def first_bytes(self) -> tuple[bytes, bytes]:
        """What was received and sent first, to explain a contact that fails."""
        return self._first_received, self._first_sent

    def say(self, line: str) -> None:
        """Send a line; the one before has been answered.

        Raises
        ------
        LimitError
            If it could move an axis out of its range.
        """
        assert self.awaited is None, "one line at a time"
        self.guard.check(line)
        self._write(line.encode("ascii") + b"\n")
        self.awaited, self.awaited_since_s = line, self._clock()
        self._sent += 1
        self._acts += 1

    def send_realtime(self, data: bytes) -> None:
        """Send bytes that the controller obeys at once, past every line; any thread."""
        self._write(data)

    def invalidate_reports(self) -> None:
        """Invalidate all reports requested before now."""
        self._acts += 1

    def forget(self) -> None:
        """Stop waiting for answers: the controller has been reset."""
        self.awaited = None
        self.abandon_query()
        self.invalidate_reports()

    def abandon_query(self) -> None:
        """Discard the answer to the latest query, should it still come."""
        if self.asked_s is not None:
            self.asked_s = None
            self._drained_s = self._clock() + _DRAIN_S + self.round_trip_s

    def resume_after_pause(self) -> None:
        """Begin to wait anew: this program did not run, so no answer can have been late."""
        self.heard_s = self.awaited_since_s = self._clock()
        self.abandon_query()
        self.invalidate_reports()

    def count_discarded(self) -> None:
        """Count a report that could not be used."""
        self._rejected += 1

    def ask(self, period_s: float, last_s: float) -> None:
        """Ask for a status where it is time, the latest one having been asked for at `last_s`."""
        now_s = self._clock()
        self._abandon_late_query(now_s)
        if self.asked_s is not None or now_s < self._drained_s:
            return
        if now_s - last_s < period_s * (1.0 - 1e-6):
            return
        self.send_realtime(QUERY)
        self._sent += 1
        self.asked_s, self._asked_acts = now_s, self._acts

    def received(self) -> Iterator[Reception]:
        """Yield what has come; answers to abandoned queries are discarded."""
        self._abandon_late_query(self._clock())
        data = self._port.read()
        if len(self._first_received) < _KEPT_BYTES:
            self._first_received += data
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > _MAX_LINE_BYTES:
            self._rest = b""
            self._rejected += 1
        for line in lines:
            text = line.strip().decode("ascii", "replace")
            if not text:
                continue
            report = parse_report(text)
            if report is None:
                self._rejected += 1
                continue
            self._received += 1
            self.heard_s = self._clock()
            reception = self._assign(report)
            if reception is not None:
                yield reception

    def quality(self) -> LinkQuality:
        """Return the quality of the line; any thread."""
        return LinkQuality(
            sent=self._sent,
            received=self._received,
            rejected=self._rejected,
            repeated=self._repeated,
            round_trip_s=self._round_trip_s,
            stop_s=(self._port.waiting() + 1) * self._byte_s,
        )

    def _assign(self, report: Message) -> Reception | None:
        """Return a report with its times; None for a status that nobody waits for any more."""
        now_s = self.heard_s
        if isinstance(report, Answer):
            self.invalidate_reports()
        elif isinstance(report, Welcome):
            # Whatever was asked before the reset has been answered before its greeting.
            self._drained_s = now_s
        elif isinstance(report, Status):
            if self.asked_s is None:
                self._drained_s = now_s
                return None
            asked_s, self.asked_s = self.asked_s, None
            took_s = now_s - asked_s
            if not self.may_be_silent:
                self._measure(took_s)
            error_s = 0.5 * took_s
            time_s = asked_s + error_s if error_s <= self.stamp_error_s else None
            return Reception(report, asked_s, now_s, time_s, self._asked_acts == self._acts)
        return Reception(report, now_s, now_s)

    def _write(self, data: bytes) -> None:
        if len(self._first_sent) < _KEPT_BYTES:
            self._first_sent += data
        self._port.write(data)

    def _abandon_late_query(self, now_s: float) -> None:
        patience_s = _FIRST_PATIENCE_S
        if self._round_trip_s is not None:
            patience_s = _PATIENCE_S + _PATIENCE_ROUND_TRIPS * self._round_trip_s
        if self.asked_s is not None and now_s - self.asked_s > patience_s:
            self._repeated += 1
            self.abandon_query()

    def _measure(self, took_s: float) -> None:
        known = self._round_trip_s
        self._round_trip_s = took_s if known is None else known + _SMOOTHING * (took_s - known)
