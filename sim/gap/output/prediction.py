"""Prediction of the response of the corrected model to new commands."""

from collections.abc import Iterator, Mapping

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import GapError
from rotemina.sim.gap.result import ModelOffset
from rotemina.sim.plant import assemble, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot, StepperAxis

# Prefixes of the metadata keys that state the origin of a record.
_PREDICTED_PREFIX = "predicted "
_SIMULATED_PREFIX = "simulated "
_PREDICTED_TAPS = (Tap.U, Tap.REF, Tap.MEAS)

Offsets = Mapping[str, Mapping[Tap, ModelOffset]]


def predict(
    robot: Robot,
    commands: Record,
    offsets: Offsets | None = None,
    *,
    after: Record | None = None,
    pause_s: float = 0.0,
) -> Record:
    """Return the record that a model predicts for commands, without any random effects or rounding.

    The run starts as in a diagnosis: at rest at the first command, in the steady state of a
    periodic record, or at the first measurement of a record with unknown history. With ``after``,
    the run continues from the end of that motion, with its hysteresis and creep.

    Parameters
    ----------
    robot : Robot
        The corrected robot, with its effects.
    commands : Record
        Record whose ``cmd`` and ``add`` channels drive the model, and also ``u`` for axes that are
        moved by a force.
    offsets : mapping of axis to mapping of Tap to ModelOffset, optional
        Constants that are added to the signals of the model.
    after : Record, optional
        The preceding motion, which ended ``pause_s`` before the commands. Its last commands are
        held in between.

    Returns
    -------
    Record
        ``cmd``, ``u`` (except for steppers), ``ref`` and ``meas`` of the axes of ``commands``. The
        metadata are those of ``commands``, with the robot and the effects of the model.

    Raises
    ------
    GapError
        If the robot lacks an axis of the commands, if an axis has units of another quantity, or if
        ``after`` lacks one of the axes.
    PlantError, EffectError
        If the model cannot be simulated.
    """
    _check_axes(robot, commands)
    run = commands if after is None else _join_records(robot, after, commands, pause_s)
    response = simulate_nominal_response(robot, run)
    command_rows = slice(len(run.time_s) - len(commands.time_s), None)
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for axis in commands.axes:
        for tap in (Tap.CMD, Tap.ADD):
            if commands.has(axis, tap):
                signals[axis, tap] = commands.signal(axis, tap)
        for tap in _PREDICTED_TAPS:
            if tap is not Tap.U or not isinstance(robot.axes[axis], StepperAxis):
                signals[axis, tap] = response.signal(axis, tap)[command_rows]
                offset = (offsets or {}).get(axis, {}).get(tap)
                if offset is not None:
                    signals[axis, tap] = signals[axis, tap] + offset.value
    metadata = dict(_list_metadata(robot, commands))
    return Record.from_signals(commands.time_s, signals, commands.units, metadata)


def _join_records(robot: Robot, after: Record, commands: Record, pause_s: float) -> Record:
    """Return one record of the previous motion, a pause and the commands.

    Measurements of the previous motion determine the start of the run. A channel that only one of
    the two records has is 0 in the other.
    """
    if not pause_s >= 0.0:
        raise GapError("pause = {pause_s} s: must be 0 s or more", pause_s=pause_s)
    missing_axes = [axis for axis in commands.axes if axis not in after.axes]
    if missing_axes:
        raise GapError(
            "axis {missing} of the commands is not in the previous motion, which has {names}; "
            "name a record of all commanded axes",
            missing=repr(missing_axes[0]),
            names=", ".join(after.axes),
        )
    _check_axes(robot, after)
    if after.closed_loop != commands.closed_loop:
        raise GapError(
            "the previous motion and the commands differ in mode; name a record of the same mode"
        )
    step_s = float(np.median(np.diff(after.time_s))) if len(after.time_s) > 1 else 0.0
    shift_s = float(after.time_s[-1]) + step_s + pause_s - float(commands.time_s[0])
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for axis in commands.axes:
        for tap in Tap:
            if after.has(axis, tap) or commands.has(axis, tap):
                parts = [
                    record.signal(axis, tap)
                    if record.has(axis, tap)
                    else np.zeros(len(record.time_s))
                    for record in (after, commands)
                ]
                signals[axis, tap] = np.concatenate(parts)
    metadata = dict(after.metadata)
    if after.history == "periodic":
        metadata["period_samples"] = str(after.period_samples or len(after.time_s))
    time_s = np.concatenate([after.time_s, commands.time_s + shift_s])
    return Record.from_signals(time_s, signals, commands.units, metadata)


def _check_axes(robot: Robot, commands: Record) -> None:
    for axis in commands.axes:
        if axis not in robot.axes:
            raise GapError(
                "axis {axis} of the commands is no axis of the diagnosed robot {name}, which "
                "has {names}",
                axis=repr(axis),
                name=repr(robot.name),
                names=", ".join(robot.axes),
            )
        unit = robot.unit(axis)
        if unit is not None and commands.units[axis] != unit:
            raise GapError(
                "axis {axis} of the commands is in units of {units}, but the diagnosed robot "
                "{name} moves it in units of {unit}; correct the unit",
                axis=repr(axis),
                units=commands.units[axis],
                name=repr(robot.name),
                unit=unit,
            )


def _list_metadata(robot: Robot, commands: Record) -> Iterator[tuple[str, str]]:
    is_measured = any(
        commands.has(axis, tap) for axis in commands.axes for tap in _PREDICTED_TAPS[1:]
    )
    for key, value in commands.metadata.items():
        # Without a measurement the start is unknown, so the model begins at rest.
        is_unknown_start = key == "history" and value == "unknown" and not is_measured
        if not is_unknown_start and not key.startswith((_PREDICTED_PREFIX, _SIMULATED_PREFIX)):
            yield key, value
    yield f"{_PREDICTED_PREFIX}by", "the corrected model of a gap diagnosis"
    yield f"{_PREDICTED_PREFIX}robot", " ".join(robot.name.split())
    for number, effect in enumerate(assemble(robot, commands.axes).effects, start=1):
        yield f"{_PREDICTED_PREFIX}effect {number}", str(effect)
