"""Samples for training and checking an inverse: commands and resulting positions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import CompensationError
from rotemina.sim.messages import format_rounded, marked
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import PiezoAxis, Robot
from rotemina.sim.units import format_exact, format_percent

# An interval may deviate from the usual one by this share.
_MAX_UNEVENNESS_RATIO = 1e-3
# A command this close to its extreme, as a share of its range, is at a turning point of the largest
# loop.
_TURNING_POINT_SHARE = 0.02
_MIN_ROWS = 200
_MIN_SWINGS = 4
# The swings have one size if this quantile of them is larger than this share of the largest swing.
_SMALL_SWING_QUANTILE, _MIN_SIZE_RATIO = 0.15, 0.7
# Commands over a smaller share of the axis' range show no loop to learn.
_MIN_TRAVEL_SHARE = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class TrainingSamples:
    """One run of one axis, SI.

    Attributes
    ----------
    name : of the record, for messages.
    axis, unit : the axis, and "m" or "rad".
    sample_s : interval of the rows.
    command, position : (n,)
        Commanded and resulting positions.
    first : int
        First row with a known history and offset. Earlier rows depend on an unknown past.
    """

    name: str
    axis: str
    unit: str
    sample_s: float
    command: FloatArray
    position: FloatArray
    first: int = 0


def read_samples(robot: Robot, axis: str, record: Record, name: str = "record") -> TrainingSamples:
    """Return the samples of a piezo axis in a record.

    The position is ``meas``, or ``ref`` where the record lacks it. In closed loop the command is
    the output of the controller, ``u`` times the axis' gain.

    Raises
    ------
    CompensationError
        If the axis is not a piezo, its channels are missing, the rows are uneven, the record is too
        short, or the axis moves too little.
    """
    axis_model = robot.axes.get(axis)
    if not isinstance(axis_model, PiezoAxis):
        piezos = [n for n, model in robot.axes.items() if isinstance(model, PiezoAxis)]
        raise CompensationError(
            "axis {axis}: robot {name} has no such piezo axis; use one of {value}",
            axis=repr(axis),
            name=repr(robot.name),
            value=", ".join(piezos) or marked("engine", "another robot"),
        )
    command_tap = Tap.U if record.closed_loop else Tap.CMD
    taps = [tap for tap in (Tap.MEAS, Tap.REF) if record.has(axis, tap)]
    if not record.has(axis, command_tap) or not taps:
        raise CompensationError(
            "{name}: axis {axis} needs the columns {axis}.{source} and {axis}.{meas} or "
            "{axis}.{ref}; record them, or name an axis that has them",
            name=name,
            axis=axis,
            source=command_tap,
            meas=Tap.MEAS,
            ref=Tap.REF,
        )
    command = record.signal(axis, command_tap) * (axis_model.gain if command_tap is Tap.U else 1.0)
    sample_s = _find_sample_s(record.time_s, name)
    travel = float(np.ptp(command))
    if travel < _MIN_TRAVEL_SHARE * axis_model.span:
        raise CompensationError(
            "{name}: axis {axis} is commanded over {travel}, less than {least_travel} of its "
            "range of {span}; record larger motions",
            name=name,
            axis=axis,
            travel=format_exact(travel, record.units[axis]),
            least_travel=format_percent(_MIN_TRAVEL_SHARE),
            span=format_exact(axis_model.span, record.units[axis]),
        )
    position = record.signal(axis, taps[0])
    first_known = _find_first_known_row(command) if record.history == "unknown" else 0
    return TrainingSamples(name, axis, record.units[axis], sample_s, command, position, first_known)


def _find_sample_s(time_s: FloatArray, name: str) -> float:
    if len(time_s) < _MIN_ROWS:
        raise CompensationError(
            "{name}: {count} rows are too few; {fewest} are needed",
            name=name,
            count=len(time_s),
            fewest=_MIN_ROWS,
        )
    intervals_s = np.diff(time_s)
    sample_s = float(np.median(intervals_s))
    is_uneven = np.abs(intervals_s - sample_s) > _MAX_UNEVENNESS_RATIO * sample_s
    if is_uneven.any():
        row = int(np.argmax(is_uneven)) + 1
        raise CompensationError(
            "{name}: row {row} comes {lengths} s after the previous one, others "
            "{sample_s} s; an inverse needs evenly spaced rows: resample the record "
            "(rotemina convert)",
            name=name,
            row=row,
            lengths=format_rounded(intervals_s[row - 1], 6),
            sample_s=format_rounded(sample_s, 6),
        )
    return sample_s


def _find_first_known_row(command: FloatArray) -> int:
    """Return the row at which the largest loop is complete, which erases the earlier history."""
    margin = _TURNING_POINT_SHARE * float(np.ptp(command))
    high = int(np.argmax(command >= command.max() - margin))
    low = int(np.argmax(command <= command.min() + margin))
    return max(high, low)


def have_one_size(samples: Sequence[TrainingSamples]) -> bool:
    """Return whether nearly all swings of the commands have the same size.

    Such swings do not show how a loop grows with its size, and they do not separate lag from
    hysteresis. An inverse that is flexible enough to follow this loop would only guess at others.
    """
    swings = np.concatenate([_find_swings(run.command[run.first :]) for run in samples])
    return len(swings) < _MIN_SWINGS or bool(
        np.quantile(swings, _SMALL_SWING_QUANTILE) > _MIN_SIZE_RATIO * swings.max()
    )


def _find_swings(command: FloatArray) -> FloatArray:
    """Return the distances (s,) between turning points, without small reversals."""
    min_swing = _TURNING_POINT_SHARE * float(np.ptp(command))
    turning_points = [float(command[0])]
    for value in command[1:]:
        distance = float(value) - turning_points[-1]
        is_same_direction = (
            len(turning_points) > 1 and distance * (turning_points[-1] - turning_points[-2]) > 0.0
        )
        if is_same_direction:
            turning_points[-1] = float(value)
        elif abs(distance) > min_swing:
            turning_points.append(float(value))
    return np.abs(np.diff(turning_points))


def check_common_rate(samples: Sequence[TrainingSamples]) -> TrainingSamples:
    """Return the first of the samples, after a check that all have the same rate."""
    if not samples:
        raise CompensationError("there is no record to train on; name at least one")
    first = samples[0]
    for run in samples[1:]:
        if abs(run.sample_s - first.sample_s) > _MAX_UNEVENNESS_RATIO * first.sample_s:
            raise CompensationError(
                "{name}: its rows come every {sample_s} s, those of {first_name} every "
                "{first_sample_s} s; resample them to one rate (rotemina convert)",
                name=run.name,
                sample_s=format_rounded(run.sample_s, 6),
                first_name=first.name,
                first_sample_s=format_rounded(first.sample_s, 6),
            )
    return first
