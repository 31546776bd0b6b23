"""Units of records: factors that no effect explains."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import log

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Caution, Labelled
from rotemina.sim.gap.intake.slow_motion import SlowMotion, follows_command, under_controller
from rotemina.sim.messages import message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Axis, PiezoAxis, Robot
from rotemina.sim.units import per_si, units_of

_ALIKE = 0.95  # correlation from which a reading follows its command
_PROPORTIONAL = 0.995  # the same for a voltage: one that is cut off by far follows less closely
_PLAUSIBLE = 3.0  # gains between this and its inverse may have other causes
_FAR = log(10.0)  # factors beyond this are no accident, even when a gain error comes on top
_NEAR_FAR, _NEAR = log(1.35), log(1.15)  # how closely far factors, and others, must be met
_TOGETHER = 0.9  # correlation of two axes' commands from which a gain may be a coupling's
_OUTSIDE = 1.0  # spans by which a command may lie outside its range
_SLACK = 1e-9  # spans by which it does so unnoticed
_HASTE = 30.0  # speed limits that the median speed may have


def check_scales(robot: Robot, one: Labelled, records: Sequence[Record]) -> Iterator[Caution]:
    """Check commands against limits, and readings against commands, in one of several records.

    A factor between two units of the axis is refused, and so are commands far beyond the range: to
    the model they are errors of gain, saturation or contact. Other unusual gains, and a reading of
    opposite sign, become cautions: strong coupling can cause them.

    Raises
    ------
    GapError
        With axis, factor and the units that would explain it.
    """
    for axis in one.record.axes:
        if one.record.has(axis, Tap.CMD):
            yield from _check_command(robot, one, axis)
            yield from _check_readings(robot, one, axis, records)


def _check_command(robot: Robot, one: Labelled, axis: str) -> Iterator[Caution]:
    described, command = robot.axes[axis], one.record.signal(axis, Tap.CMD)
    unit = one.record.units[axis]
    low, high = described.range
    outside = np.maximum(low - command, command - high)
    row = int(np.argmax(outside))
    bounds = message("gap", "{low} to {high}").fill(
        low=exact(low, unit, size=high), high=exact(high, unit)
    )
    if outside[row] > _OUTSIDE * described.span:
        raise GapError(
            message(
                "gap",
                "{name}: {axis}.cmd = {command} at row {row} is far outside the range {bounds} of "
                "robot {robot_name}: this looks like a unit error; correct the unit in the "
                "header, or the robot file",
            ).fill(
                name=one.name,
                axis=axis,
                command=exact(float(command[row]), unit),
                row=row + 1,
                bounds=bounds,
                robot_name=repr(robot.name),
            )
        )
    if outside[row] > _SLACK * described.span:
        yield one.caution(
            message(
                "gap",
                "A command of {value} is outside the range {low} to {high}; the model has "
                "no end stops.",
            ).fill(
                low=exact(low, unit, size=high),
                high=exact(high, unit),
                value=exact(float(command[row]), unit),
            ),
            axis,
        )
    speeds = np.abs(np.diff(command)) / np.diff(one.record.time_s)
    if described.max_speed is not None and np.median(speeds) > _HASTE * described.max_speed:
        raise GapError(
            message(
                "gap",
                "{name}: axis {axis} is commanded at {speed} {unit}/s, {times} × its speed "
                "limit: this looks like a unit error of time; correct the unit of t, such as ms "
                "for s",
            ).fill(
                name=one.name,
                axis=repr(axis),
                speed=rounded(np.median(speeds), 3),
                unit=unit,
                times=rounded(np.median(speeds) / described.max_speed, 3),
            )
        )


def _check_readings(
    robot: Robot, one: Labelled, axis: str, records: Sequence[Record]
) -> Iterator[Caution]:
    described = robot.axes[axis]
    motion = SlowMotion.of(described, one.record, axis)
    if motion is None:
        return
    for tap in (Tap.U, Tap.REF, Tap.MEAS):
        expected = _expected(described, one.record, tap)
        if expected is None or not one.record.has(axis, tap):
            continue
        alike = _PROPORTIONAL if tap is Tap.U else _ALIKE
        gain = _slow_gain(motion, one.record.signal(axis, tap), expected, alike)
        if gain is None:
            continue
        if tap is Tap.U:
            if not _is_cut_off(robot, records, axis):
                _check_voltage(one, axis, gain)
            continue
        factor = _unit_factor(abs(gain), one.record.units[axis])
        if factor is not None and not _moves_with_another(one.record, axis):
            raise GapError(
                message(
                    "gap",
                    "{name}: {axis}.{tap} is {gain} × what {axis}.cmd asks for: this looks like a "
                    "unit error, a factor of {text}; correct the unit of the column that is wrong",
                ).fill(name=one.name, axis=axis, tap=tap, gain=rounded(gain, 4), text=factor.text)
            )
        if factor is not None or abs(gain) > _PLAUSIBLE or gain < 0.0:
            yield one.caution(
                message(
                    "gap",
                    "The {tap} channel is {gain} × the command, which no single effect causes: "
                    "check signs, units and the gain in the robot file.",
                ).fill(tap=str(tap), gain=rounded(gain, 3)),
                axis,
            )


def _expected(described: Axis, record: Record, tap: Tap) -> float | None:
    """Return the expected slow signal for a command of 1, or None if unknown."""
    if tap is Tap.U:
        if not isinstance(described, PiezoAxis) or under_controller(described, record):
            return None
        return 1.0 / described.gain
    return 1.0 if follows_command(described, record) else None


def _slow_gain(
    motion: SlowMotion, signal: FloatArray, expected: float, alike: float
) -> float | None:
    """Return slow signal over expected one, or None where the one does not follow the other."""
    slow, read = motion.command, motion.read(signal)
    size = float(np.std(slow) * np.std(read))
    product = float(np.mean(slow * read))
    if size == 0.0 or abs(product) < alike * size:
        return None
    return product / float(np.var(slow)) / expected


def _is_cut_off(robot: Robot, records: Sequence[Record], axis: str) -> bool:
    """Tell whether a voltage follows its command but in part in any record.

    Then it does so in those whose command goes between a few places as well, though there it may
    seem to be in proportion.
    """
    for record in records:
        if not (record.has(axis, Tap.CMD) and record.has(axis, Tap.U)):
            continue
        described = robot.axes[axis]
        motion = SlowMotion.of(described, record, axis)
        expected = _expected(described, record, Tap.U)
        if motion is not None and expected is not None:
            gain = _slow_gain(motion, record.signal(axis, Tap.U), expected, _PROPORTIONAL)
            if gain is None:
                return True
    return False


def _moves_with_another(record: Record, axis: str) -> bool:
    """Tell whether the motion of another axis cannot be distinguished from the own command's."""
    own = _centred(record.signal(axis, Tap.CMD))
    for other in record.axes:
        if other != axis and record.has(other, Tap.CMD):
            command = _centred(record.signal(other, Tap.CMD))
            size = float(np.linalg.norm(own) * np.linalg.norm(command))
            if abs(float(own @ command)) > _TOGETHER * size > 0.0:
                return True
    return False


