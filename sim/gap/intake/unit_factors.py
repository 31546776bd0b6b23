"""Check of the units of records: factors that no effect explains."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import log

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord, RecordCaution
from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command, is_controlled
from rotemina.sim.messages import format_rounded, message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    Axis,
    PiezoAxis,
    Robot,
)
from rotemina.sim.units import format_exact, per_si, units_of

# With at least this correlation, a reading follows its command.
_MIN_CORRELATION = 0.95
# A voltage needs a higher correlation, because even a strongly clipped voltage is correlated.
_MIN_VOLTAGE_CORRELATION = 0.995
# Gains between this value and its inverse may have other causes than a wrong unit.
_MAX_PLAUSIBLE_GAIN = 3.0
# A gain near a large unit factor is no coincidence even with a gain error, so the tolerance is
# wider.
_LARGE_FACTOR_LOG = log(10.0)
_LARGE_FACTOR_TOLERANCE_LOG, _SMALL_FACTOR_TOLERANCE_LOG = log(1.35), log(1.15)
# If the commands of two axes are correlated at least this much, a gain may come from coupling.
_MIN_COUPLED_CORRELATION = 0.9
# A command may be outside its range by this many times the length of the range.
_MAX_OUTSIDE_SPANS = 1.0
# An excess up to this many times the length of the range is rounding.
_RANGE_TOLERANCE_SPANS = 1e-9
# The median speed may be this many times the speed limit.
_MAX_SPEED_RATIO = 30.0


def check_units(
    robot: Robot, labelled: LabelledRecord, records: Sequence[Record]
) -> Iterator[RecordCaution]:
    """Check commands against limits, and readings against commands, in one of several records.

    A gain equal to the factor between two units is refused, and so are commands far outside the
    range: a diagnosis would wrongly name gain error, saturation or contact. Other unusual gains,
    and readings of opposite sign, become cautions, because strong coupling can cause them.

    Raises
    ------
    GapError
        If a unit seems wrong. The message names the axis, the factor and the units that would
        explain it.
    """
    for axis in labelled.record.axes:
        if labelled.record.has(axis, Tap.CMD):
            yield from _check_command(robot, labelled, axis)
            yield from _check_readings(robot, labelled, axis, records)


def _check_command(robot: Robot, labelled: LabelledRecord, axis: str) -> Iterator[RecordCaution]:
    model, command = robot.axes[axis], labelled.record.signal(axis, Tap.CMD)
    unit = labelled.record.units[axis]
    low, high = model.range
    excess = np.maximum(low - command, command - high)
    row = int(np.argmax(excess))
    bounds = message("gap", "{low} to {high}").fill(
        low=format_exact(low, unit, size=high), high=format_exact(high, unit)
    )
    if excess[row] > _MAX_OUTSIDE_SPANS * model.span:
        raise GapError(
            "{name}: {axis}.cmd = {command} at row {row} is far outside the range {bounds} of "
            "robot {robot_name}: this looks like a unit error; correct the unit in the "
            "header, or the robot file",
            name=labelled.name,
            axis=axis,
            command=format_exact(float(command[row]), unit),
            row=row + 1,
            bounds=bounds,
            robot_name=repr(robot.name),
        )
    if excess[row] > _RANGE_TOLERANCE_SPANS * model.span:
        yield labelled.make_caution(
            message(
                "gap",
                "A command of {value} is outside the range {low} to {high}; the model has "
                "no end stops.",
            ).fill(
                low=format_exact(low, unit, size=high),
                high=format_exact(high, unit),
                value=format_exact(float(command[row]), unit),
            ),
            axis,
        )
    speeds = np.abs(np.diff(command)) / np.diff(labelled.record.time_s)
    if model.max_speed is not None and np.median(speeds) > _MAX_SPEED_RATIO * model.max_speed:
        raise GapError(
            "{name}: axis {axis} is commanded at {speed} {unit}/s, {times} × its speed "
            "limit: this looks like a unit error of time; correct the unit of t, such as ms "
            "for s",
            name=labelled.name,
            axis=repr(axis),
            speed=format_rounded(np.median(speeds), 3),
            unit=unit,
            times=format_rounded(np.median(speeds) / model.max_speed, 3),
        )


def _check_readings(
    robot: Robot, labelled: LabelledRecord, axis: str, records: Sequence[Record]
) -> Iterator[RecordCaution]:
    model = robot.axes[axis]
    motion = SlowMotion.of(model, labelled.record, axis)
    if motion is None:
        return
    for tap in (Tap.U, Tap.REF, Tap.MEAS):
        expected_gain = _find_expected_gain(model, labelled.record, tap)
        if expected_gain is None or not labelled.record.has(axis, tap):
            continue
        min_correlation = _MIN_VOLTAGE_CORRELATION if tap is Tap.U else _MIN_CORRELATION
        gain = _estimate_slow_gain(
            motion, labelled.record.signal(axis, tap), expected_gain, min_correlation
        )
        if gain is None:
            continue
        if tap is Tap.U:
            if not _is_clipped(robot, records, axis):
                _check_voltage(labelled, axis, gain)
            continue
        factor = _match_unit_factor(abs(gain), labelled.record.units[axis])
        if factor is not None and not _moves_with_another(labelled.record, axis):
            raise GapError(
                "{name}: {axis}.{tap} is {gain} × {axis}.cmd: this looks like a unit error, a "
                "factor of {text}; correct the unit of the wrong column",
                name=labelled.name,
                axis=axis,
                tap=tap,
                gain=format_rounded(gain, 4),
                text=factor.text,
            )
        if factor is not None or abs(gain) > _MAX_PLAUSIBLE_GAIN or gain < 0.0:
            yield labelled.make_caution(
                message(
                    "gap",
                    "The {tap} channel is {gain} × the command, which no single effect causes: "
                    "check signs, units and the gain in the robot file.",
                ).fill(tap=str(tap), gain=format_rounded(gain, 3)),
                axis,
            )


def _find_expected_gain(axis: Axis, record: Record, tap: Tap) -> float | None:
    """Return the expected gain from command to signal in slow motion, or None if unknown."""
    if tap is Tap.U:
        if not isinstance(axis, PiezoAxis) or is_controlled(axis, record):
            return None
        return 1.0 / axis.gain
    return 1.0 if follows_command(axis, record) else None


def _estimate_slow_gain(
    motion: SlowMotion, signal: FloatArray, expected_gain: float, min_correlation: float
) -> float | None:
    """Return the gain relative to the expected gain, or None if the signal does not follow."""
    command, reading = motion.command, motion.average(signal)
    deviations = float(np.std(command) * np.std(reading))
    covariance = float(np.mean(command * reading))
    if deviations == 0.0 or abs(covariance) < min_correlation * deviations:
        return None
    return covariance / float(np.var(command)) / expected_gain


def _is_clipped(robot: Robot, records: Sequence[Record], axis: str) -> bool:
    """Return whether a voltage seems clipped in any record.

    If a command takes only a few values, a clipped voltage may look proportional to it. Therefore
    all records are considered.
    """
    for record in records:
        if not (record.has(axis, Tap.CMD) and record.has(axis, Tap.U)):
            continue
        model = robot.axes[axis]
        motion = SlowMotion.of(model, record, axis)
        expected_gain = _find_expected_gain(model, record, Tap.U)
        if motion is not None and expected_gain is not None:
            gain = _estimate_slow_gain(
                motion, record.signal(axis, Tap.U), expected_gain, _MIN_VOLTAGE_CORRELATION
            )
            if gain is None:
                return True
    return False


def _moves_with_another(record: Record, axis: str) -> bool:
    own_command = _remove_mean(record.signal(axis, Tap.CMD))
    for other in record.axes:
        if other != axis and record.has(other, Tap.CMD):
            command = _remove_mean(record.signal(other, Tap.CMD))
            norms = float(np.linalg.norm(own_command) * np.linalg.norm(command))
            if abs(float(own_command @ command)) > _MIN_COUPLED_CORRELATION * norms > 0.0:
                return True
    return False


def _remove_mean(signal: FloatArray) -> FloatArray:
    return np.asarray(signal - signal.mean())


def _check_voltage(labelled: LabelledRecord, axis: str, gain: float) -> None:
    if 1.0 / _MAX_PLAUSIBLE_GAIN <= gain <= _MAX_PLAUSIBLE_GAIN:
        return
    raise GapError(
        "{name}: {axis}.u is {gain} × cmd/gain, the output of the amplifier: this looks like "
        "a unit error, or a voltage before the amplifier; correct the column, leave it out, "
        "or correct the gain in the robot file",
        name=labelled.name,
        axis=axis,
        gain=format_rounded(gain, 4),
    )


@dataclass(frozen=True, slots=True)
class _UnitFactor:
    value: float
    text: str


def _list_factors(si_unit: str) -> Iterator[_UnitFactor]:
    for correct_unit, wrong_unit in permutations(units_of(si_unit), 2):
        value = per_si(wrong_unit) / per_si(correct_unit)
        text = message("gap", "{factor}, such as {wrong} read as {right}")
        yield _UnitFactor(
            value, text.fill(factor=format_rounded(value, 6), wrong=wrong_unit, right=correct_unit)
        )


def _match_unit_factor(gain: float, si_unit: str) -> _UnitFactor | None:
    matches: Mapping[float, _UnitFactor] = {
        abs(log(gain / factor.value)): factor
        for factor in _list_factors(si_unit)
        if gain > 0.0
        and abs(log(gain / factor.value))
        < (
            _LARGE_FACTOR_TOLERANCE_LOG
            if abs(log(factor.value)) > _LARGE_FACTOR_LOG
            else _SMALL_FACTOR_TOLERANCE_LOG
        )
    }
    return matches[min(matches)] if matches else None
