"""Resampling of trajectories onto a uniform grid, and the speeds that it induces."""

from collections.abc import Callable, Mapping
from math import floor, isfinite
from typing import Literal, get_args

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded
from rotemina.sim.records.file_blocks import LIMITS
from rotemina.sim.records.record import Record, RecordError, Tap

Method = Literal["hold", "linear", "cubic"]

# A grid point that lies this part of a step before a row is meant to be on it.
_ON_A_ROW = 1e-6


def resample(record: Record, rate_hz: float, method: Method = "hold") -> Record:
    """Return the record on the uniform grid ``t_0 + k / rate_hz`` that lies within it.

    Parameters
    ----------
    record : at any rate, uniform or not.
    rate_hz : of the grid, 1/s.
    method : ``"hold"`` keeps the last row's value, as a command is held between rows; ``"linear"``
        joins rows by lines; ``"cubic"`` is the spline through all rows with continuous acceleration
        (not-a-knot), which may swing beyond them.

    Returns
    -------
    Record
        A lower rate is not filtered, so what moves faster than half of it folds back. A periodic
        record no longer ends with a whole period: ``history`` becomes ``unknown``.

    Raises
    ------
    RecordError
        If the rate or the method is none, or the grid has too many points.
    """
    if method not in get_args(Method):
        raise RecordError(
            message("engine", "resampling: unknown method {method}; use one of {names}").fill(
                method=repr(method), names=" ".join(get_args(Method))
            )
        )
    time_s = _grid(record, rate_hz)
    interpolate = _METHODS[method]
    values = np.empty((len(time_s), len(record.columns)), order="F")
    for index in range(len(record.columns)):
        values[:, index] = interpolate(record.time_s, record.values[:, index], time_s)
    return Record(time_s, record.columns, values, record.units, _metadata(record))


def induced_velocity(record: Record) -> dict[str, float]:
    """Return each axis' greatest ``|Δcmd/Δt|`` from row to row, m/s or rad/s.

    An axis without a command is left out; a single row moves nothing.
    """
    steps_s = np.diff(record.time_s)
    return {
        axis: float(np.max(np.abs(np.diff(record.signal(axis, Tap.CMD)) / steps_s), initial=0.0))
        for axis in record.axes
        if record.has(axis, Tap.CMD)
    }


def _grid(record: Record, rate_hz: float) -> FloatArray:
    if not (isfinite(rate_hz) and rate_hz > 0):
        raise RecordError(
            message("engine", "resampling: rate {rate_hz} Hz; use a positive number").fill(
                rate_hz=repr(rate_hz)
            )
        )
    steps = record.duration_s * rate_hz + _ON_A_ROW
    if steps * (1 + len(record.columns)) > LIMITS.values:
        raise RecordError(
            message(
                "engine",
                "resampling: {steps} rows at {rate_hz} Hz exceed {values} values; lower the rate",
            ).fill(steps=rounded(steps, 3), rate_hz=rounded(rate_hz, 6), values=LIMITS.values)
        )
    time_s: FloatArray = record.time_s[0] + np.arange(floor(steps) + 1) / rate_hz
    time_s[-1] = min(time_s[-1], record.time_s[-1])
    return time_s


def _hold(rows_s: FloatArray, signal: FloatArray, grid_s: FloatArray) -> FloatArray:
    step_s = grid_s[1] - grid_s[0] if len(grid_s) > 1 else 0.0
    index = np.searchsorted(rows_s, grid_s + _ON_A_ROW * step_s, side="right") - 1
    return signal[index]


def _linear(rows_s: FloatArray, signal: FloatArray, grid_s: FloatArray) -> FloatArray:
    return np.interp(grid_s, rows_s, signal)


def _cubic(rows_s: FloatArray, signal: FloatArray, grid_s: FloatArray) -> FloatArray:
    from scipy.interpolate import CubicSpline  # takes its time to import

    if len(rows_s) < 2:
        return np.full(len(grid_s), signal[0])
    return np.asarray(CubicSpline(rows_s, signal)(grid_s), dtype=np.float64)


_METHODS: Mapping[str, Callable[[FloatArray, FloatArray, FloatArray], FloatArray]] = {
    "hold": _hold,
    "linear": _linear,
    "cubic": _cubic,
}


def _metadata(record: Record) -> dict[str, str]:
    metadata = dict(record.metadata)
    if record.history == "periodic":
        metadata["history"] = "unknown"
        metadata.pop("period_samples", None)
    return metadata
