"""Check for sensors with a constant reading while their axis is commanded to move."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord, RecordCaution
from rotemina.sim.messages import Message, format_rounded, message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_exact

# This many consecutive equal readings form a run.
_MIN_RUN_ROWS = 20
# A run is suspicious if the command travels meanwhile by this fraction of its span, by this many
# noise floors, and by this many steps of the reading.
_MIN_COMMAND_TRAVEL_RATIO = 0.02
_MIN_COMMAND_TRAVEL_FLOORS = 20.0
_MIN_COMMAND_TRAVEL_STEPS = 1.5
# The reading may respond to a command with this delay.
_RESPONSE_TIME_S = 0.05
# A reading that is constant for this fraction of a record is a fault.
_MIN_STUCK_RATIO = 0.2
# For a reading that repeatedly returns to the same end of its range, a smaller fraction is enough.
_MIN_SATURATED_RATIO = 0.05
# When a saturating reading reaches or leaves its limit, it changes by at most this fraction of its
# span.
_MAX_APPROACH_RATIO = 0.1
# From the first to the last row of a saturated run, the command may change by this fraction of its
# travel during the run.
_MAX_COMMAND_CHANGE_RATIO = 0.25
# The axis moves if its reference travels during a run, by this fraction of the command's travel.
_MIN_REFERENCE_TRAVEL_RATIO = 0.5


class _ConstantRuns(NamedTuple):
    """Runs of equal readings while the command moves.

    Each array is (k,): first rows, ends and values of the runs, the travel of the command during
    each run, and the change of the command from the first to the last row.
    """

    begin: IntArray
    end: IntArray
    value: FloatArray
    travel: FloatArray
    change: FloatArray

    @property
    def rows(self) -> IntArray:
        return self.end - self.begin

    def select(self, selection: BoolArray) -> "_ConstantRuns":
        return _ConstantRuns(
            self.begin[selection],
            self.end[selection],
            self.value[selection],
            self.travel[selection],
            self.change[selection],
        )

    def at_value(self, value: float) -> "_ConstantRuns":
        return self.select(self.value == value)


def check_sensors(robot: Robot, labelled: LabelledRecord) -> Iterator[RecordCaution]:
    """Check that readings change when their axis moves.

    A reading that stays exactly the same for a long time cannot belong to a moving axis. It cannot
    belong to a resting axis either if the sensor noise exceeds the resolution. In both cases the
    sensor is faulty, and the record is refused, because a diagnosis would wrongly name contact or
    saturation. If the noise is too small to decide and no reference shows motion, the axis may
    really stand still, and the finding becomes a caution. Dropouts are accepted, because they are
    an effect: they are short, and begin and end with jumps.

    Raises
    ------
    GapError
        If a sensor is faulty. The message names the axis, the value and the time.
    """
    for axis in labelled.record.axes:
        if labelled.record.has(axis, Tap.MEAS) and labelled.record.has(axis, Tap.CMD):
            yield from _check_sensor(robot, labelled, axis)


def _check_sensor(robot: Robot, labelled: LabelledRecord, axis: str) -> Iterator[RecordCaution]:
    record = labelled.record
    reading = record.signal(axis, Tap.MEAS)
    runs = _find_constant_runs(robot, record, axis)
    for value, fault in _find_faults(reading, runs):
        faulty_runs = runs.at_value(value)
        is_still = _is_reference_still(record, axis, faulty_runs)
        if is_still and np.ptp(reading) > 0.0:
            continue
        value_text = format_exact(value, record.units[axis])
        percent = format_rounded(100.0 * faulty_runs.rows.sum() / len(reading), 3)
        if np.ptp(reading) == 0.0 or is_still is False or _has_visible_noise(robot, axis):
            raise GapError(
                "{name}: {axis}.meas stays at exactly {stand} for {percent} % of the rows, "
                "while the axis is commanded to move (first at t = {time_s} s): the sensor is "
                "{what}; repair it, stay within its measuring range, or leave the column out",
                name=labelled.name,
                axis=axis,
                stand=value_text,
                percent=percent,
                time_s=format_rounded(record.time_s[faulty_runs.begin[0]], 9),
                what=fault,
            )
        yield labelled.make_caution(
            message(
                "gap",
                "The reading stays at exactly {stand} for {percent} % of the rows, while "
                "the axis is commanded to move: either the axis does not follow, or the "
                "sensor is {fault}. The records cannot distinguish the two.",
            ).fill(stand=value_text, percent=percent, fault=fault),
            axis,
        )


def _find_constant_runs(robot: Robot, record: Record, axis: str) -> _ConstantRuns:
    reading, command = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.CMD)
    sensor = robot.axes[axis].sensor
    floor = sensor.noise_floor if sensor is not None else 0.0
    step = float(np.diff(np.unique(reading)).min(initial=np.inf))
    min_travel = max(
        _MIN_COMMAND_TRAVEL_RATIO * float(np.ptp(command)),
        _MIN_COMMAND_TRAVEL_FLOORS * floor,
        _MIN_COMMAND_TRAVEL_STEPS * step if np.isfinite(step) else 0.0,
    )
    edges = np.flatnonzero(np.diff(reading) != 0.0) + 1
    begin, end = np.append(0, edges), np.append(edges, len(reading))
    is_long = end - begin >= _MIN_RUN_ROWS
    begin, end = begin[is_long], end[is_long]
    # The last rows of a run may already have the next command, which has not had any effect yet.
    delay_rows = max(round(_RESPONSE_TIME_S / float(np.median(np.diff(record.time_s)))), 1)
    effective_end = np.maximum(end - delay_rows, begin + 1)
    travel = np.array([np.ptp(command[a:b]) for a, b in zip(begin, effective_end, strict=True)])
    runs = _ConstantRuns(
        begin, end, reading[begin], travel, np.abs(command[end - 1] - command[begin])
    )
    return runs.select((travel >= min_travel) & (min_travel > 0.0))


def _find_faults(reading: FloatArray, runs: _ConstantRuns) -> Iterator[tuple[float, Message]]:
    for value in np.unique(runs.value):
        runs_at_value = runs.at_value(value)
        if runs_at_value.rows.max() >= _MIN_STUCK_RATIO * len(reading):
            yield float(value), message("gap", "stuck or not connected")
        elif value in (reading.min(), reading.max()):
            saturated_rows = runs_at_value.rows[_find_saturation(reading, runs_at_value)].sum()
            if saturated_rows >= _MIN_SATURATED_RATIO * len(reading):
                yield float(value), message("gap", "saturated")


def _find_saturation(reading: FloatArray, runs: _ConstantRuns) -> BoolArray:
    """Return which runs (k,) begin and end smoothly and at the same command, as saturation does.

    Dropouts jump. With backlash, the command is different at the end.
    """
    max_jump = _MAX_APPROACH_RATIO * float(np.ptp(reading))
    entry_jump = np.abs(reading[np.maximum(runs.begin - 1, 0)] - runs.value)
    exit_jump = np.abs(reading[np.minimum(runs.end, len(reading) - 1)] - runs.value)
    is_smooth = (entry_jump <= max_jump) & (exit_jump <= max_jump)
    return np.asarray(is_smooth & (runs.change <= _MAX_COMMAND_CHANGE_RATIO * runs.travel))


def _has_visible_noise(robot: Robot, axis: str) -> bool:
    """Return whether noise would be visible even while the axis stands still."""
    sensor = robot.axes[axis].sensor
    return sensor is not None and sensor.noise_rms > 0.0 and sensor.noise_rms >= sensor.resolution


def _is_reference_still(record: Record, axis: str, runs: _ConstantRuns) -> bool | None:
    """Return whether the axis stood still according to its reference; None without a reference."""
    if not record.has(axis, Tap.REF):
        return None
    reference = record.signal(axis, Tap.REF)
    travel = np.array([np.ptp(reference[a:b]) for a, b in zip(runs.begin, runs.end, strict=True)])
    return not bool(np.any(travel > _MIN_REFERENCE_TRAVEL_RATIO * runs.travel))
