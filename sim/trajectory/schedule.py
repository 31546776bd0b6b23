"""The instants at which a device applies and samples a trajectory: rows, and ticks between them."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.plant import MIN_TICK_S
from rotemina.sim.records import Record, Tap

# A delay below this, relative to a tick, is attributed to rounding.
TICK_TOLERANCE_RATIO = 1e-6


class PlaybackInstants(NamedTuple):
    """Consecutive instants of a playback, (n,) each.

    ``time_s`` is the time since the first row, ``row`` is the row whose command acts, and
    ``on_row`` is true if that row begins to act at the instant.
    """

    time_s: FloatArray
    row: IntArray
    on_row: BoolArray


class PlaybackSchedule:
    """The instants of one playback, computed on demand because a trajectory may last for hours.

    Every row is an instant. An interval between rows that is longer than ``tick_s`` is divided into
    equal parts of at most ``tick_s``. With ``on_ticks``, the instants are whole ticks instead,
    because a controller acts at its own rate. A row then begins to act at the first tick at or
    after its time. If several rows fall into one tick, only the last one acts.
    """

    def __init__(self, trajectory: Record, axes: tuple[str, ...], tick_s: float, *, on_ticks: bool):
        self._row_times_s = trajectory.time_s - trajectory.time_s[0]
        self._columns = {
            axes.index(channel.axis): trajectory.signal(channel.axis, Tap.CMD)
            for channel in trajectory.columns
            if channel.tap is Tap.CMD
        }
        self._tick_s = tick_s
        self._on_ticks = on_ticks
        if on_ticks:
            self._count = int(np.ceil(self._row_times_s[-1] / tick_s - TICK_TOLERANCE_RATIO)) + 1
        else:
            interval = np.append(np.diff(self._row_times_s), 0.0)
            parts = np.maximum(np.ceil(interval / tick_s - TICK_TOLERANCE_RATIO), 1).astype(
                np.int64
            )
            self._part_lengths_s = interval / parts
            self._first_instants = np.concatenate([[0], np.cumsum(parts)]).astype(np.int64)
            self._count = int(self._first_instants[-1])
        # Times are rounded to this unit, as in the plant. Thus equal intervals stay equal, and few
        # matrix exponentials are enough for a whole playback.
        max_time_s = float(np.abs(trajectory.time_s[[0, -1]]).max())
        self._time_unit_s = max(MIN_TICK_S, 4.0 * float(np.finfo(np.float64).eps) * max_time_s)

    @property
    def count(self) -> int:
        """Total number of instants."""
        return self._count

    @property
    def first_commands(self) -> dict[int, float]:
        """Commands of the first row, by the index of the axis."""
        return {index: float(column[0]) for index, column in self._columns.items()}

    def instants(self, begin: int, end: int) -> PlaybackInstants:
        """Return instants ``begin`` to ``end`` (not included)."""
        numbers = np.arange(begin, min(end, self.count), dtype=np.int64)
        if self._on_ticks:
            row = self._find_row_at_tick(numbers)
            time_s = (numbers * self._tick_s).astype(np.float64)
            return PlaybackInstants(time_s, row, row != self._find_row_at_tick(numbers - 1))
        row = (np.searchsorted(self._first_instants, numbers, side="right") - 1).astype(np.int64)
        part = numbers - self._first_instants[row]
        return PlaybackInstants(
            self._row_times_s[row] + part * self._part_lengths_s[row], row, part == 0
        )

    def count_until(self, time_s: float) -> int:
        """Return the number of instants up to and including a time since the first row.

        The number may be off by one if the time differs from an instant only by rounding.
        """
        if time_s < 0.0:
            return 0
        if self._on_ticks:
            return min(int(time_s / self._tick_s) + 1, self.count)
        row = int(np.searchsorted(self._row_times_s, time_s, side="right")) - 1
        if row >= len(self._part_lengths_s) - 1:
            return self.count
        part = int((time_s - self._row_times_s[row]) / self._part_lengths_s[row])
        return min(int(self._first_instants[row]) + part + 1, int(self._first_instants[row + 1]))

    def _find_row_at_tick(self, ticks: IntArray) -> IntArray:
        due_s = (ticks + TICK_TOLERANCE_RATIO) * self._tick_s
        return (np.searchsorted(self._row_times_s, due_s, side="right") - 1).astype(np.int64)

    def compute_elapsed(self, since_s: float, time_s: FloatArray) -> FloatArray:
        """Return the times of instants ``time_s`` relative to an instant at ``since_s``, s."""
        elapsed_units = np.rint(time_s / self._time_unit_s) - np.rint(since_s / self._time_unit_s)
        return np.asarray(elapsed_units * self._time_unit_s, dtype=np.float64)

    def commands(self, row: IntArray, held: FloatArray) -> FloatArray:
        """Return the commands (n, axes) of rows (n,), with ``held`` (axes,) for the other axes."""
        commands = np.tile(held, (len(row), 1))
        for index, column in self._columns.items():
            commands[:, index] = column[row]
        return commands

    def progress(self, instant: int) -> float:
        """Return the fraction of the duration, 0 to 1, after ``instant`` instants were played."""
        if instant <= 0:
            return 0.0
        if instant >= self.count:
            return 1.0
        time_s = self.instants(instant - 1, instant).time_s[0]
        return float(time_s / self._row_times_s[-1]) if self._row_times_s[-1] > 0 else 1.0

    def velocity(self, instant: int, axes: int) -> FloatArray:
        """Return the velocity (axes,) of the commands at an instant, per s.

        It is 0 while a row is held. There is a velocity only if the row began to act within
        the last tick and follows an earlier row by less than one and a half ticks.
        """
        velocity = np.zeros(axes)
        current = self.instants(instant, instant + 1)
        row = int(current.row[0])
        row_start_s = float(self._row_times_s[row])
        if current.time_s[0] - row_start_s >= (1.0 - TICK_TOLERANCE_RATIO) * self._tick_s:
            return velocity
        previous_row = int(np.searchsorted(self._row_times_s, row_start_s - 1.5 * self._tick_s))
        if previous_row < row:
            for index, column in self._columns.items():
                change = column[row] - column[previous_row]
                velocity[index] = change / (row_start_s - self._row_times_s[previous_row])
        return velocity
