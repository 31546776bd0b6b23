"""When a playing trajectory is sampled: at its rows, and at device ticks between distant rows."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.plant.sampling import TICK_S
from rotemina.sim.records.record import Record, Tap

BoolArray = NDArray[np.bool_]


class Instants(NamedTuple):
    """Consecutive instants of a playback, (n,) each.

    ``time_s`` since the first row, ``row`` whose command acts, and whether the instant is that
    row's own (``on_row``).
    """

    time_s: FloatArray
    row: IntArray
    on_row: BoolArray


class Schedule:
    """The instants of one playback, produced piece by piece: a trajectory may last for hours.

    With ``fill`` a longer interval between rows is cut into equal parts of at most ``tick_s``;
    without, rows alone are instants: a sampled controller acts as often as it is sampled.
    """

    def __init__(self, trajectory: Record, axes: tuple[str, ...], tick_s: float, *, fill: bool):
        self._since_s = trajectory.time_s - trajectory.time_s[0]
        self._columns = {
            axes.index(c.axis): trajectory.signal(c.axis, Tap.CMD)
            for c in trajectory.columns
            if c.tap is Tap.CMD
        }
        interval = np.append(np.diff(self._since_s), 0.0)
        parts = np.ceil(interval / tick_s - 1e-6) if fill else np.ones_like(interval)
        self._parts = np.maximum(parts, 1).astype(np.int64)
        self._part_s = interval / self._parts
        self._starts = np.concatenate([[0], np.cumsum(self._parts)]).astype(np.int64)
        # The rounding of the trajectory's times, as the plant counts them: equal intervals stay
        # equal, so that few matrix exponentials serve a whole playback.
        late_s = float(np.abs(trajectory.time_s[[0, -1]]).max())
        self._atom_s = max(TICK_S, 4.0 * float(np.finfo(np.float64).eps) * late_s)

    @property
    def count(self) -> int:
        """How many instants there are in all."""
        return int(self._starts[-1])

    @property
    def first(self) -> dict[int, float]:
        """Commands of the first row, by the number of the axis."""
        return {index: float(column[0]) for index, column in self._columns.items()}

    def instants(self, begin: int, end: int) -> Instants:
        """Return instants ``begin`` to ``end`` (not included)."""
        number = np.arange(begin, min(end, self.count), dtype=np.int64)
        row = (np.searchsorted(self._starts, number, side="right") - 1).astype(np.int64)
        part = number - self._starts[row]
        return Instants(self._since_s[row] + part * self._part_s[row], row, part == 0)

    def elapsed(self, begin: int, time_s: FloatArray) -> FloatArray:
        """Return the times since instant ``begin - 1`` (or the first) of instants' ``time_s``."""
        since_s = self.instants(max(begin - 1, 0), max(begin - 1, 0) + 1).time_s[0]
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

    def velocity(self, row: int, axes: int) -> FloatArray:
        """Return the speed (axes,) with which the commands came to ``row``, per s."""
        velocity = np.zeros(axes)
        if row > 0:
            interval = self._since_s[row] - self._since_s[row - 1]
            for index, column in self._columns.items():
                velocity[index] = (column[row] - column[row - 1]) / interval
        return velocity
