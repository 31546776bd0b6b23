"""Assembly of the boards' telemetry into rows of samples, by sampling instant."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.drivers.mc68hc11.board import Board, BoardSample
from rotemina.sim.arrays import FloatArray

# The samples of all boards at one instant.
SampleRow = tuple[BoardSample, ...]
# Returns, for the number of an instant and its samples, the row of the trajectory (-1 if none is
# playing) and the commands of each board, steps.
TrajectoryLookup = Callable[[int, SampleRow], tuple[int, Sequence[tuple[int, ...]]]]


class _AssembledRow(NamedTuple):
    """Device time, command and reading of each axis, m or rad, and row of the trajectory, or -1."""

    time_s: float
    command: list[float]
    measured: list[float]
    trajectory_row: int


class SampleAssembler:
    """Assembler that merges the telemetry of all boards into rows of samples.

    A row is complete when every board has sent its sample. It is dropped when a board has sent a
    later sample instead. So a loss on the line leaves a gap.

    Parameters
    ----------
    boards : sequence of Board
        The clock of the first board is the clock of the device.
    find_trajectory_row : callable
        Returns, for the number of an instant and its samples, the row of the trajectory (-1 if none
        is playing) and the commands of each board, steps.
    """

    def __init__(self, boards: Sequence[Board], find_trajectory_row: TrajectoryLookup) -> None:
        self._boards = tuple(boards)
        self._axis_count = sum(len(board.axes) for board in boards)
        self._find_trajectory_row = find_trajectory_row
        self._samples: tuple[dict[int, BoardSample], ...] = tuple({} for _ in boards)
        self._latest_numbers = [-1 for _ in boards]
        self._settled_number = -1
        self._rows: list[_AssembledRow] = []
        # Time of the instant with the number 0 on the first board's clock.
        self._epoch_us: int | None = None

    @property
    def latest_finished_number(self) -> int:
        """Number of the latest instant whose row is complete or dropped."""
        return self._settled_number

    def collect_samples(self) -> None:
        """Take the samples that the boards have sent since the last call."""
        for index, board in enumerate(self._boards):
            while board.samples:
                sample = board.samples.popleft()
                if sample.instant_number > self._latest_numbers[index]:
                    self._samples[index][sample.instant_number] = sample
                    self._latest_numbers[index] = sample.instant_number
        finished_number = min(self._latest_numbers)
        first_board_samples = self._samples[0]
        for number in sorted(number for number in first_board_samples if number <= finished_number):
            if all(number in samples for samples in self._samples):
                self._append_row(number, tuple(samples[number] for samples in self._samples))
        for samples in self._samples:
            for number in [number for number in samples if number <= finished_number]:
                del samples[number]
        self._settled_number = max(self._settled_number, finished_number)

    def take_rows(self) -> DeviceSamples:
        """Return the rows that were assembled since the last call."""
        rows, self._rows = self._rows, []
        if not rows:
            return DeviceSamples.empty(self._axis_count)
        command = np.array([row.command for row in rows])
        return DeviceSamples(
            np.array([row.time_s for row in rows]),
            command,
            np.array([row.measured for row in rows]),
            np.full_like(command, np.nan),
            np.array([row.trajectory_row for row in rows], dtype=np.int64),
        )

    def to_device_time_s(self, time_us: FloatArray) -> FloatArray:
        """Return the device times, s, of unwrapped times (n,) of the first board."""
        return np.asarray(1e-6 * (time_us - (self._epoch_us or 0.0)))

    def _append_row(self, number: int, row: SampleRow) -> None:
        time_us = row[0].time_us
        if self._epoch_us is None:
            grid = self._boards[0].grid
            assert grid is not None, "samples have numbers only if there is a grid"
            self._epoch_us = time_us - number * grid.period_us
        trajectory_row, commands = self._find_trajectory_row(number, row)
        command, measured = [], []
        for board, sample, board_commands in zip(self._boards, row, commands, strict=True):
            for axis, reading, command_steps in zip(
                board.axes, sample.readings, board_commands, strict=True
            ):
                measured.append(axis.to_si(reading))
                command.append(axis.to_si(command_steps))
        self._rows.append(
            _AssembledRow(1e-6 * (time_us - self._epoch_us), command, measured, trajectory_row)
        )
