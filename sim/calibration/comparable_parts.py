"""The parts of a record in which an axis' sensor and the laser can be compared."""

import itertools
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.messages import (
    format_fixed,
    join_messages,
    marked,
    message,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact, format_percent

# The axis must travel at least this share of its range.
MIN_TRAVEL_SHARE = 0.1
# At least this share of a record's rows must be comparable.
MIN_KEPT_SHARE = 0.7
MIN_PART_S = 0.2
MIN_ROWS = 500
# An interval longer than this many median intervals is a gap.
_GAP_TO_INTERVAL_RATIO = 5.0
# A laser that repeats one value for this long may be frozen.
_MIN_FROZEN_S = 0.01
# A constant laser value counts as frozen only if the sensor moves by this many noise floors.
_MOTION_TO_NOISE_RATIO = 8.0
# A laser that differs from the sensor by more than this share of the range is wrong.
_MAX_DEVIATION_SHARE = 0.25
# This many rows before and after a loss are excluded as well.
_LOSS_MARGIN_ROWS = 5
# A part is resampled if its intervals vary by more than this share of the median interval.
_MAX_UNEVENNESS_RATIO = 1e-3


class ComparablePart(NamedTuple):
    """Evenly spaced rows, ``step_s`` apart, in which the laser was never lost.

    ``reading`` and ``reference`` (n,) are in m or rad. ``rows`` are the rows of the record.
    """

    reading: FloatArray
    reference: FloatArray
    step_s: float
    rows: slice


class SensorComparison(NamedTuple):
    """A record in which the sensor of one axis is compared with the reference.

    ``valid`` (n,) marks the rows with a laser reading. ``losses`` are messages about the others.
    """

    record: Record
    axis: str
    parts: tuple[ComparablePart, ...]
    valid: BoolArray
    losses: tuple[str, ...]


def compare_with_laser(
    record: Record, axis: str, robot: Robot, name: str = "record"
) -> SensorComparison:
    """Extract sensor and laser of an axis from a record, without rows where one of them was lost.

    Raises
    ------
    SensorCalibrationError
        If the axis, sensor or laser is missing, if the axis hardly moves, or if the laser was
        lost for more than 30 % of the rows.
    """
    _check_channels(record, axis, robot, name)
    reading, reference = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.REF)
    model = robot.axes[axis]
    noise_floor = model.sensor.noise_floor if model.sensor is not None else 0.0
    is_lost = _find_frozen_rows(
        record.time_s,
        reading,
        reference,
        max(_MOTION_TO_NOISE_RATIO * noise_floor, 1e-6 * model.span),
    )
    deviation = reference - reading
    is_lost |= np.abs(deviation - np.median(deviation)) > _MAX_DEVIATION_SHARE * model.span
    interval_s = float(np.median(np.diff(record.time_s)))
    breaks = np.flatnonzero(np.diff(record.time_s) > _GAP_TO_INTERVAL_RATIO * interval_s)
    losses = _describe_losses(record.time_s, is_lost, breaks)
    valid = ~_widen_losses(is_lost)
    parts = tuple(
        _make_part(record, axis, rows, interval_s)
        for rows in find_stretches(valid, breaks)
        if (rows.stop - rows.start) * interval_s >= MIN_PART_S
    )
    comparable_count = sum(part.rows.stop - part.rows.start for part in parts)
    if comparable_count < MIN_KEPT_SHARE * len(valid):
        raise SensorCalibrationError(
            "{name}: {axis}: laser and sensor can be compared in {kept} of {count} rows, "
            "{least_kept} are needed ({losses}); align the laser and record again",
            name=name,
            axis=axis,
            kept=comparable_count,
            count=len(valid),
            least_kept=format_percent(MIN_KEPT_SHARE),
            losses=join_messages(losses, "; ")
            if losses
            else marked("engine", "the rest is in short pieces"),
        )
    travel = float(np.ptp(np.concatenate([part.reference for part in parts])))
    _check_travel(travel, axis, robot, name)
    return SensorComparison(record, axis, parts, valid, losses)


