"""Data of the second run in the plots, and the time shift that best aligns it with the first.

Does not use Qt.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.app.motion.device import HistoryWindow
from rotemina.plugins.plots import tr
from rotemina.plugins.plots.history_signals import NothingShownError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.records import (
    Record,
    RecordChannel,
    Tap,
)
from rotemina.sim.robot import Robot

# A match between shorter runs might be accidental.
_MIN_SAMPLES = 20


@dataclass(frozen=True, slots=True, eq=False)
class OverlayRun:
    """Second run, drawn together with the current one.

    Attributes
    ----------
    name : str
    time_s : (n,)
        The times of the run, without the time shift.
    command, measured : (n, axes)
        Signals of the axes in the order of the robot, m or rad. NaN for an axis without data.
    """

    name: str
    time_s: FloatArray
    command: FloatArray
    measured: FloatArray

    @classmethod
    def from_record(cls, name: str, record: Record, robot: Robot) -> "OverlayRun":
        """Return the run in a record."""
        signals = []
        for tap in (Tap.CMD, Tap.MEAS):
            values = np.full((len(record.time_s), len(robot.axes)), np.nan)
            for column, axis in enumerate(robot.axes):
                channel = RecordChannel(axis, tap)
                if channel in record.columns:
                    values[:, column] = record.values[:, record.columns.index(channel)]
            signals.append(values)
        return cls(name, record.time_s, *signals)

    @classmethod
    def from_window(cls, name: str, window: HistoryWindow) -> "OverlayRun":
        """Return the run in a window of the live history.

        Raises
        ------
        NothingShownError
            If the window has no samples.
        """
        if len(window) == 0:
            raise NothingShownError(tr("plots: there are no samples, so no run to keep"))
        return cls(name, window.device_time_s, window.command, window.measured)


def find_time_shift(window: HistoryWindow, other: OverlayRun) -> float | None:
    """Return the time shift of a second run at which its commands best match those of a window.

    The shorter of the two is shifted along the longer one. The best shift has the smallest sum of
    squared differences between the commands, each axis divided by its stroke in the second run.
    Returns None if nothing moves in the second run, or if one of them is too short.
    """
    if min(len(window), len(other.time_s)) < _MIN_SAMPLES:
        return None
    period_s = float(np.median(np.diff(window.device_time_s)))
    window_commands, overlay_commands = (
        _resample_evenly(time_s, command, period_s)
        for time_s, command in (
            (window.device_time_s, window.command),
            (other.time_s, other.command),
        )
    )
    stroke = np.ptp(overlay_commands, axis=0)
    is_moving = np.isfinite(stroke) & (stroke > 0.0)
    if not is_moving.any():
        return None
    window_commands, overlay_commands = (
        window_commands[:, is_moving] / stroke[is_moving],
        overlay_commands[:, is_moving] / stroke[is_moving],
    )
    is_overlay_longer = len(overlay_commands) > len(window_commands)
    long, short = (
        (overlay_commands, window_commands)
        if is_overlay_longer
        else (window_commands, overlay_commands)
    )
    mean = short.mean(axis=0)
    best_row = _find_best_row(long - mean, short - mean)
    offset_s = (-best_row if is_overlay_longer else best_row) * period_s
    return float(window.device_time_s[0] - other.time_s[0]) + offset_s


def _find_best_row(long: FloatArray, short: FloatArray) -> int:
    """Return the row of ``long`` (n, a) at which ``short`` (m, a) fits best by least squares."""
    # Imported only when needed, because the import takes half a second.
    from scipy.signal import correlate

    count = len(short)
    cost = np.zeros(len(long) - count + 1)
    for column in range(short.shape[1]):
        squares = np.concatenate([[0.0], np.cumsum(long[:, column] ** 2)])
        cost += squares[count:] - squares[: len(cost)]
        cost -= 2.0 * correlate(long[:, column], short[:, column], "valid", "fft")
    return int(np.argmin(cost))


def _resample_evenly(time_s: FloatArray, values: FloatArray, period_s: float) -> FloatArray:
    grid = np.arange(time_s[0], time_s[-1] + 0.5 * period_s, period_s)
    return np.stack([np.interp(grid, time_s, column) for column in values.T], axis=1)
