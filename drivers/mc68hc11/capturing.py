"""A capture: fast samples of some axes of one board, put together from what arrives."""

from collections.abc import Callable, Sequence

import numpy as np

from rotemina.drivers.capture import Captured
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.board_messages import Captured as Report
from rotemina.drivers.mc68hc11.protocol_codes import State
from rotemina.sim.arrays import FloatArray

_TURN = 1 << 16  # steps: only the low bits are sent
_HALF = _TURN >> 1
_INDICES = 1 << 16
_QUIET = 3  # periods of telemetry without a capture: no more of it comes


class Capturing:
    """One capture.

    Parameters
    ----------
    board : Board
    names : sequence of str
        Of the axes, in the caller's order.
    period_us : int
    count : int
        Of samples.
    telemetry_ms : int
        Between two samples of telemetry meanwhile.
    on_clock : callable
        Turn unwrapped times (n,) of the board into the device time of the samples, s.
    """

    def __init__(
        self,
        board: Board,
        names: Sequence[str],
        period_us: int,
        count: int,
        telemetry_ms: int,
        on_clock: Callable[[FloatArray], FloatArray],
    ) -> None:
        self.board = board
        self._names = tuple(names)
        numbers = {axis.name: axis.number for axis in board.axes}
        self._order = tuple(sorted(names, key=numbers.__getitem__))  # as the board sends them
        self._axes = [board.axes[numbers[name]] for name in self._order]
        self._period_us, self._count = period_us, count
        self.telemetry_ms = telemetry_ms
        self._patience_us = 1000 * _QUIET * telemetry_ms
        self._on_clock = on_clock
        self._asked_us: int | None = None
        self._heard_us = 0  # the latest time at which there was a capture, or was to be one soon
        self._begin_us: int | None = None
        self._reference = [0] * len(names)
        self._received: list[tuple[int, list[int]]] = []
        self._early: list[Report] = []
        self._next = self._had = 0
        self._told = False
        self._last: tuple[float, float] | None = None  # number and time, s, of the latest taken

    @property
    def mask(self) -> int:
        """The axes, bit by bit."""
        return sum(1 << axis.number for axis in self._axes)

    @property
    def over(self) -> bool:
        """Whether no more samples come."""
        return self._next >= self._count

    def granted(self, time_us: int) -> None:
        """Note that the board knows of it since this unwrapped time."""
        self._asked_us = self._heard_us = time_us

    def refused(self) -> None:
        """Note that nothing will come."""
        self._next = self._count

    def sampled(self) -> None:
        """Look at the board's latest telemetry: it tells when the capture began, and ended."""
        board = self.board
        if self._asked_us is None or board.latest_us <= self._asked_us or self.over:
            return
        self._reference = (
            [board.latest.samples()[axis.number][0] for axis in self._axes]
            if (board.latest is not None)
            else self._reference
        )
        if board.state & State.CAPTURING:
            self._heard_us = board.latest_us
            if self._begin_us is None:
                self._begin_us = board.latest_us
                early, self._early = self._early, []
                for report in early:
                    self.receive(report)
        elif board.latest_us - self._heard_us > self._patience_us:
            # By time, not by samples: until the first one is due a board that is polled tells more.
            self._next = self._count  # the last samples were lost

    def receive(self, report: Report) -> None:
        """Take captured samples."""
        self._heard_us = self.board.latest_us
        if self._begin_us is None:
            self._early.append(report)
            return
        wide = len(self._axes)
        values = np.frombuffer(report.samples, dtype=">u2")
        # Samples come in order; the number's low bits say how many were lost before.
        begin = self._next + (report.begin - self._next) % _INDICES
        if begin + len(values) // wide > self._count:
            return  # said twice, or of a capture before
        for offset in range(len(values) // wide):
            row = values[offset * wide : (offset + 1) * wide]
            for at, low in enumerate(row):
                before = self._reference[at]
                self._reference[at] = before + (int(low) - before + _HALF) % _TURN - _HALF
            self._received.append((begin + offset, list(self._reference)))
            self._had += 1
        self._next = begin + len(values) // wide

    def take(self) -> Captured | None:
        """Return what has come since the last call, None if there is nothing to tell."""
        if self._begin_us is None and not self.over:
            return None
        received, self._received = self._received, []
        if not received and (self._told or not self.over):
            return None
        self._told = self.over
        begin_us = float(self._begin_us or 0)
        index = np.array([number for number, _ in received], dtype=np.float64)
        time_s = self._in_order(index, self._on_clock(begin_us + index * self._period_us))
        measured = np.array(
            [
                [axis.value(at) for axis, at in zip(self._axes, row, strict=True)]
                for _, row in received
            ]
        ).reshape(len(received), len(self._axes))
        columns = [self._order.index(name) for name in self._names]
        return Captured(
            self._names, time_s, measured[:, columns], self._next - self._had, self.over
        )

    def _in_order(self, index: FloatArray, time_s: FloatArray) -> FloatArray:
        """Return times (n,), later where a better estimate of the clock would turn them back."""
        if not len(index):
            return time_s
        if self._last is not None:
            number, last_s = self._last
            earliest_s = last_s + 0.5e-6 * self._period_us * (index[0] - number)
            time_s = time_s + max(earliest_s - time_s[0], 0.0)
        self._last = float(index[-1]), float(time_s[-1])
        return time_s
