"""Sensors with a constant reading while their axis is commanded to move."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import BoolArray, FloatArray, IntArray
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Caution, Labelled
from rotemina.sim.messages import Message, message
from rotemina.sim.quantities import exact, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

_RUN_ROWS = 20  # equal readings in a row that count as standing still
_MOVED = 0.02  # of its span, that the command moves meanwhile
_MOVED_FLOORS = 20.0  # and noise floors
_MOVED_STEPS = 1.5  # and steps in which the reading moves at all
_ANSWERS_S = 0.05
_STUCK = 0.2  # of a record, for which a reading that stands still is a fault
_SATURATED = 0.05  # the same for one that returns to the same end again and again
_NEAR = 0.1  # of the record's span, from where a saturating reading comes and whereto it goes
_MEMORY = 0.25  # of a command's way, by which it may differ where a reading stops and goes on
_FOLLOWS = 0.5  # of a command's way, that the reference goes while the reading stands


class _Runs(NamedTuple):
    """Stretches of equal readings while the command moves.

    First rows, ends and values (k,), the way of the command, and its change from end to end.
    """

    begin: IntArray
    end: IntArray
    value: FloatArray
    way: FloatArray
    change: FloatArray

    @property
    def rows(self) -> IntArray:
        return self.end - self.begin

    def where(self, chosen: BoolArray) -> "_Runs":
        """Return some of them."""
        return _Runs(
            self.begin[chosen],
            self.end[chosen],
            self.value[chosen],
            self.way[chosen],
            self.change[chosen],
        )

    def of(self, value: float) -> "_Runs":
        """Return those at one value."""
        return self.where(self.value == value)


def check_sensors(robot: Robot, one: Labelled) -> Iterator[Caution]:
    """Check that readings change when their axis moves.

    A reading that stays the same to the last bit for long cannot belong to a moving axis; nor to a
    resting one whose sensor noise exceeds its resolution. Then the sensor is faulty, and the record
    is refused: the model would explain it as contact or saturation. If noise does not decide and no
    reference shows motion, the axis may really stand still: this becomes a caution. Dropouts, which
    start and end by jumps and are short, are an effect and pass.

    Raises
    ------
    GapError
        With axis, value and time.
    """
    for axis in one.record.axes:
        if one.record.has(axis, Tap.MEAS) and one.record.has(axis, Tap.CMD):
            yield from _check_sensor(robot, one, axis)


def _check_sensor(robot: Robot, one: Labelled, axis: str) -> Iterator[Caution]:
    record = one.record
    reading = record.signal(axis, Tap.MEAS)
    runs = _standing(robot, record, axis)
    for value, what in _faults(reading, runs):
        own = runs.of(value)
        stands = _reference_stands(record, axis, own)
        if stands and np.ptp(reading) > 0.0:
            continue
        stand = exact(value, record.units[axis])
        percent = rounded(100.0 * own.rows.sum() / len(reading), 3)
        if np.ptp(reading) == 0.0 or stands is False or _flickers(robot, axis):
            raise GapError(
                message(
                    "gap",
                    "{name}: {axis}.meas stands at exactly {stand} for {percent} % of the rows, "
                    "while the axis is commanded to move (first at t = {time_s} s): the sensor is "
                    "{what}; repair it, stay within what it can read, or leave the column out",
                ).fill(
                    name=one.name,
                    axis=axis,
                    stand=stand,
                    percent=percent,
                    time_s=rounded(record.time_s[own.begin[0]], 9),
                    what=what,
                )
            )
        yield one.caution(
            message(
                "gap",
                "The reading stays at exactly {stand} for {percent} % of the rows, while "
                "the axis is commanded to move: either the axis does not follow, or the "
                "sensor is {fault}. The records cannot distinguish the two.",
            ).fill(stand=stand, percent=percent, fault=what),
            axis,
        )


def _standing(robot: Robot, record: Record, axis: str) -> _Runs:
    """Return stretches of equal readings in which the command moves noticeably."""
    reading, command = record.signal(axis, Tap.MEAS), record.signal(axis, Tap.CMD)
    sensor = robot.axes[axis].sensor
    floor = sensor.noise_floor if sensor is not None else 0.0
    step = float(np.diff(np.unique(reading)).min(initial=np.inf))
    least = max(
        _MOVED * float(np.ptp(command)),
        _MOVED_FLOORS * floor,
        _MOVED_STEPS * step if np.isfinite(step) else 0.0,
    )
    edges = np.flatnonzero(np.diff(reading) != 0.0) + 1
    begin, end = np.append(0, edges), np.append(edges, len(reading))
    long = end - begin >= _RUN_ROWS
    begin, end = begin[long], end[long]
    # The last command of a hold may be the next one's, to which the axis has yet to answer.
    late = max(round(_ANSWERS_S / float(np.median(np.diff(record.time_s)))), 1)
    last = np.maximum(end - late, begin + 1)
    way = np.array([np.ptp(command[a:b]) for a, b in zip(begin, last, strict=True)])
    runs = _Runs(begin, end, reading[begin], way, np.abs(command[end - 1] - command[begin]))
    return runs.where((way >= least) & (least > 0.0))


def _faults(reading: FloatArray, runs: _Runs) -> Iterator[tuple[float, Message]]:
    """Give the value, and what seems to be wrong, for each fault."""
    for value in np.unique(runs.value):
        own = runs.of(value)
        if own.rows.max() >= _STUCK * len(reading):
            yield float(value), message("gap", "stuck or not connected")
        elif value in (reading.min(), reading.max()):
            saturated = own.rows[_comes_and_goes(reading, own)].sum()
            if saturated >= _SATURATED * len(reading):
                yield float(value), message("gap", "saturated")


def _comes_and_goes(reading: FloatArray, runs: _Runs) -> BoolArray:
    """Tell whether a reading reaches its end smoothly and leaves it at the same command.

    Dropouts jump, and effects with play, such as backlash, continue at another command.
    """
    near = _NEAR * float(np.ptp(reading))
    before = np.abs(reading[np.maximum(runs.begin - 1, 0)] - runs.value)
    after = np.abs(reading[np.minimum(runs.end, len(reading) - 1)] - runs.value)
    smooth = (before <= near) & (after <= near)
    return np.asarray(smooth & (runs.change <= _MEMORY * runs.way))


def _flickers(robot: Robot, axis: str) -> bool:
    """Tell whether noise would be visible even while the axis stands still."""
    sensor = robot.axes[axis].sensor
    return sensor is not None and sensor.noise_rms > 0.0 and sensor.noise_rms >= sensor.resolution


def _reference_stands(record: Record, axis: str, runs: _Runs) -> bool | None:
    """Whether the axis stood still as its reference saw it; None without one."""
    if not record.has(axis, Tap.REF):
        return None
    true = record.signal(axis, Tap.REF)
    ways = np.array([np.ptp(true[a:b]) for a, b in zip(runs.begin, runs.end, strict=True)])
    return not bool(np.any(ways > _FOLLOWS * runs.way))
