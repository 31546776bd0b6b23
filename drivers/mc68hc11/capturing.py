"""Capture by one board: joins the samples of some axes, which arrive in many frames."""

from collections.abc import Callable, Sequence

import numpy as np

from rotemina.drivers.abilities import CapturedSamples
from rotemina.drivers.mc68hc11.board import Board
from rotemina.drivers.mc68hc11.protocol import BoardState, CaptureSamples as CaptureSamples
from rotemina.sim.arrays import FloatArray

# Only the low 16 bits of a position are sent.
_WRAP_STEPS = 1 << 16
_HALF_WRAP_STEPS = _WRAP_STEPS >> 1
_SAMPLE_NUMBER_WRAP = 1 << 16
# If telemetry has shown no capture for this many periods, no more samples are expected.
_MAX_QUIET_PERIODS = 3


class BoardCapture:
    """Capture of some axes of one board.

    Parameters
    ----------
    board : Board
    names : sequence of str
        Names of the axes, in the caller's order.
    period_us : int
        Time between two samples.
    count : int
        Number of samples.
    telemetry_period_ms : int
        Period of telemetry during the capture.
    to_device_time_s : callable
        Convert unwrapped times (n,) of the board to device time, s.
    """

    def __init__(
        self,
        board: Board,
        names: Sequence[str],
        period_us: int,
        count: int,
        telemetry_period_ms: int,
        to_device_time_s: Callable[[FloatArray], FloatArray],
    ) -> None:
        self.board = board
        self._names = tuple(names)
        numbers = {axis.name: axis.number for axis in board.axes}
        # The board sends the axes in the order of their numbers.
        self._sent_order = tuple(sorted(names, key=numbers.__getitem__))
        self._axes = [board.axes[numbers[name]] for name in self._sent_order]
        self._period_us, self._count = period_us, count
        self.telemetry_period_ms = telemetry_period_ms
        self._quiet_timeout_us = 1000 * _MAX_QUIET_PERIODS * telemetry_period_ms
        self._to_device_time_s = to_device_time_s
        self._accepted_us: int | None = None
        # Latest board time at which the capture was running, or was expected to begin.
        self._last_activity_us = 0
        self._begin_us: int | None = None
        # Full position of each captured axis, steps, from which the low 16 bits are unwrapped.
        self._latest_steps = [0] * len(names)
        self._unread_rows: list[tuple[int, list[int]]] = []
        self._early_reports: list[CaptureSamples] = []
        self._next_number = self._received_count = 0
        self._is_end_reported = False
        # Number and time, s, of the latest sample that was returned.
        self._latest_sample: tuple[float, float] | None = None

    @property
    def axis_mask(self) -> int:
        """Bit mask of the captured axes. Bit 0 is the first axis of the board."""
        return sum(1 << axis.number for axis in self._axes)

    @property
    def is_over(self) -> bool:
        """Whether no more samples are expected."""
        return self._next_number >= self._count

    def note_acceptance(self, time_us: int) -> None:
        """Record that the board has accepted the capture at an unwrapped time."""
        self._accepted_us = self._last_activity_us = time_us

    def note_refusal(self) -> None:
        """Record that the board has refused the capture, so that no samples will arrive."""
        self._next_number = self._count

    def check_telemetry(self) -> None:
        """Check in the board's latest telemetry whether the capture has begun or ended."""
        board = self.board
        if self._accepted_us is None or board.latest_us <= self._accepted_us or self.is_over:
            return
        self._latest_steps = (
            [board.latest.unpack_samples()[axis.number][0] for axis in self._axes]
            if board.latest is not None
            else self._latest_steps
        )
        if board.state & BoardState.CAPTURING:
            self._last_activity_us = board.latest_us
            if self._begin_us is None:
                self._begin_us = board.latest_us
                early_reports, self._early_reports = self._early_reports, []
                for report in early_reports:
                    self.receive(report)
        elif board.latest_us - self._last_activity_us > self._quiet_timeout_us:
            # The last samples were lost. Only the time can show this, because a board on a bus may
            # answer polls with telemetry before the first sample is due.
            self._next_number = self._count

    def receive(self, report: CaptureSamples) -> None:
        """Handle a message with captured samples."""
        self._last_activity_us = self.board.latest_us
        if self._begin_us is None:
            self._early_reports.append(report)
            return
        axis_count = len(self._axes)
        values = np.frombuffer(report.samples, dtype=">u2")
        # Samples arrive in order. The low bits of the number show how many have been lost.
        first_number = (
            self._next_number + (report.first_number - self._next_number) % _SAMPLE_NUMBER_WRAP
        )
        if first_number + len(values) // axis_count > self._count:
            # These samples were received before, or belong to an earlier capture.
            return
        for offset in range(len(values) // axis_count):
            row = values[offset * axis_count : (offset + 1) * axis_count]
            for column, low_bits in enumerate(row):
                previous_steps = self._latest_steps[column]
                self._latest_steps[column] = (
                    previous_steps
                    + (int(low_bits) - previous_steps + _HALF_WRAP_STEPS) % _WRAP_STEPS
                    - _HALF_WRAP_STEPS
                )
            self._unread_rows.append((first_number + offset, list(self._latest_steps)))
            self._received_count += 1
        self._next_number = first_number + len(values) // axis_count

    def take(self) -> CapturedSamples | None:
        """Return the samples since the last call, or None if there is nothing new."""
        if self._begin_us is None and not self.is_over:
            return None
        rows, self._unread_rows = self._unread_rows, []
        if not rows and (self._is_end_reported or not self.is_over):
            return None
        self._is_end_reported = self.is_over
        begin_us = float(self._begin_us or 0)
        index = np.array([number for number, _ in rows], dtype=np.float64)
        time_s = self._keep_increasing(
            index, self._to_device_time_s(begin_us + index * self._period_us)
        )
        measured = np.array(
            [
                [axis.to_si(steps) for axis, steps in zip(self._axes, row, strict=True)]
                for _, row in rows
            ]
        ).reshape(len(rows), len(self._axes))
        columns = [self._sent_order.index(name) for name in self._names]
        return CapturedSamples(
            self._names,
            time_s,
            measured[:, columns],
            self._next_number - self._received_count,
            self.is_over,
        )

    def _keep_increasing(self, index: FloatArray, time_s: FloatArray) -> FloatArray:
        """Return times (n,), shifted if a new clock estimate would make them go back."""
        if not len(index):
            return time_s
        if self._latest_sample is not None:
            number, last_s = self._latest_sample
            earliest_s = last_s + 0.5e-6 * self._period_us * (index[0] - number)
            time_s = time_s + max(earliest_s - time_s[0], 0.0)
        self._latest_sample = float(index[-1]), float(time_s[-1])
        return time_s
