"""What the corrected model answers to new commands."""

from collections.abc import Iterator, Mapping

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.diagnosis import Offset
from rotemina.sim.gap.errors import GapError
from rotemina.sim.messages import message
from rotemina.sim.plant.assembly import assemble
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot, StepperAxis

_PREFIX = "predicted "  # of the metadata that say how a record came about
_OTHER_PREFIX = "simulated "
_ANSWERS = (Tap.U, Tap.REF, Tap.MEAS)

Offsets = Mapping[str, Mapping[Tap, Offset]]


def predict(
    robot: Robot,
    commands: Record,
    offsets: Offsets | None = None,
    *,
    after: Record | None = None,
    pause_s: float = 0.0,
) -> Record:
    """Return the record that a model predicts for commands, without noise, rounding and chance.

    The run starts as in a diagnosis: at rest at the first command, in the steady state of a
    periodic file, or for a record of unknown history at its first measurement. With ``after``, the
    run continues from the end of that motion, with its hysteresis and creep.

    Parameters
    ----------
    robot : Robot
        The corrected one: its effects act.
    commands : Record
        Its ``cmd`` (and ``add``; ``u`` of axes that a force moves) drive the model.
    offsets : mapping of axis to mapping of Tap to Offset, optional
        Constants by which the model is moved.
    after : Record, optional
        The motion that went before, ``pause_s`` seconds earlier; the last commands were held
        meanwhile.

    Returns
    -------
    Record
        ``cmd``, ``u`` (not of steppers), ``ref`` and ``meas`` of the axes of ``commands``. Its
        metadata are those of ``commands``, and what robot and effects it comes from.

    Raises
    ------
    GapError
        If an axis of the commands is none of the robot's, or in units of another quantity; if
        ``after`` lacks one of them.
    PlantError, EffectError
        If the model cannot be simulated.
    """
    _check_axes(robot, commands)
    whole = commands if after is None else _joined(robot, after, commands, pause_s)
    response = nominal_response(robot, whole)
    own = slice(len(whole.time_s) - len(commands.time_s), None)
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for axis in commands.axes:
        for tap in (Tap.CMD, Tap.ADD):
            if commands.has(axis, tap):
                signals[axis, tap] = commands.signal(axis, tap)
        for tap in _ANSWERS:
            if tap is not Tap.U or not isinstance(robot.axes[axis], StepperAxis):
                signals[axis, tap] = response.signal(axis, tap)[own]
                offset = (offsets or {}).get(axis, {}).get(tap)
                if offset is not None:
                    signals[axis, tap] = signals[axis, tap] + offset.value
    metadata = dict(_metadata(robot, commands))
    return Record.from_signals(commands.time_s, signals, commands.units, metadata)


def _joined(robot: Robot, after: Record, commands: Record, pause_s: float) -> Record:
    """Return one record of the previous motion, a pause and the commands.

    Measurements of the previous motion give the start of the run; the commands have none.
    """
    if not pause_s >= 0.0:
        raise GapError(
            message("gap", "pause = {pause_s} s: must be 0 s or more").fill(pause_s=pause_s)
        )
    missing = [axis for axis in commands.axes if axis not in after.axes]
    if missing:
        raise GapError(
            message(
                "gap",
                "axis {missing} of the commands: the motion before has {names}; name a record of "
                "all axes that are commanded",
            ).fill(missing=repr(missing[0]), names=", ".join(after.axes))
        )
    _check_axes(robot, after)
    if after.closed_loop != commands.closed_loop:
        raise GapError(
            message(
                "gap", "the motion before and the commands differ in mode; name a record of one"
            )
        )
    step_s = float(np.median(np.diff(after.time_s))) if len(after.time_s) > 1 else 0.0
    shift_s = float(after.time_s[-1]) + step_s + pause_s - float(commands.time_s[0])
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for axis in commands.axes:
        for tap in Tap:
            if after.has(axis, tap) or commands.has(axis, tap):
                parts = [
                    one.signal(axis, tap) if one.has(axis, tap) else np.zeros(len(one.time_s))
                    for one in (after, commands)
                ]
                signals[axis, tap] = np.concatenate(parts)
    metadata = dict(after.metadata)
    if after.history == "periodic":
        metadata["period_samples"] = str(after.period_samples or len(after.time_s))
    times = np.concatenate([after.time_s, commands.time_s + shift_s])
    return Record.from_signals(times, signals, commands.units, metadata)


def _check_axes(robot: Robot, commands: Record) -> None:
    for axis in commands.axes:
        if axis not in robot.axes:
            raise GapError(
                message(
                    "gap", "axis {axis} of the commands: the diagnosed robot {name} has {names}"
                ).fill(axis=repr(axis), name=repr(robot.name), names=", ".join(robot.axes))
            )
        unit = robot.unit(axis)
        if unit is not None and commands.units[axis] != unit:
            raise GapError(
                message(
                    "gap",
                    "axis {axis} of the commands is in units of {units}, but the diagnosed robot "
                    "{name} moves it in units of {unit}; correct the unit",
                ).fill(
                    axis=repr(axis), units=commands.units[axis], name=repr(robot.name), unit=unit
                )
            )


def _metadata(robot: Robot, commands: Record) -> Iterator[tuple[str, str]]:
    measured = any(commands.has(axis, tap) for axis in commands.axes for tap in _ANSWERS[1:])
    for key, value in commands.metadata.items():
        # A model that nothing measured tells where it was begins at rest.
        at_rest = key == "history" and value == "unknown" and not measured
        if not at_rest and not key.startswith((_PREFIX, _OTHER_PREFIX)):
            yield key, value
    yield f"{_PREFIX}by", "the corrected model of a gap diagnosis"
    yield f"{_PREFIX}robot", " ".join(robot.name.split())
    for number, one in enumerate(assemble(robot, commands.axes).effects, start=1):
        yield f"{_PREFIX}effect {number}", str(one)
