"""The data of the plots: a stretch of the live history. Free of Qt."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rotemina.app.motion.recent_history import LiveWindow
from rotemina.plugins.plots import tr
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.comparison.gap import GapFigure, gap_course, gap_figure, moving
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

SHORT_S = 0.5  # what each value of a gap's course looks back
_COURSE_STEPS = 200  # of a course, at most


class NothingShownError(InputError):
    """A picture without samples, of which nothing can be saved or kept."""


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
    counted = _counted(window)
    return {
        axis: gap_figure(
            counted, window.measured[:, column], window.model[:, column], window.nominal[:, column]
        )
        for column, axis in enumerate(window.axes)
    }


def _counted(window: LiveWindow) -> BoolArray:
    """Return which samples (n,) count: something moves, and the model in use is the present one."""
    counted = moving(window.device_time_s, window.command)
    return counted & (window.device_time_s > window.gap_since_s)


class GapHistory(NamedTuple):
    """The gap (m, axes), m or rad, of the half second before each of some device times (m,), s."""

    time_s: FloatArray
    gap: FloatArray

    @classmethod
    def of(cls, window: LiveWindow, span_s: float) -> "GapHistory":
        """Return the course of a window, its times at whole steps so that it does not flicker."""
        time_s = window.device_time_s
        step_s = max(span_s / _COURSE_STEPS, SHORT_S / 5)
        if len(time_s) == 0:
            return cls(np.empty(0), np.empty((0, len(window.axes))))
        first, last = np.ceil(time_s[0] / step_s), np.floor(time_s[-1] / step_s)
        ends_s = step_s * np.arange(first, last + 1)
        gap = window.measured - window.model
        return cls(ends_s, gap_course(time_s, _counted(window), gap, ends_s, SHORT_S))


def as_record(window: LiveWindow, robot: Robot) -> Record:
    """Return what is shown as a record, its time from 0: commands and readings of every axis.

    The model is left out: it is computed from the commands wherever the record is opened.

    Raises
    ------
    NothingShownError
        If nothing is.
    """
    if len(window) == 0:
        raise NothingShownError(tr("plots: there are no samples to save"))
    time_s = window.device_time_s - window.device_time_s[0]
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, axis in enumerate(window.axes):
        signals[axis, Tap.CMD] = window.command[:, column]
        signals[axis, Tap.MEAS] = window.measured[:, column]
    units = {axis: robot.axes[axis].unit or "m" for axis in window.axes}
    # It was cut out of a motion: nobody knows what came before.
    return Record.from_signals(time_s, signals, units, {"history": "unknown"})
