"""What all boards told of the same instants, put together to rows of samples."""

from collections.abc import Callable, Sequence

import numpy as np

from rotemina.drivers.mc68hc11.board import Board, BoardSample
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray

Row = tuple[BoardSample, ...]  # of each board
Named = Callable[[int, Row], tuple[int, Sequence[tuple[int, ...]]]]


class Sampling:
    """Rows of samples from the telemetry of all boards.

    A row is complete when each board has told its part, and given up when any of them has told a
    later one: what was lost on the line leaves a gap.

    Parameters
    ----------
    boards : sequence of Board
        The first one's clock is the device's.
    named : callable
        Return the trajectory's row of an instant, or -1, and the commands, steps, of each board.
    """

    def __init__(self, boards: Sequence[Board], named: Named) -> None:
        self._boards = tuple(boards)
        self._axes = sum(len(board.axes) for board in boards)
        self._named = named
        self._parts: tuple[dict[int, BoardSample], ...] = tuple({} for _ in boards)
        self._latest = [-1 for _ in boards]
        self._settled = -1
        self._rows: list[tuple[float, list[float], list[float], int]] = []
        self._begin_us: int | None = None

    @property
    def settled(self) -> int:
        """The number of the latest instant that is complete or given up."""
        return self._settled

    def gather(self) -> None:
        """Take what the boards have told since."""
        for index, board in enumerate(self._boards):
            while board.samples:
                sample = board.samples.popleft()
                if sample.number > self._latest[index]:
                    self._parts[index][sample.number] = sample
                    self._latest[index] = sample.number
        settled = min(self._latest)
        first = self._parts[0]
        for number in sorted(one for one in first if one <= settled):
            if all(number in parts for parts in self._parts):
                self._append(number, tuple(parts[number] for parts in self._parts))
        for parts in self._parts:
            for number in [one for one in parts if one <= settled]:
                del parts[number]
        self._settled = max(self._settled, settled)

    def take(self) -> Samples:
        """Return the rows since the last call."""
        rows, self._rows = self._rows, []
        if not rows:
            return Samples.none(self._axes)
        command = np.array([row[1] for row in rows])
        return Samples(
            np.array([row[0] for row in rows]),
            command,
            np.array([row[2] for row in rows]),
            np.full_like(command, np.nan),
            np.array([row[3] for row in rows], dtype=np.int64),
        )

    def time_s(self, time_us: FloatArray) -> FloatArray:
        """Return unwrapped times of the first board on the clock of the samples, s."""
        return np.asarray(1e-6 * (time_us - (self._begin_us or 0.0)))

    def _append(self, number: int, row: Row) -> None:
        time_us = row[0].time_us
        if self._begin_us is None:
            grid = self._boards[0].grid
            assert grid is not None, "samples have numbers"
            self._begin_us = time_us - number * grid.period_us
        own, commands = self._named(number, row)
        command, measured = [], []
        for board, part, steps in zip(self._boards, row, commands, strict=True):
            for axis, reading, step in zip(board.axes, part.readings, steps, strict=True):
                measured.append(axis.value(reading))
                command.append(axis.value(step))
        self._rows.append((1e-6 * (time_us - self._begin_us), command, measured, own))