def _check_channels(record: Record, axis: str, robot: Robot, name: str) -> None:
    if axis not in robot.axes or axis not in record.axes:
        names, owner = (
            (robot.axes, marked("engine", "the robot"))
            if axis not in robot.axes
            else (record.axes, name)
        )
        raise SensorCalibrationError(
            "{name}: axis {axis}: {whose} has {names}; choose one",
            name=name,
            axis=repr(axis),
            whose=owner,
            names=", ".join(names),
        )
    for tap, description in (
        (Tap.MEAS, marked("engine", "the axis' own sensor")),
        (Tap.REF, marked("engine", "a laser")),
    ):
        if not record.has(axis, tap):
            raise SensorCalibrationError(
                "{name}: there is no column {axis}.{tap}, the reading of {what}; it has "
                "{names}; record with the laser, or join its file",
                name=name,
                axis=axis,
                tap=tap,
                what=description,
                names=", ".join(map(str, record.columns)),
            )
    if len(record.time_s) < MIN_ROWS:
        raise SensorCalibrationError(
            "{name}: {count} rows; a calibration needs at least {least_rows}",
            name=name,
            count=len(record.time_s),
            least_rows=MIN_ROWS,
        )


def _check_travel(travel: float, axis: str, robot: Robot, name: str) -> None:
    span, unit = robot.axes[axis].span, robot.unit(axis) or "m"
    if travel < MIN_TRAVEL_SHARE * span:
        raise SensorCalibrationError(
            "{name}: according to the laser {axis} travels {travel}, {share} of its range; a "
            "calibration needs {least_share}, which is {least}; move the axis farther",
            name=name,
            axis=axis,
            travel=format_exact(travel, unit),
            share=format_percent(travel / span),
            least_share=format_percent(MIN_TRAVEL_SHARE),
            least=format_exact(MIN_TRAVEL_SHARE * span, unit),
        )


def _find_frozen_rows(
    time_s: FloatArray, reading: FloatArray, reference: FloatArray, min_motion: float
) -> BoolArray:
    is_frozen = np.zeros(len(time_s), dtype=np.bool_)
    edges = np.flatnonzero(np.diff(reference) != 0.0) + 1
    bounds = np.concatenate([[0], edges, [len(time_s)]])
    for begin, end in itertools.pairwise(bounds):
        if time_s[end - 1] - time_s[begin] < _MIN_FROZEN_S:
            continue
        if float(np.ptp(reading[begin:end])) > min_motion:
            is_frozen[begin:end] = True
    return is_frozen


def _widen_losses(is_lost: BoolArray) -> BoolArray:
    window = np.ones(2 * _LOSS_MARGIN_ROWS + 1)
    return np.asarray(np.convolve(is_lost, window, mode="same") > 0.5)


def _describe_losses(time_s: FloatArray, is_lost: BoolArray, breaks: np.ndarray) -> tuple[str, ...]:
    messages = [
        message("engine", "the laser was lost from {begin} s to {end} s").fill(
            begin=format_fixed(time_s[rows.start], 3), end=format_fixed(time_s[rows.stop - 1], 3)
        )
        for rows in find_stretches(is_lost)
    ]
    messages += [
        message("engine", "no rows from {begin} s to {end} s").fill(
            begin=format_fixed(time_s[row], 3), end=format_fixed(time_s[row + 1], 3)
        )
        for row in breaks.tolist()
    ]
    return tuple(messages)


def find_stretches(valid: BoolArray, breaks: np.ndarray | None = None) -> list[slice]:
    """Return the ranges of consecutive valid rows, which also end after each row of ``breaks``."""
    stretch_ids = np.zeros(len(valid), dtype=np.int64)
    if breaks is not None:
        stretch_ids[breaks + 1] = 1
    stretch_ids = 2 * np.cumsum(stretch_ids) + valid
    edges = np.concatenate([[0], np.flatnonzero(np.diff(stretch_ids)) + 1, [len(valid)]])
    return [slice(int(begin), int(end)) for begin, end in itertools.pairwise(edges) if valid[begin]]


def _make_part(record: Record, axis: str, rows: slice, interval_s: float) -> ComparablePart:
    """Return the rows as a part. Unevenly spaced rows are resampled at ``interval_s``."""
    time_s = record.time_s[rows]
    reading, reference = (record.signal(axis, tap)[rows] for tap in (Tap.MEAS, Tap.REF))
    if len(time_s) > 1 and float(np.ptp(np.diff(time_s))) > _MAX_UNEVENNESS_RATIO * interval_s:
        even_s = time_s[0] + interval_s * np.arange(int((time_s[-1] - time_s[0]) / interval_s) + 1)
        reading, reference = (np.interp(even_s, time_s, signal) for signal in (reading, reference))
    return ComparablePart(reading, reference, interval_s, rows)
