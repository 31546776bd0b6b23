"""Check whether records can be diagnosed, before anything is fitted.

Records that would lead to a confident but wrong answer are refused, with a remedy. Limits of the
answer become cautions. An axis that never moved is not an error: effects that act without motion
are still visible, and otherwise the verdict is insufficient excitation.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from rotemina.sim.errors import GapError
from rotemina.sim.gap.intake.cautions import LabelledRecord, RecordCaution
from rotemina.sim.gap.intake.channel_check import check_following
from rotemina.sim.gap.intake.clocks import check_clock
from rotemina.sim.gap.intake.duplicate_records import check_duplicates
from rotemina.sim.gap.intake.stuck_sensor import check_sensors
from rotemina.sim.gap.intake.time_leaps import (
    MIN_ROWS,
    check_leaps,
    make_default_names,
    split_at_leaps,
)
from rotemina.sim.gap.intake.unit_factors import check_units
from rotemina.sim.messages import message
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import ForceAxis, Robot

_MEASURED_TAPS = (Tap.U, Tap.REF, Tap.MEAS)


def check_records(
    robot: Robot, records: Sequence[Record], names: Sequence[str] = ()
) -> tuple[RecordCaution, ...]:
    """Check records against the robot from which they should come.

    Parameters
    ----------
    robot : Robot
    records : sequence of Record
    names : sequence of str, optional
        Names of the records in messages; by default their number, from 1, and length.

    Returns
    -------
    tuple of RecordCaution
        :func:`~rotemina.sim.gap.intake.collect_remarks` selects those about one axis.

    Raises
    ------
    GapError
        If a record cannot be diagnosed. The message names the record, the axis, the value and its
        bound, and says what to do.
    """
    if not records:
        raise GapError("no record was given; name at least one")
    labels = names or make_default_names(records)
    cautions = list(check_leaps(records, labels))
    labelled = split_at_leaps(records, labels)
    record_pieces = [piece.record for piece in labelled]
    for piece in labelled:
        _check_axes(robot, piece)
        cautions += check_clock(piece)
        cautions += check_units(robot, piece, record_pieces)
        cautions += check_sensors(robot, piece)
        check_following(robot, piece)
    check_duplicates(labelled)
    if not any(
        _is_measured(piece.record, axis) for piece in labelled for axis in piece.record.axes
    ):
        raise GapError(
            "{listed}: no measured channel (u, ref or meas) but only commands; give records "
            "of the real machine",
            listed=_list_names(labelled),
        )
    cautions += _warn_of_missing_channels(robot, records)
    return tuple(cautions)


def _list_names(records: Sequence[LabelledRecord]) -> str:
    return ", ".join(labelled.name for labelled in records)


def _check_axes(robot: Robot, labelled: LabelledRecord) -> None:
    record = labelled.record
    for axis in record.axes:
        if axis not in robot.axes:
            raise GapError(
                "{name}: robot {robot_name} has no axis {axis}; its axes are {names}; "
                "select the right robot with --robot",
                name=labelled.name,
                robot_name=repr(robot.name),
                axis=repr(axis),
                names=", ".join(robot.axes),
            )
        unit = robot.unit(axis)
        if unit is not None and record.units[axis] != unit:
            raise GapError(
                "{name}: axis {axis} is in units of {units}, but robot {robot_name} moves it "
                "in units of {unit}; correct the unit",
                name=labelled.name,
                axis=repr(axis),
                units=record.units[axis],
                robot_name=repr(robot.name),
                unit=unit,
            )
        if not record.has(axis, Tap.CMD):
            raise GapError(
                "{name}: axis {quoted} has no {axis}.cmd column to drive the model; add it",
                name=labelled.name,
                quoted=repr(axis),
                axis=axis,
            )
        _check_drive(robot, labelled, axis)
    if len(record.time_s) < MIN_ROWS:
        raise GapError(
            "{name}: {count} rows; a diagnosis needs {least_rows} rows or more in each "
            "record: leave it out, or record longer",
            name=labelled.name,
            count=len(record.time_s),
            least_rows=MIN_ROWS,
        )


def _check_drive(robot: Robot, labelled: LabelledRecord, axis: str) -> None:
    model = robot.axes[axis]
    if not isinstance(model, ForceAxis) or labelled.record.has(axis, Tap.U):
        return
    if labelled.record.closed_loop and model.controller is not None:
        return
    raise GapError(
        "{name}: axis {quoted} is moved by a force, but there is no {axis}.u column: add it, "
        "or write '# mode: closed_loop' and add the controller to the robot file",
        name=labelled.name,
        quoted=repr(axis),
        axis=axis,
    )


def _is_measured(record: Record, axis: str) -> bool:
    return any(record.has(axis, tap) for tap in _MEASURED_TAPS)


def _warn_of_missing_channels(robot: Robot, records: Sequence[Record]) -> Iterator[RecordCaution]:
    for axis in robot.axes:
        own_records = [record for record in records if axis in record.axes]
        taps = {tap for record in own_records for tap in Tap if record.has(axis, tap)}
        if not own_records:
            continue
        if not taps & set(_MEASURED_TAPS):
            text = message("gap", "The axis was commanded but not measured: it is not diagnosed.")
            yield RecordCaution(text, axis)
            continue
        if all(np.ptp(record.signal(axis, Tap.CMD)) == 0.0 for record in own_records):
            text = message(
                "gap",
                "The axis was never commanded to move: only effects without motion are visible.",
            )
            yield RecordCaution(text, axis)
        if Tap.MEAS not in taps:
            text = message("gap", "The axis' own sensor was not recorded: it is not diagnosed.")
            yield RecordCaution(text, axis)
        elif Tap.REF not in taps:
            text = message(
                "gap",
                "No independent reference (ref) was recorded: effects of the sensor cannot "
                "be distinguished from those of the axis.",
            )
            yield RecordCaution(text, axis)
