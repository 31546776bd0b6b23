"""Checks whether records can be diagnosed, before anything is fitted.

Records that would lead to a confident but wrong answer are refused, with a remedy; limits of the
answer become cautions. An axis that never moved is no error: effects that act without motion still
show, and otherwise the verdict is insufficient excitation.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.intake.cautions import Caution, Labelled
from rotemina.sim.gap.intake.channel_check import check_following
from rotemina.sim.gap.intake.clocks import check_clock
from rotemina.sim.gap.intake.duplicate_records import check_copies
from rotemina.sim.gap.intake.stuck_sensor import check_sensors
from rotemina.sim.gap.intake.time_leaps import LEAST_ROWS, check_leaps, default_names, pieces
from rotemina.sim.gap.intake.unit_factors import check_scales
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import ForceAxis, Robot

_MEASURED = (Tap.U, Tap.REF, Tap.MEAS)


def check(
    robot: Robot, records: Sequence[Record], names: Sequence[str] = ()
) -> tuple[Caution, ...]:
    """Check records, and the robot that they should belong to.

    Parameters
    ----------
    robot : Robot
    records : sequence of Record
    names : sequence of str, optional
        What messages call the records; by default their number, from 1, and length.

    Returns
    -------
    tuple of Caution
        What a diagnosis says of an axis is made of them by
        :func:`~rotemina.sim.gap.intake.cautions.remarks`.

    Raises
    ------
    GapError
        With record, axis, value, bound and what to do.
    """
    if not records:
        raise GapError(message("gap", "no record was given; name at least one"))
    called = names or default_names(records)
    cautions = list(check_leaps(records, called))
    labelled = pieces(records, called)
    whole = [one.record for one in labelled]
    for one in labelled:
        _check_fit(robot, one)
        cautions += check_clock(one)
        cautions += check_scales(robot, one, whole)
        cautions += check_sensors(robot, one)
        check_following(robot, one)
    check_copies(labelled)
    if not any(_is_measured(one.record, axis) for one in labelled for axis in one.record.axes):
        raise GapError(
            message(
                "gap",
                "{listed}: no measured channel (u, ref or meas) but only commands; give records "
                "of the real machine",
            ).fill(listed=_listed(labelled))
        )
    cautions += _missing(robot, records)
    return tuple(cautions)


def _listed(records: Sequence[Labelled]) -> str:
    return ", ".join(one.name for one in records)


def _check_fit(robot: Robot, one: Labelled) -> None:
    record = one.record
    for axis in record.axes:
        if axis not in robot.axes:
            raise GapError(
                message(
                    "gap",
                    "{name}: robot {robot_name} has no axis {axis}; its axes are {names}; name "
                    "the right robot by --robot",
                ).fill(
                    name=one.name,
                    robot_name=repr(robot.name),
                    axis=repr(axis),
                    names=", ".join(robot.axes),
                )
            )
        unit = robot.unit(axis)
        if unit is not None and record.units[axis] != unit:
            raise GapError(
                message(
                    "gap",
                    "{name}: axis {axis} is in units of {units}, but robot {robot_name} moves it "
                    "in units of {unit}; correct the unit",
                ).fill(
                    name=one.name,
                    axis=repr(axis),
                    units=record.units[axis],
                    robot_name=repr(robot.name),
                    unit=unit,
                )
            )
        if not record.has(axis, Tap.CMD):
            raise GapError(
                message(
                    "gap",
                    "{name}: axis {quoted} has no {axis}.cmd column to drive the model; add it",
                ).fill(name=one.name, quoted=repr(axis), axis=axis)
            )
        _check_drive(robot, one, axis)
    if len(record.time_s) < LEAST_ROWS:
        raise GapError(
            message(
                "gap",
                "{name}: {count} rows; a diagnosis needs {least_rows} rows or more in each "
                "record: leave it out, or record longer",
            ).fill(name=one.name, count=len(record.time_s), least_rows=LEAST_ROWS)
        )


def _check_drive(robot: Robot, one: Labelled, axis: str) -> None:
    described = robot.axes[axis]
    if not isinstance(described, ForceAxis) or one.record.has(axis, Tap.U):
        return
    if one.record.closed_loop and described.controller is not None:
        return
    raise GapError(
        message(
            "gap",
            "{name}: axis {quoted} is moved by a force, and no {axis}.u column tells which: add "
            "it, or write '# mode: closed_loop' and give the robot file its controller",
        ).fill(name=one.name, quoted=repr(axis), axis=axis)
    )


def _is_measured(record: Record, axis: str) -> bool:
    return any(record.has(axis, tap) for tap in _MEASURED)


def _missing(robot: Robot, records: Sequence[Record]) -> Iterator[Caution]:
    """Tell which axes were not measured, or not moved, and which taps are missing."""
    for axis in robot.axes:
        own = [record for record in records if axis in record.axes]
        taps = {tap for record in own for tap in Tap if record.has(axis, tap)}
        if not own:
            continue
        if not taps & set(_MEASURED):
            said = message("gap", "The axis was commanded but not measured: it is not diagnosed.")
            yield Caution(said, axis)
            continue
        if all(np.ptp(record.signal(axis, Tap.CMD)) == 0.0 for record in own):
            said = message(
                "gap",
                "The axis was never commanded to move: only effects without motion are visible.",
            )
            yield Caution(said, axis)
        if Tap.MEAS not in taps:
            said = message("gap", "The axis' own sensor was not recorded: it is not diagnosed.")
            yield Caution(said, axis)
        elif Tap.REF not in taps:
            said = message(
                "gap",
                "No independent reference (ref) was recorded: effects of the sensor cannot "
                "be distinguished from those of the axis.",
            )
            yield Caution(said, axis)
