"""Samples for training and checking an inverse: commands and resulting positions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import exact, percent, rounded
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import PiezoAxis, Robot

_UNEVEN = 1e-3  # of a sample
_SEEN = 0.02  # of the range of a command: so near is a turning point of the greatest loop
_FEWEST = 200  # rows
_FEWEST_SWINGS = 4
_QUANTILE, _SAME = 0.15, 0.7  # so many swings are larger than such a share of the largest
_LEAST_TRAVEL = 0.05  # of the axis' range: less holds no loop to learn


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """One run of one axis, SI.

    Attributes
    ----------
    name : of the record, for messages.
    sample_s : from row to row.
    command, position : (n,)
        What the axis was told, and where it came.
    first : int
        Row from which on memory and offset are known: before, they are those of an unknown past.
    """

    name: str
    axis: str
    unit: str
    sample_s: float
    command: FloatArray
    position: FloatArray
    first: int = 0


def samples_of(robot: Robot, axis: str, record: Record, name: str = "record") -> Samples:
    """Return what a record holds of a piezo axis.

    The position is ``meas``, or ``ref`` where the record lacks it. In closed loop the command is
    what the controller put out, ``u`` times the axis' gain.

    Raises
    ------
    CompensationError
        If the axis is no piezo, its channels are missing, time is uneven or the record is short or
        moves too little.
    """
    said = robot.axes.get(axis)
    if not isinstance(said, PiezoAxis):
        piezos = [n for n, each in robot.axes.items() if isinstance(each, PiezoAxis)]
        raise CompensationError(
            message(
                "engine", "axis {axis}: robot {name} has no such piezo axis; use one of {value}"
            ).fill(
                axis=repr(axis),
                name=repr(robot.name),
                value=", ".join(piezos) or marked("engine", "another robot"),
            )
        )
    source = Tap.U if record.closed_loop else Tap.CMD
    taps = [tap for tap in (Tap.MEAS, Tap.REF) if record.has(axis, tap)]
    if not record.has(axis, source) or not taps:
        raise CompensationError(
            message(
                "engine",
                "{name}: axis {axis} needs the columns {axis}.{source} and {axis}.{meas} or "
                "{axis}.{ref}; record them, or name an axis that has them",
            ).fill(name=name, axis=axis, source=source, meas=Tap.MEAS, ref=Tap.REF)
        )
    command = record.signal(axis, source) * (said.gain if source is Tap.U else 1.0)
    sample_s = _sample_s(record.time_s, name)
    travel = float(np.ptp(command))
    if travel < _LEAST_TRAVEL * said.span:
        raise CompensationError(
            message(
                "engine",
                "{name}: axis {axis} is commanded over {travel}, less than {least_travel} of its "
                "range of {span}; record larger motions",
            ).fill(
                name=name,
                axis=axis,
                travel=exact(travel, record.units[axis]),
                least_travel=percent(_LEAST_TRAVEL),
                span=exact(said.span, record.units[axis]),
            )
        )
    position = record.signal(axis, taps[0])
    first = _known_from(command) if record.history == "unknown" else 0
    return Samples(name, axis, record.units[axis], sample_s, command, position, first)


def _sample_s(time_s: FloatArray, name: str) -> float:
    if len(time_s) < _FEWEST:
        raise CompensationError(
            message("engine", "{name}: {count} rows are too few; {fewest} are needed").fill(
                name=name, count=len(time_s), fewest=_FEWEST
            )
        )
    lengths = np.diff(time_s)
    sample_s = float(np.median(lengths))
    uneven = np.abs(lengths - sample_s) > _UNEVEN * sample_s
    if uneven.any():
        row = int(np.argmax(uneven)) + 1
        raise CompensationError(
            message(
                "engine",
                "{name}: row {row} comes {lengths} s after the previous one, others "
                "{sample_s} s; an inverse needs evenly spaced rows: resample the record "
                "(rotemina convert)",
            ).fill(
                name=name,
                row=row,
                lengths=rounded(lengths[row - 1], 6),
                sample_s=rounded(sample_s, 6),
            )
        )
    return sample_s


def _known_from(command: FloatArray) -> int:
    """Return the row by which the greatest loop has been run through: it wipes the past out."""
    near = _SEEN * float(np.ptp(command))
    high = int(np.argmax(command >= command.max() - near))
    low = int(np.argmax(command <= command.min() + near))
    return max(high, low)


def one_size(samples: Sequence[Samples]) -> bool:
    """Return whether nearly all swings of the commands are of one size.

    Then they cannot tell how a loop grows with its size, nor apart what comes late and what turns
    late: an inverse rich enough to follow that loop would only guess at others.
    """
    swings = np.concatenate([_swings(each.command[each.first :]) for each in samples])
    return len(swings) < _FEWEST_SWINGS or bool(
        np.quantile(swings, _QUANTILE) > _SAME * swings.max()
    )


def _swings(command: FloatArray) -> FloatArray:
    """Return the ways (s,) between turning points, small wiggles left aside."""
    least = _SEEN * float(np.ptp(command))
    turns = [float(command[0])]
    for value in command[1:]:
        way = float(value) - turns[-1]
        onward = len(turns) > 1 and way * (turns[-1] - turns[-2]) > 0.0
        if onward:
            turns[-1] = float(value)
        elif abs(way) > least:
            turns.append(float(value))
    return np.abs(np.diff(turns))


def common(samples: Sequence[Samples]) -> Samples:
    """Return the first of the samples, after a check that all are of one axis and rate."""
    if not samples:
        raise CompensationError(
            message("engine", "there is no record to train on; name at least one")
        )
    first = samples[0]
    for each in samples[1:]:
        if abs(each.sample_s - first.sample_s) > _UNEVEN * first.sample_s:
            raise CompensationError(
                message(
                    "engine",
                    "{name}: its rows come every {sample_s} s, those of {first_name} every "
                    "{first_sample_s} s; resample them to one rate (rotemina convert)",
                ).fill(
                    name=each.name,
                    sample_s=rounded(each.sample_s, 6),
                    first_name=first.name,
                    first_sample_s=rounded(first.sample_s, 6),
                )
            )
    return first