def _centred(signal: FloatArray) -> FloatArray:
    return np.asarray(signal - signal.mean())


def _check_voltage(one: Labelled, axis: str, gain: float) -> None:
    if 1.0 / _PLAUSIBLE <= gain <= _PLAUSIBLE:
        return
    raise GapError(
        message(
            "gap",
            "{name}: {axis}.u is {gain} × cmd/gain, the output of the amplifier: this looks like "
            "a unit error, or a voltage before the amplifier; correct the column, leave it out, "
            "or correct the gain in the robot file",
        ).fill(name=one.name, axis=axis, gain=rounded(gain, 4))
    )


@dataclass(frozen=True, slots=True)
class _Factor:
    """A factor between two units, and its text in a message."""

    value: float
    text: str


def _factors(si_unit: str) -> Iterator[_Factor]:
    for right, wrong in permutations(units_of(si_unit), 2):
        value = per_si(wrong) / per_si(right)
        text = message("gap", "{factor}, such as {wrong} read as {right}")
        yield _Factor(value, text.fill(factor=rounded(value, 6), wrong=wrong, right=right))


def _unit_factor(gain: float, si_unit: str) -> _Factor | None:
    """Return the unit factor that a gain meets, or None."""
    found: Mapping[float, _Factor] = {
        abs(log(gain / factor.value)): factor
        for factor in _factors(si_unit)
        if gain > 0.0
        and abs(log(gain / factor.value)) < (_NEAR_FAR if abs(log(factor.value)) > _FAR else _NEAR)
    }
    return found[min(found)] if found else None
