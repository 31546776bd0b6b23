"""Data of the plots, computed from a window of the live history. Does not use Qt."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.device import HistoryWindow
from rotemina.plugins.plots import tr
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.comparison import (
    GapFigure,
    compute_gap_course,
    compute_gap_figure,
    find_moving_samples,
)
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot

# Each value of a gap history is the rms gap over this time.
GAP_WINDOW_S = 0.5
_MAX_GAP_STEPS = 200


class NothingShownError(InputError):
    """The plots show no samples that could be saved or kept."""


def cut_latest(window: HistoryWindow, span_s: float) -> HistoryWindow:
    """Return the last ``span_s`` seconds of a window."""
    time_s = window.device_time_s
    if len(time_s) == 0:
        return window
    first_row = int(np.searchsorted(time_s, time_s[-1] - span_s, side="left"))
    names = ("device_time_s", "command", "model", "measured", "nominal", "doubt")
    return replace(window, **{name: getattr(window, name)[first_row:] for name in names})


def compute_gaps(window: HistoryWindow) -> dict[str, GapFigure | None]:
    """Return the gap of each axis in the part of a window that the current model predicted."""
    is_counted = _find_counted_samples(window)
    return {
        axis: compute_gap_figure(
            is_counted,
            window.measured[:, column],
            window.model[:, column],
            window.nominal[:, column],
        )
        for column, axis in enumerate(window.axes)
    }


def _find_counted_samples(window: HistoryWindow) -> BoolArray:
    """Return whether each sample (n,) counts: an axis moves, and the current model predicted it."""
    is_moving = find_moving_samples(window.device_time_s, window.command)
    return is_moving & (window.device_time_s > window.gap_since_s)


class GapHistory(NamedTuple):
    """Gap over time.

    Attributes
    ----------
    time_s : (m,)
        Device times.
    gap : (m, axes)
        The rms gap of the half second before each time, m or rad. NaN where nothing moved.
    """

    time_s: FloatArray
    gap: FloatArray

    @classmethod
    def from_window(cls, window: HistoryWindow, span_s: float) -> "GapHistory":
        """Return the gap history of a window.

        The times are multiples of a fixed step, so that the curve does not flicker.
        """
        time_s = window.device_time_s
        step_s = max(span_s / _MAX_GAP_STEPS, GAP_WINDOW_S / 5)
        if len(time_s) == 0:
            return cls(np.empty(0), np.empty((0, len(window.axes))))
        first_step, last_step = np.ceil(time_s[0] / step_s), np.floor(time_s[-1] / step_s)
        ends_s = step_s * np.arange(first_step, last_step + 1)
        gap = window.measured - window.model
        return cls(
            ends_s,
            compute_gap_course(time_s, _find_counted_samples(window), gap, ends_s, GAP_WINDOW_S),
        )


def to_record(window: HistoryWindow, robot: Robot) -> Record:
    """Return a window as a record with the commands and readings of all axes, from time 0.

    The record does not include the model, which is computed from the commands when the record is
    opened.

    Raises
    ------
    NothingShownError
        If the window has no samples.
    """
    if len(window) == 0:
        raise NothingShownError(tr("plots: there are no samples to save"))
    time_s = window.device_time_s - window.device_time_s[0]
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, axis in enumerate(window.axes):
        signals[axis, Tap.CMD] = window.command[:, column]
        signals[axis, Tap.MEAS] = window.measured[:, column]
    units = {axis: robot.axes[axis].unit or "m" for axis in window.axes}
    # The motion before the window is not in the record, so the history of the axes is unknown.
    return Record.from_signals(time_s, signals, units, {"history": "unknown"})
