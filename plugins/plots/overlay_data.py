"""Another run beside the live plots: its data, and the time shift of the best match.

Free of Qt.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.app.motion.recent_history import LiveWindow
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.history_signals import NothingShownError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.records.record import Channel, Record, Tap
from rotemina.sim.robot.model import Robot

_LEAST_SAMPLES = 20  # below that a match of two runs means nothing


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
            raise NothingShownError(tr("plots: there are no samples, so no run to keep"))
        return cls(name, window.device_time_s, window.command, window.measured)


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
