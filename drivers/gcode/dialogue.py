"""The dialogue with a controller: one line at a time, single bytes past all lines.

A status that answers more than 10 ms later than the quickest one is discarded.
"""

from collections.abc import Iterator

from rotemina.drivers.clock import Clock
from rotemina.drivers.gcode.grbl_reports import Answer, Message, Status, parse_report
from rotemina.drivers.line_quality import LinkQuality
from rotemina.drivers.mc68hc11.port import Port

QUERY, HOLD, RESET, JOG_CANCEL = b"?", b"!", b"\x18", b"\x85"
_ASK_AGAIN_S = 0.1
_LONGEST_LINE = 256  # bytes: longer than any that a controller says
_SMOOTHING = 0.1
#: An answer that takes so much longer than the quickest ones may be of any moment in between, s.
UNCERTAIN_S = 0.01
_SLOWER = 1.01  # what the quickest answer is taken to have slowed down by, from answer to answer


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
        self._port = port
        self._clock = clock
        self._byte_s = 10.0 / baud
        self._rest = b""
        self._sent = self._received = self._rejected = self._repeated = 0
        self._round_trip_s: float | None = None
        self._least_s = float("inf")  # the quickest answer of late
        #: The line that waits for its answer, and since when, s.
        self.awaited: str | None = None
        self.awaited_since_s = 0.0
        #: When the status that waits for its report was asked for, s; None while none does.
        self.asked_s: float | None = None
        self.heard_s = clock()
        # Every act makes reports of before it stale: what was asked for earlier may tell of before.
        self._acts = 0
        self._asked_acts = 0

    def say(self, line: str) -> None:
        """Send a line; the one before has been answered."""
        assert self.awaited is None, "one line at a time"
        self._port.write(line.encode("ascii") + b"\n")
        self.awaited, self.awaited_since_s = line, self._clock()
        self._sent += 1
        self._acts += 1

    def send_realtime(self, byte: bytes) -> None:
        """Send a byte that the controller obeys at once, past every line; any thread."""
        self._port.write(byte)

    def invalidate_reports(self) -> None:
        """Invalidate all reports requested before now."""
        self._acts += 1

    def forget(self) -> None:
        """Stop waiting for answers: the controller has been reset."""
        self.awaited = self.asked_s = None
        self.invalidate_reports()

    def ask(self, period_s: float, last_s: float) -> None:
        """Ask for a status where it is time, the latest one having been asked for at `last_s`."""
        now_s = self._clock()
        if self.asked_s is None:
            if now_s - last_s < period_s * (1.0 - 1e-6):
                return
        elif now_s - self.asked_s < max(_ASK_AGAIN_S, 2.0 * period_s):
            return
        else:
            self._repeated += 1
        self.send_realtime(QUERY)
        self._sent += 1
        self.asked_s, self._asked_acts = now_s, self._acts

    def received(self) -> Iterator[tuple[Message, float | None, bool]]:
        """Yield what has come, for a status also when it was requested, and whether it is fresh.

        A fresh one was requested after everything that was said. Where the answer took too long to
        tell of which moment it is, the time is None.
        """
        *lines, self._rest = (self._rest + self._port.read()).split(b"\n")
        if len(self._rest) > _LONGEST_LINE:
            self._rest = b""
            self._rejected += 1
        for line in lines:
            text = line.strip().decode("ascii", "replace")
            if not text:
                continue
            message = parse_report(text)
            if message is None:
                self._rejected += 1
                continue
            self._received += 1
            self.heard_s = self._clock()
            asked_s: float | None = None
            fresh = False
            if isinstance(message, Status):
                if self.asked_s is None:
                    continue  # that of a question which was repeated
                asked_s, self.asked_s = self.asked_s, None
                fresh = self._asked_acts == self._acts
                took_s = self.heard_s - asked_s
                self._least_s = min(self._least_s * _SLOWER, took_s)
                self._measure(took_s)
                if took_s > self._least_s + UNCERTAIN_S * (1.0 + 1e-6):
                    asked_s = None
            elif isinstance(message, Answer):
                self.invalidate_reports()
            yield message, asked_s, fresh

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

    def _measure(self, took_s: float) -> None:
        known = self._round_trip_s
        self._round_trip_s = took_s if known is None else known + _SMOOTHING * (took_s - known)
