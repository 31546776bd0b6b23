"""Resampling of trajectories onto a uniform grid, and their maximum speeds."""

from collections.abc import Callable, Mapping
from math import floor, isfinite
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compatibility import serve_former_names
from rotemina.sim.errors import RecordError
from rotemina.sim.messages import format_rounded
from rotemina.sim.records.file_blocks import DEFAULT_LIMITS
from rotemina.sim.records.record import Record, Tap

Method = Literal["hold", "linear", "cubic"]

# A grid point that is less than this fraction of a step before a row counts as being on it.
_ROW_TOLERANCE_STEPS = 1e-6


def resample(record: Record, rate_hz: float, method: Method = "hold") -> Record:
    """Return the record on the uniform grid ``t_0 + k / rate_hz`` within its duration.

    Parameters
    ----------
    record : at any rate, uniform or not.
    rate_hz : rate of the grid, 1/s.
    method : ``"hold"`` keeps the value of the last row, as a device holds a command between rows.
        ``"linear"`` interpolates linearly. ``"cubic"`` is the spline through all rows with
        continuous acceleration (not-a-knot), which may overshoot them.

    Returns
    -------
    Record
        There is no anti-aliasing filter: at a lower rate, frequencies above half of it fold back.
        The ``history`` of a periodic record becomes ``unknown``, because the record no longer ends
        with a whole period.

    Raises
    ------
    RecordError
        If the rate or the method is invalid, or the grid has too many points.
    """
    if method not in get_args(Method):
        raise RecordError(
            "resampling: unknown method {method}; use one of {names}",
            method=repr(method),
            names=" ".join(get_args(Method)),
        )
    time_s = _make_grid(record, rate_hz)
    interpolate = _METHODS[method]
    values = np.empty((len(time_s), len(record.columns)), order="F")
    for index in range(len(record.columns)):
        values[:, index] = interpolate(record.time_s, record.values[:, index], time_s)
    return Record(time_s, record.columns, values, record.units, _adapt_metadata(record))


def find_max_speeds(record: Record) -> dict[str, float]:
    """Return each axis' largest ``|Δcmd/Δt|`` from row to row, m/s or rad/s.

    An axis without a command is left out. The speed of a record with a single row is 0.
    """
    steps_s = np.diff(record.time_s)
    return {
        axis: float(np.max(np.abs(np.diff(record.signal(axis, Tap.CMD)) / steps_s), initial=0.0))
        for axis in record.axes
        if record.has(axis, Tap.CMD)
    }


def _make_grid(record: Record, rate_hz: float) -> FloatArray:
    if not (isfinite(rate_hz) and rate_hz > 0):
        raise RecordError(
            "resampling: rate {rate_hz} Hz; use a positive number", rate_hz=repr(rate_hz)
        )
    steps = record.duration_s * rate_hz + _ROW_TOLERANCE_STEPS
    if steps * (1 + len(record.columns)) > DEFAULT_LIMITS.values:
        raise RecordError(
            "resampling: {steps} rows at {rate_hz} Hz exceed {values} values; lower the rate",
            steps=format_rounded(steps, 3),
            rate_hz=format_rounded(rate_hz, 6),
            values=DEFAULT_LIMITS.values,
        )
    time_s: FloatArray = record.time_s[0] + np.arange(floor(steps) + 1) / rate_hz
    time_s[-1] = min(time_s[-1], record.time_s[-1])
    return time_s


def _hold_values(row_times_s: FloatArray, signal: FloatArray, grid_s: FloatArray) -> FloatArray:
    step_s = grid_s[1] - grid_s[0] if len(grid_s) > 1 else 0.0
    index = np.searchsorted(row_times_s, grid_s + _ROW_TOLERANCE_STEPS * step_s, side="right") - 1
    return signal[index]


def _interpolate_linearly(
    row_times_s: FloatArray, signal: FloatArray, grid_s: FloatArray
) -> FloatArray:
    return np.interp(grid_s, row_times_s, signal)


def _interpolate_cubically(
    row_times_s: FloatArray, signal: FloatArray, grid_s: FloatArray
) -> FloatArray:
    # SciPy is slow to import, so it is imported only when needed.
    from scipy.interpolate import CubicSpline

    if len(row_times_s) < 2:
        return np.full(len(grid_s), signal[0])
    return np.asarray(CubicSpline(row_times_s, signal)(grid_s), dtype=np.float64)


_METHODS: Mapping[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "hold": _hold_values,
    "linear": _interpolate_linearly,
    "cubic": _interpolate_cubically,
}


def _adapt_metadata(record: Record) -> dict[str, str]:
    metadata = dict(record.metadata)
    if record.history == "periodic":
        metadata["history"] = "unknown"
        metadata.pop("period_samples", None)
    return metadata


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        induced_velocity="find_max_speeds",
    )
