"""The parts of a record in which an axis' sensor and the laser can be compared."""

import itertools
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.messages import joined, marked, message
from rotemina.sim.quantities import exact, fixed, percent
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

LEAST_TRAVEL = 0.1  # of the axis' range
LEAST_KEPT = 0.7  # of a record's rows
LEAST_PART_S = 0.2
LEAST_ROWS = 500
_GAP = 5.0  # times the median interval
_FROZEN_S = 0.01
_MOVED = 8.0  # times the sensor's noise: motion that a laser must have seen
_FAR = 0.25  # of the range: a laser that is so far from the sensor is none
_MARGIN = 5  # rows that are left out about a loss
_UNEVEN = 1e-3  # relative


class Part(NamedTuple):
    """Rows at one interval ``step_s`` in which the laser was never lost.

    ``reading`` and ``reference`` (n,) are in m or rad. ``rows`` says which they were of a record.
    """

    reading: FloatArray
    reference: FloatArray
    step_s: float
    rows: slice


class Comparison(NamedTuple):
    """A record's comparison of one axis' sensor with the reference.

    ``sound`` (n,) are the rows at which the laser was there; ``losses`` are words.
    """

    record: Record
    axis: str
    parts: tuple[Part, ...]
    sound: BoolArray
    losses: tuple[str, ...]


def compared(record: Record, axis: str, robot: Robot, name: str = "record") -> Comparison:
    """Take sensor and laser of an axis out of a record, without the rows where either was lost.

    Raises
    ------
    CalibrationError
        If there is no such axis, sensor or laser; if the axis hardly moves; or if the laser was
        lost for more than 30 % of the rows.
    """
    _check(record, axis, robot, name)
    reading, reference = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.REF)
    model = robot.axes[axis]
    floor = model.sensor.noise_floor if model.sensor is not None else 0.0
    lost = _frozen(record.time_s, reading, reference, max(_MOVED * floor, 1e-6 * model.span))
    away = reference - reading
    lost |= np.abs(away - np.median(away)) > _FAR * model.span
    interval_s = float(np.median(np.diff(record.time_s)))
    breaks = np.flatnonzero(np.diff(record.time_s) > _GAP * interval_s)
    losses = _told(record.time_s, lost, breaks)
    sound = ~_widened(lost)
    parts = tuple(
        _part(record, axis, rows, interval_s)
        for rows in stretches(sound, breaks)
        if (rows.stop - rows.start) * interval_s >= LEAST_PART_S
    )
    kept = sum(part.rows.stop - part.rows.start for part in parts)
    if kept < LEAST_KEPT * len(sound):
        raise CalibrationError(
            message(
                "engine",
                "{name}: {axis}: laser and sensor can be compared in {kept} of {count} rows, "
                "{least_kept} are needed ({losses}); align the laser and record again",
            ).fill(
                name=name,
                axis=axis,
                kept=kept,
                count=len(sound),
                least_kept=percent(LEAST_KEPT),
                losses=joined(losses, "; ")
                if losses
                else marked("engine", "the rest is in short pieces"),
            )
        )
    travel = float(np.ptp(np.concatenate([part.reference for part in parts])))
    _check_travel(travel, axis, robot, name)
    return Comparison(record, axis, parts, sound, losses)


def _check(record: Record, axis: str, robot: Robot, name: str) -> None:
    if axis not in robot.axes or axis not in record.axes:
        has, whose = (
            (robot.axes, marked("engine", "the robot"))
            if axis not in robot.axes
            else (record.axes, name)
        )
        raise CalibrationError(
            message("engine", "{name}: axis {axis}: {whose} has {names}; choose one").fill(
                name=name, axis=repr(axis), whose=whose, names=", ".join(has)
            )
        )
    for tap, what in (
        (Tap.MEAS, marked("engine", "the axis' own sensor")),
        (Tap.REF, marked("engine", "a laser")),
    ):
        if not record.has(axis, tap):
            raise CalibrationError(
                message(
                    "engine",
                    "{name}: there is no column {axis}.{tap}, the reading of {what}; it has "
                    "{names}; record with the laser, or join its file",
                ).fill(
                    name=name,
                    axis=axis,
                    tap=tap,
                    what=what,
                    names=", ".join(map(str, record.columns)),
                )
            )
    if len(record.time_s) < LEAST_ROWS:
        raise CalibrationError(
            message(
                "engine", "{name}: {count} rows; a calibration needs at least {least_rows}"
            ).fill(name=name, count=len(record.time_s), least_rows=LEAST_ROWS)
        )


