"""Dialogue with a controller: sends one line at a time, and realtime bytes that overtake lines.

At most one status query is outstanding. GRBL does not number its reports. So before a new query
replaces an unanswered one, the dialogue waits until a late answer would have arrived.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from rotemina.drivers.contract import Clock, LinkQuality
from rotemina.drivers.gcode.grbl_reports import (
    ControllerMessage,
    LineAnswer,
    StatusReport,
    WelcomeMessage,
    parse_report,
)
from rotemina.drivers.gcode.jog_guard import JogGuard
from rotemina.drivers.serial_lines import BytePort, UrgentBytes

QUERY, RESET, JOG_CANCEL = b"?", UrgentBytes(b"\x18"), UrgentBytes(b"\x85")
#: Brakes the axes during any motion. A feed hold alone is not enough, because grblHAL ignores it
#: during a jog. The jog cancel also removes a jog that is still in the input buffer and would begin
#: after the hold.
HALT = UrgentBytes(JOG_CANCEL + b"!")
# No controller sends a longer line.
_MAX_LINE_BYTES = 256
# The first bytes in each direction are kept to explain why a controller does not answer.
_MAX_FIRST_BYTES = 2048
_ROUND_TRIP_SMOOTHING = 0.1
#: A status is assumed to be taken in the middle of its round trip. This is the maximum error of its
#: time on a fast line, s.
MIN_STAMP_ERROR_S = 0.01
# The time of a status is unknown if its answer takes longer than this many mean round trips.
_MAX_DATED_ROUND_TRIPS = 1.5
# A query is abandoned after the sum of this time and these round trips.
_QUERY_TIMEOUT_S, _QUERY_TIMEOUT_ROUND_TRIPS = 0.2, 3.0
# Timeout until a round trip is known. On an accepted line every answer is faster.
_FIRST_QUERY_TIMEOUT_S = 2.0
# After an abandoned query, a late answer arrives within this time plus a round trip, or never.
_DRAIN_S = 0.1


@dataclass(frozen=True, slots=True)
class ReceivedMessage:
    """A received message with its times.

    Attributes
    ----------
    message : ControllerMessage
    requested_s, received_s : float
        Host times between which the controller took the status. For other messages both are the
        time of arrival.
    time_s : float or None
        Most likely time of the status; None if the answer took too long.
    is_fresh : bool
        Whether the status was requested after every earlier line and stop.
    """

    message: ControllerMessage
    requested_s: float
    received_s: float
    time_s: float | None = None
    is_fresh: bool = False


class GrblDialogue:
    """Dialogue with one controller on a port. Any thread may call `send_realtime`.

    Parameters
    ----------
    port : Port
    clock : callable
        Returns the host time, s.
    baud : int
    """

    def __init__(self, port: BytePort, clock: Clock, baud: int) -> None:
        #: Checks every line before it is sent.
        self.guard = JogGuard()
        self._port = port
        self._clock = clock
        self._byte_s = 10.0 / baud
        self._partial_line = b""
        self._first_sent = self._first_received = b""
        self._sent = self._received = self._rejected = self._repeated = 0
        self._round_trip_s: float | None = None
        #: The line that has not been answered yet, and the host time at which it was sent, s.
        self.pending_line: str | None = None
        self.pending_since_s = 0.0
        #: Host time of the unanswered status query, s; None if there is none.
        self.query_sent_s: float | None = None
        self.last_received_s = clock()
        #: Whether answers may take any time, as during homing. Then round trips are not measured.
        self.may_be_silent = False
        # No query is sent before this time, because a late answer may still arrive.
        self._earliest_query_s = float("-inf")
        # After each action, reports that were requested earlier are stale.
        self._action_count = 0
        self._query_action_count = 0

    @property
    def round_trip_s(self) -> float:
        """Smoothed time from a query to its answer, s; 0 before the first answer."""
        return self._round_trip_s or 0.0

    @property
    def stamp_error_s(self) -> float:
        """Maximum error of the time of a status, s."""
        return max(MIN_STAMP_ERROR_S, 0.5 * _MAX_DATED_ROUND_TRIPS * self.round_trip_s)

    @property
    def first_bytes(self) -> tuple[bytes, bytes]:
        """The first bytes that were received, and the first that were sent."""
        return self._first_received, self._first_sent

    def send_line(self, line: str) -> None:
        """Send a line. The previous line must have been answered.

        Raises
        ------
        LimitError
            If the line could move an axis out of its range.
        """
        assert self.pending_line is None, "the previous line has not been answered"
        self.guard.check(line)
        self._write(line.encode("ascii") + b"\n")
        self.pending_line, self.pending_since_s = line, self._clock()
        self._sent += 1
        self._action_count += 1

    def send_realtime(self, data: bytes) -> None:
        """Send bytes that the controller executes before all lines. Any thread may call it."""
        self._write(data)

    def invalidate_reports(self) -> None:
        """Invalidate all reports requested before now."""
        self._action_count += 1

    def stop_waiting(self) -> None:
        """Stop waiting for answers: the controller has been reset."""
        self.pending_line = None
        self.abandon_query()
        self.invalidate_reports()

    def abandon_query(self) -> None:
        """Ignore the answer to the pending query if it still arrives."""
        if self.query_sent_s is not None:
            self.query_sent_s = None
            self._earliest_query_s = self._clock() + _DRAIN_S + self.round_trip_s

    def resume_after_pause(self) -> None:
        """Restart all waiting times, which were wrong while this program was suspended."""
        self.last_received_s = self.pending_since_s = self._clock()
        self.abandon_query()
        self.invalidate_reports()

    def count_discarded(self) -> None:
        """Count a report that could not be used."""
        self._rejected += 1

    def request_status(self, period_s: float, last_s: float) -> None:
        """Send a status query if a period has passed since the previous query, at `last_s`."""
        now_s = self._clock()
        self._abandon_late_query(now_s)
        if self.query_sent_s is not None or now_s < self._earliest_query_s:
            return
        if now_s - last_s < period_s * (1.0 - 1e-6):
            return
        self.send_realtime(QUERY)
        self._sent += 1
        self.query_sent_s, self._query_action_count = now_s, self._action_count

    def receive(self) -> Iterator[ReceivedMessage]:
        """Yield the messages that have arrived, except answers to abandoned queries."""
        self._abandon_late_query(self._clock())
        data = self._port.read()
        if len(self._first_received) < _MAX_FIRST_BYTES:
            self._first_received += data
        *lines, self._partial_line = (self._partial_line + data).split(b"\n")
        if len(self._partial_line) > _MAX_LINE_BYTES:
            self._partial_line = b""
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
            self.last_received_s = self._clock()
            reception = self._match_reply(report)
            if reception is not None:
                yield reception

    def read_quality(self) -> LinkQuality:
        """Return the quality of the line. Any thread may call it."""
        return LinkQuality(
            sent=self._sent,
            received=self._received,
            rejected=self._rejected,
            repeated=self._repeated,
            round_trip_s=self._round_trip_s,
            stop_s=(self._port.waiting() + 1) * self._byte_s,
        )

    def _match_reply(self, report: ControllerMessage) -> ReceivedMessage | None:
        """Return a report with its times; None if it answers an abandoned query."""
        now_s = self.last_received_s
        if isinstance(report, LineAnswer):
            self.invalidate_reports()
        elif isinstance(report, WelcomeMessage):
            # After the greeting no answer to an earlier query can arrive.
            self._earliest_query_s = now_s
        elif isinstance(report, StatusReport):
            if self.query_sent_s is None:
                self._earliest_query_s = now_s
                return None
            queried_s, self.query_sent_s = self.query_sent_s, None
            elapsed_s = now_s - queried_s
            if not self.may_be_silent:
                self._update_round_trip(elapsed_s)
            error_s = 0.5 * elapsed_s
            time_s = queried_s + error_s if error_s <= self.stamp_error_s else None
            return ReceivedMessage(
                report, queried_s, now_s, time_s, self._query_action_count == self._action_count
            )
        return ReceivedMessage(report, now_s, now_s)

    def _write(self, data: bytes) -> None:
        if len(self._first_sent) < _MAX_FIRST_BYTES:
            self._first_sent += data
        self._port.write(data)

    def _abandon_late_query(self, now_s: float) -> None:
        timeout_s = _FIRST_QUERY_TIMEOUT_S
        if self._round_trip_s is not None:
            timeout_s = _QUERY_TIMEOUT_S + _QUERY_TIMEOUT_ROUND_TRIPS * self._round_trip_s
        if self.query_sent_s is not None and now_s - self.query_sent_s > timeout_s:
            self._repeated += 1
            self.abandon_query()

    def _update_round_trip(self, elapsed_s: float) -> None:
        average_s = self._round_trip_s
        self._round_trip_s = (
            elapsed_s
            if average_s is None
            else average_s + _ROUND_TRIP_SMOOTHING * (elapsed_s - average_s)
        )
