"""Playback of a trajectory by the simulated machine, in chunks."""

from typing import NamedTuple

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.drivers.simulator.smooth_rows import TrajectoryInterpolator
from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.records import Record
from rotemina.sim.trajectory import PlaybackSchedule

# Rounding error of times, as a fraction of a tick.
_TICK_TOLERANCE = 1e-6


class CommandChunk(NamedTuple):
    """Instants of the device: times (n,), commands (n, axes) and rows of a trajectory (n,).

    ``elapsed_s`` (n,) is the time since the latest instant before the chunk. It is small, and so
    are its rounding errors. ``is_sample`` (n,) says which instants are samples; loops may run at
    more ticks than there are samples.
    """

    time_s: FloatArray
    elapsed_s: FloatArray
    command: FloatArray
    row: IntArray
    is_sample: BoolArray


def select_samples(samples: DeviceSamples, is_selected: BoolArray) -> DeviceSamples:
    """Return the samples for which ``is_selected`` (n,) is true."""
    if is_selected.all():
        return samples
    return DeviceSamples(
        samples.device_time_s[is_selected],
        samples.command[is_selected],
        samples.measured[is_selected],
        samples.inputs[is_selected],
        samples.playback_row[is_selected],
        None if samples.reference is None else samples.reference[is_selected],
    )


class TrajectoryPlayback:
    """Playback of one trajectory. :meth:`begin` sets the time at which its first row takes effect.

    Parameters
    ----------
    trajectory : Record
    axes : tuple of str
        Axes of the machine.
    tick_s : float
    ticks : int
        Number of ticks per sample.
    on_ticks : bool
        Whether rows take effect only at ticks, as loops and inverses require.
    smooth : bool
        Whether the commands follow a smooth path between rows, as loops with feed-forward require.
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
        self._schedule = PlaybackSchedule(trajectory, axes, tick_s, on_ticks=on_ticks)
        self._interpolator = (
            TrajectoryInterpolator(trajectory, axes, ticks * tick_s) if smooth else None
        )
        self._axis_count, self._tick_s, self._ticks_per_sample = len(axes), tick_s, ticks
        self._instant_count = 0
        # Time from the first row to the latest instant.
        self._latest_s = 0.0
        self._begin_s = 0.0

    @property
    def first_commands(self) -> dict[int, float]:
        """Commands of the first row, by axis number."""
        return self._schedule.first_commands

    @property
    def has_begun(self) -> bool:
        """Whether the first row has taken effect."""
        return self._instant_count > 0

    @property
    def has_ended(self) -> bool:
        """Whether the last row has taken effect."""
        return self._instant_count == self._schedule.count

    @property
    def progress(self) -> float:
        """Fraction of the trajectory that has been played, 0 to 1."""
        return self._schedule.progress(self._instant_count)

    @property
    def time_s(self) -> float:
        """Device time of the latest instant."""
        return self._begin_s + self._latest_s

    def begin(self, time_s: float) -> None:
        """Set the device time of the first row, which is a tick after the latest sample."""
        self._begin_s = time_s

    def take_chunk(self, until_s: float, held: FloatArray, max_count: int) -> CommandChunk:
        """Return the next instants up to a device time, at most ``max_count``.

        Axes that the trajectory does not move remain at ``held`` (axes,).
        """
        schedule, first = self._schedule, self._instant_count
        due_s = until_s - self._begin_s + _TICK_TOLERANCE * self._tick_s
        max_count = min(max_count, max(schedule.count_until(due_s) + 1 - first, 0))
        instants = schedule.instants(first, first + max_count)
        count = int(np.searchsorted(instants.time_s, due_s, side="right"))
        time_s, row = instants.time_s[:count], instants.row[:count]
        on_row = instants.on_row[:count]
        command = schedule.commands(row, held)
        if self._interpolator is not None:
            command = self._interpolator.smooth_commands(time_s, command)
        elapsed_s = schedule.compute_elapsed(self._latest_s, time_s)
        if first == 0:
            elapsed_s = elapsed_s + self._tick_s
        if count:
            self._instant_count += count
            self._latest_s = float(time_s[-1])
        on_sample = np.arange(first, first + count) % self._ticks_per_sample == 0
        rows = np.where(on_row, row, -1)
        return CommandChunk(self._begin_s + time_s, elapsed_s, command, rows, on_row | on_sample)

    def compute_velocity(self) -> FloatArray:
        """Return the speed (axes,) of the commands at the latest instant, m/s or rad/s."""
        if self._interpolator is not None:
            return self._interpolator.compute_velocity(self._latest_s, self._axis_count)
        return self._schedule.velocity(self._instant_count - 1, self._axis_count)