def _check_travel(travel: float, axis: str, robot: Robot, name: str) -> None:
    span, unit = robot.axes[axis].span, robot.unit(axis) or "m"
    if travel < LEAST_TRAVEL * span:
        raise CalibrationError(
            message(
                "engine",
                "{name}: {axis} travels {travel} by the laser, {share} of its range; a "
                "calibration needs {least_share}: {least}; move it farther",
            ).fill(
                name=name,
                axis=axis,
                travel=exact(travel, unit),
                share=percent(travel / span),
                least_share=percent(LEAST_TRAVEL),
                least=exact(LEAST_TRAVEL * span, unit),
            )
        )


def _frozen(
    time_s: FloatArray, reading: FloatArray, reference: FloatArray, moved: float
) -> BoolArray:
    """Tell where the laser repeats one value to the last digit while the sensor continues."""
    lost = np.zeros(len(time_s), dtype=np.bool_)
    edges = np.flatnonzero(np.diff(reference) != 0.0) + 1
    bounds = np.concatenate([[0], edges, [len(time_s)]])
    for begin, end in itertools.pairwise(bounds):
        if time_s[end - 1] - time_s[begin] < _FROZEN_S:
            continue
        if float(np.ptp(reading[begin:end])) > moved:
            lost[begin:end] = True
    return lost


def _widened(lost: BoolArray) -> BoolArray:
    window = np.ones(2 * _MARGIN + 1)
    return np.asarray(np.convolve(lost, window, mode="same") > 0.5)


def _told(time_s: FloatArray, lost: BoolArray, breaks: np.ndarray) -> tuple[str, ...]:
    told = [
        message("engine", "the laser was lost from {begin} s to {end} s").fill(
            begin=fixed(time_s[rows.start], 3), end=fixed(time_s[rows.stop - 1], 3)
        )
        for rows in stretches(lost)
    ]
    told += [
        message("engine", "no rows from {begin} s to {end} s").fill(
            begin=fixed(time_s[at], 3), end=fixed(time_s[at + 1], 3)
        )
        for at in breaks.tolist()
    ]
    return tuple(told)


def stretches(sound: BoolArray, breaks: np.ndarray | None = None) -> list[slice]:
    """Return the runs of sound rows, cut behind the rows of ``breaks``."""
    number = np.zeros(len(sound), dtype=np.int64)
    if breaks is not None:
        number[breaks + 1] = 1
    number = 2 * np.cumsum(number) + sound
    edges = np.concatenate([[0], np.flatnonzero(np.diff(number)) + 1, [len(sound)]])
    return [slice(int(begin), int(end)) for begin, end in itertools.pairwise(edges) if sound[begin]]


def _part(record: Record, axis: str, rows: slice, interval_s: float) -> Part:
    """Return a stretch at one interval; one whose rows are uneven is interpolated."""
    time_s = record.time_s[rows]
    reading, reference = (record.signal(axis, tap)[rows] for tap in (Tap.MEAS, Tap.REF))
    if len(time_s) > 1 and float(np.ptp(np.diff(time_s))) > _UNEVEN * interval_s:
        even_s = time_s[0] + interval_s * np.arange(int((time_s[-1] - time_s[0]) / interval_s) + 1)
        reading, reference = (np.interp(even_s, time_s, each) for each in (reading, reference))
    return Part(reading, reference, interval_s, rows)
