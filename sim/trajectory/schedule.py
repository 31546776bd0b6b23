"""When a device applies and samples a playing trajectory: its rows, and ticks between them."""

from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.plant.zero_order_hold import TICK_S
from rotemina.sim.records.record import Record, Tap

ON_TIME = 1e-6  # of a tick: what is late by less is on time


class Instants(NamedTuple):
    """Consecutive instants of a playback, (n,) each.

    ``time_s`` since the first row, ``row`` whose command acts, and whether that row begins to act
    at the instant (``on_row``).
    """

    time_s: FloatArray
    row: IntArray
    on_row: BoolArray


class Schedule:
    """The instants of one playback, produced piece by piece: a trajectory may last for hours.

    Rows are instants, and an interval between them that is longer than ``tick_s`` is cut into
    equal parts of at most that. With ``on_ticks`` instants are whole ticks instead, for a
    controller acts at its own rate whatever the trajectory's: a row begins to act at the first
    tick that is not before it, and of several in one tick only the last does.
    """

    def __init__(self, trajectory: Record, axes: tuple[str, ...], tick_s: float, *, on_ticks: bool):
        self._since_s = trajectory.time_s - trajectory.time_s[0]
        self._columns = {
            axes.index(c.axis): trajectory.signal(c.axis, Tap.CMD)
            for c in trajectory.columns
            if c.tap is Tap.CMD
        }
        self._tick_s = tick_s
        self._on_ticks = on_ticks
        if on_ticks:
            self._count = int(np.ceil(self._since_s[-1] / tick_s - ON_TIME)) + 1
        else:
            interval = np.append(np.diff(self._since_s), 0.0)
            parts = np.maximum(np.ceil(interval / tick_s - ON_TIME), 1).astype(np.int64)
            self._part_s = interval / parts
            self._starts = np.concatenate([[0], np.cumsum(parts)]).astype(np.int64)
            self._count = int(self._starts[-1])
        # The rounding of the trajectory's times, as the plant counts them: equal intervals stay
        # equal, so that few matrix exponentials serve a whole playback.
        late_s = float(np.abs(trajectory.time_s[[0, -1]]).max())
        self._atom_s = max(TICK_S, 4.0 * float(np.finfo(np.float64).eps) * late_s)

    @property
    def count(self) -> int:
        """How many instants there are in all."""
        return self._count

    @property
    def first(self) -> dict[int, float]:
        """Commands of the first row, by the number of the axis."""
        return {index: float(column[0]) for index, column in self._columns.items()}

    def instants(self, begin: int, end: int) -> Instants:
        """Return instants ``begin`` to ``end`` (not included)."""
        number = np.arange(begin, min(end, self.count), dtype=np.int64)
        if self._on_ticks:
            row = self._row_at_tick(number)
            time_s = (number * self._tick_s).astype(np.float64)
            return Instants(time_s, row, row != self._row_at_tick(number - 1))
        row = (np.searchsorted(self._starts, number, side="right") - 1).astype(np.int64)
        part = number - self._starts[row]
        return Instants(self._since_s[row] + part * self._part_s[row], row, part == 0)

    def count_until(self, time_s: float) -> int:
        """Return how many instants there are up to a time since the first row, that included.

        It may be one more or less where an instant and the time differ by rounding.
        """
        if time_s < 0.0:
            return 0
        if self._on_ticks:
            return min(int(time_s / self._tick_s) + 1, self.count)
        row = int(np.searchsorted(self._since_s, time_s, side="right")) - 1
        if row >= len(self._part_s) - 1:
            return self.count
        part = int((time_s - self._since_s[row]) / self._part_s[row])
        return min(int(self._starts[row]) + part + 1, int(self._starts[row + 1]))

    def _row_at_tick(self, number: IntArray) -> IntArray:
        due_s = (number + ON_TIME) * self._tick_s
        return (np.searchsorted(self._since_s, due_s, side="right") - 1).astype(np.int64)

    def elapsed(self, since_s: float, time_s: FloatArray) -> FloatArray:
        """Return the times since an instant at ``since_s`` of instants' ``time_s``."""
        atoms = np.rint(time_s / self._atom_s) - np.rint(since_s / self._atom_s)
        return np.asarray(atoms * self._atom_s, dtype=np.float64)

    def commands(self, row: IntArray, held: FloatArray) -> FloatArray:
        """Return the commands (n, axes) of rows (n,), ``held`` (axes,) where none is given."""
        commands = np.tile(held, (len(row), 1))
        for index, column in self._columns.items():
            commands[:, index] = column[row]
        return commands

    def progress(self, instant: int) -> float:
        """Return 0 to 1: how much of the time has passed once ``instant`` were played."""
        if instant <= 0:
            return 0.0
        if instant >= self.count:
            return 1.0
        time_s = self.instants(instant - 1, instant).time_s[0]
        return float(time_s / self._since_s[-1]) if self._since_s[-1] > 0 else 1.0

    def velocity(self, instant: int, axes: int) -> FloatArray:
        """Return the speed (axes,) of the commands at an instant, per s.

        It is 0 where a row is held: unless the row began to act within the last tick, and another
        one less than a tick and a half before it.
        """
        velocity = np.zeros(axes)
        now = self.instants(instant, instant + 1)
        row = int(now.row[0])
        began_s = float(self._since_s[row])
        if now.time_s[0] - began_s >= (1.0 - ON_TIME) * self._tick_s:
            return velocity
        first = int(np.searchsorted(self._since_s, began_s - 1.5 * self._tick_s))
        if first < row:
            for index, column in self._columns.items():
                change = column[row] - column[first]
                velocity[index] = change / (began_s - self._since_s[first])
        return velocity
