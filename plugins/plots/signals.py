"""What plots draw: a stretch of the live history, and another run beside it. Free of Qt."""

from dataclasses import dataclass, replace

import numpy as np

from rotemina.app.motion.history import LiveWindow
from rotemina.app.shell.language import translate
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.gap import GapFigure, gap_figure, moving
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Channel, Record, Tap
from rotemina.sim.robot.model import Robot

_LEAST_SAMPLES = 20  # below that a match of two runs means nothing


class NothingShownError(InputError):
    """A picture without samples, of which nothing can be saved or kept."""


@dataclass(frozen=True, slots=True, eq=False)
class OtherRun:
    """A run that is drawn beside the present one.

    Attributes
    ----------
    name : str
    time_s : (n,)
        Its own.
    command, measured : (n, axes)
        In the robot's order, m or rad; NaN where it has none.
    """

    name: str
    time_s: FloatArray
    command: FloatArray
    measured: FloatArray

    @classmethod
    def of_record(cls, name: str, record: Record, robot: Robot) -> "OtherRun":
        """Return the run that a record holds."""
        signals = []
        for tap in (Tap.CMD, Tap.MEAS):
            values = np.full((len(record.time_s), len(robot.axes)), np.nan)
            for column, axis in enumerate(robot.axes):
                channel = Channel(axis, tap)
                if channel in record.columns:
                    values[:, column] = record.values[:, record.columns.index(channel)]
            signals.append(values)
        return cls(name, record.time_s, *signals)

    @classmethod
    def of_window(cls, name: str, window: LiveWindow) -> "OtherRun":
        """Return the run that is shown now.

        Raises
        ------
        NothingShownError
            If nothing is.
        """
        if len(window) == 0:
            raise NothingShownError(
                translate("plots", "plots: no samples are shown, so there is no run to keep")
            )
        return cls(name, window.device_time_s, window.command, window.measured)


def latest(window: LiveWindow, span_s: float) -> LiveWindow:
    """Return the last seconds of a window."""
    time_s = window.device_time_s
    if len(time_s) == 0:
        return window
    first = int(np.searchsorted(time_s, time_s[-1] - span_s, side="left"))
    names = ("device_time_s", "command", "model", "measured", "nominal", "doubt")
    return replace(window, **{name: getattr(window, name)[first:] for name in names})


def gaps_of(window: LiveWindow) -> dict[str, GapFigure | None]:
    """Return the gap of each axis in a window, from where the model in use is the one that is."""
    counted = moving(window.device_time_s, window.command)
    counted &= window.device_time_s > window.gap_since_s
    return {
        axis: gap_figure(
            counted, window.measured[:, column], window.model[:, column], window.nominal[:, column]
        )
        for column, axis in enumerate(window.axes)
    }


def as_record(window: LiveWindow, robot: Robot) -> Record:
    """Return what is shown as a record, its time from 0: commands and readings of every axis.

    The model is left out: it is computed from the commands wherever the record is opened.

    Raises
    ------
    NothingShownError
        If nothing is.
    """
    if len(window) == 0:
        raise NothingShownError(
            translate("plots", "plots: no samples are shown, so there is nothing to save")
        )
    time_s = window.device_time_s - window.device_time_s[0]
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, axis in enumerate(window.axes):
        signals[axis, Tap.CMD] = window.command[:, column]
        signals[axis, Tap.MEAS] = window.measured[:, column]
    units = {axis: robot.axes[axis].unit or "m" for axis in window.axes}
    # It was cut out of a motion: nobody knows what came before.
    return Record.from_signals(time_s, signals, units, {"history": "unknown"})


def alignment(window: LiveWindow, other: OtherRun) -> float | None:
    """Return what to add to another run's time so that its commands are best those of the window.

    The shorter of the two is moved along the longer one; the place with the least squares of the
    difference of the commands counts, each axis by its own way. None where nothing moves in it.
    """
    if min(len(window), len(other.time_s)) < _LEAST_SAMPLES:
        return None
    period_s = float(np.median(np.diff(window.device_time_s)))
    here, there = (
        _even(time_s, command, period_s)
        for time_s, command in (
            (window.device_time_s, window.command),
            (other.time_s, other.command),
        )
    )
    way = np.ptp(there, axis=0)
    moving = np.isfinite(way) & (way > 0.0)
    if not moving.any():
        return None
    here, there = here[:, moving] / way[moving], there[:, moving] / way[moving]
    swapped = len(there) > len(here)
    long, short = (there, here) if swapped else (here, there)
    middle = short.mean(axis=0)
    rows = _best_start(long - middle, short - middle)
    offset_s = (-rows if swapped else rows) * period_s
    return float(window.device_time_s[0] - other.time_s[0]) + offset_s


def _best_start(long: FloatArray, short: FloatArray) -> int:
    """Return the row of ``long`` (n, a) at which ``short`` (m, a) fits best by least squares."""
    from scipy.signal import correlate  # only here: it takes half a second

    count = len(short)
    cost = np.zeros(len(long) - count + 1)
    for column in range(short.shape[1]):
        squares = np.concatenate([[0.0], np.cumsum(long[:, column] ** 2)])
        cost += squares[count:] - squares[: len(cost)]
        cost -= 2.0 * correlate(long[:, column], short[:, column], "valid", "fft")
    return int(np.argmin(cost))


def _even(time_s: FloatArray, values: FloatArray, period_s: float) -> FloatArray:
    grid = np.arange(time_s[0], time_s[-1] + 0.5 * period_s, period_s)
    return np.stack([np.interp(grid, time_s, column) for column in values.T], axis=1)
