"""Playback of a trajectory by the simulated machine, piece by piece."""

from typing import NamedTuple

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.drivers.simulator.smooth_rows import SmoothRows
from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.records.record import Record
from rotemina.sim.trajectory.schedule import Schedule

_ON_TIME = 1e-6  # of a tick: what is late by less is on time


class Chunk(NamedTuple):
    """Sampling instants (n,) of the device, commands (n, axes) and rows of a trajectory (n,).

    ``elapsed_s`` (n,) is the time since the latest sample before: small, and so exact. ``told``
    (n,) says which of them are samples: not all ticks of a loop are.
    """

    time_s: FloatArray
    elapsed_s: FloatArray
    command: FloatArray
    row: IntArray
    told: BoolArray


def selected(samples: Samples, which: BoolArray) -> Samples:
    """Return which (n,) of all ticks are sampled."""
    if which.all():
        return samples
    return Samples(
        samples.device_time_s[which],
        samples.command[which],
        samples.measured[which],
        samples.inputs[which],
        samples.playback_row[which],
        None if samples.reference is None else samples.reference[which],
    )


class Playing:
    """One playback; its first row begins to act at a tick that :meth:`begin` names.

    Parameters
    ----------
    trajectory : Record
    axes : tuple of str
        Of the machine.
    tick_s : float
    ticks : int
        From sample to sample.
    on_ticks : bool
        Whether rows wait for ticks: for what lives at them.
    smooth : bool
        Whether ticks between rows lie on a smooth path: for loops that are led by it.
    """

    def __init__(
        self,
        trajectory: Record,
        axes: tuple[str, ...],
        tick_s: float,
        ticks: int,
        *,
        on_ticks: bool,
        smooth: bool,
    ) -> None:
        self._schedule = Schedule(trajectory, axes, tick_s, on_ticks=on_ticks)
        self._smooth = SmoothRows(trajectory, axes, ticks * tick_s) if smooth else None
        self._axes, self._tick_s, self._ticks = len(axes), tick_s, ticks
        self._instant = 0
        self._latest_s = 0.0  # time of the latest instant since the first row
        self._begin_s = 0.0

    @property
    def first(self) -> dict[int, float]:
        """Commands of the first row, by the number of the axis."""
        return self._schedule.first

    @property
    def begun(self) -> bool:
        """Whether its first row has begun to act."""
        return self._instant > 0

    @property
    def ended(self) -> bool:
        """Whether its last row has begun to act."""
        return self._instant == self._schedule.count

    @property
    def progress(self) -> float:
        """How much of it has been played, 0 to 1."""
        return self._schedule.progress(self._instant)

    @property
    def time_s(self) -> float:
        """Device time of the latest instant."""
        return self._begin_s + self._latest_s

    def begin(self, time_s: float) -> None:
        """Let the first row begin to act at this device time, a tick after the latest sample."""
        self._begin_s = time_s

    def take(self, until_s: float, held: FloatArray, most: int) -> Chunk:
        """Return the next instants up to a device time; other axes stay at ``held`` (axes,)."""
        schedule, began = self._schedule, self._instant
        due_s = until_s - self._begin_s + _ON_TIME * self._tick_s
        most = min(most, max(schedule.count_until(due_s) + 1 - began, 0))
        instants = schedule.instants(began, began + most)
        count = int(np.searchsorted(instants.time_s, due_s, side="right"))
        time_s, row = instants.time_s[:count], instants.row[:count]
        on_row = instants.on_row[:count]
        command = schedule.commands(row, held)
        if self._smooth is not None:
            command = self._smooth.commands(time_s, command)
        elapsed_s = schedule.elapsed(self._latest_s, time_s)
        if began == 0:
            elapsed_s = elapsed_s + self._tick_s
        if count:
            self._instant += count
            self._latest_s = float(time_s[-1])
        even = np.arange(began, began + count) % self._ticks == 0
        own = np.where(on_row, row, -1)
        return Chunk(self._begin_s + time_s, elapsed_s, command, own, on_row | even)

    def velocity(self) -> FloatArray:
        """Return the speed (axes,) of the commands at the latest instant, per s."""
        if self._smooth is not None:
            return self._smooth.velocity(self._latest_s, self._axes)
        return self._schedule.velocity(self._instant - 1, self._axes)
