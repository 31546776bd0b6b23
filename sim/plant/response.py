"""A robot's response to a record's commands, with what came before its first row."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.fine_rows import respond
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run import Run
from rotemina.sim.plant.run_start import measured_start, steady_start
from rotemina.sim.plant.state import Behind, Motion
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import ForceAxis, Robot, StepperAxis


@dataclass(frozen=True, slots=True, eq=False)
class Response:
    """What the model answers: one (n,) array per axis and tap, SI.

    ``signals`` maps (axis, tap) for the taps ``u`` (not of steppers), ``ref`` and ``meas``.
    """

    time_s: FloatArray
    signals: Mapping[tuple[str, Tap], FloatArray]
    velocity: Mapping[str, FloatArray]

    def signal(self, axis: str, tap: Tap) -> FloatArray:
        """Return one modelled tap (n,), SI; KeyError if the model has none."""
        return self.signals[axis, tap]


def nominal_response(robot: Robot, record: Record, *, drive: Tap = Tap.CMD) -> Response:
    """Simulate a robot, with the effects that its file gives it, over the commands of ``record``.

    The axes of the record, and those that a coupling joins to them, are simulated; the latter are
    commanded to the middle of their range and stay there but for what the coupling does.

    Parameters
    ----------
    robot : Robot
    record : Record
        Its ``history`` decides how the run starts: at rest, from the first measured samples
        (``unknown``), or in the steady state (``periodic``).
    drive : {Tap.CMD, Tap.U}
        ``CMD``: by the commands; in a closed-loop record, axes with a controller are under it.
        ``U``: the part behind the amplifier, by the measured ``u``, every loop open and effects
        of the electronics left out; steppers, which have no ``u``, by their commands.

    Raises
    ------
    PlantError
        If the record names an axis that the robot lacks, has no command of one, lacks a ``u``
        that is needed, or has no steady state although it is periodic.
    """
    check_axes(robot, record)
    plant = Plant.of(robot, closed_loop=record.closed_loop and drive is Tap.CMD, only=record.axes)
    run = run_of(plant, record, drive)
    if record.history == "periodic":
        state = steady_start(plant, run, record.period_samples)
    elif record.history == "unknown":
        state = measured_start(plant, record, run)
    else:
        state = plant.at_rest(run.time_s[0], run.command[0])
    behind = Behind.AMPLIFIER if drive is Tap.U else Behind.COMMAND
    motion = respond(plant, state, run, behind)
    return _response(plant, record, motion)


def check_axes(robot: Robot, record: Record) -> None:
    """Raise :class:`PlantError` if a record names an unknown axis, or gives one no command."""
    for axis in record.axes:
        if axis not in robot.axes:
            known = ", ".join(robot.axes)
            raise PlantError(
                message("engine", "axis {axis} of the record: robot {name} has only {known}").fill(
                    axis=repr(axis), name=repr(robot.name), known=known
                )
            )
        if not record.has(axis, Tap.CMD):
            raise PlantError(
                message(
                    "engine",
                    "axis {quoted} of the record: it has no {axis}.cmd column to drive the model",
                ).fill(quoted=repr(axis), axis=axis)
            )


def run_of(plant: Plant, record: Record, drive: Tap = Tap.CMD) -> Run:
    """Return what a record drives a plant with; axes that it lacks rest in mid-range."""
    rows = len(record.time_s)
    middle = [sum(axis.range) / 2.0 for axis in plant.robot.axes.values()]
    command, add = np.tile(middle, (rows, 1)), np.zeros((rows, len(plant.axes)))
    for column, name in enumerate(plant.axes):
        if record.has(name, Tap.CMD):
            command[:, column] = record.signal(name, Tap.CMD)
        if record.has(name, Tap.ADD):
            add[:, column] = record.signal(name, Tap.ADD)
    inputs = plant.open_loop_inputs(command)
    for column, name in enumerate(plant.axes):
        if plant.loops[column] is None:
            inputs[:, column] = _inputs(plant, record, name, drive, inputs[:, column])
    return Run(record.time_s, command, add, inputs)


def _inputs(
    plant: Plant, record: Record, name: str, drive: Tap, asked: FloatArray
) -> FloatArray | float:
    """Return the inputs (n,) of an axis without a closed loop."""
    axis = plant.robot.axes[name]
    if name not in record.axes:
        return axis.force_offset / axis.gain if isinstance(axis, ForceAxis) else asked
    by_voltage = isinstance(axis, ForceAxis) or drive is Tap.U
    if isinstance(axis, StepperAxis) or not by_voltage:
        return asked
    if record.has(name, Tap.U):
        return record.signal(name, Tap.U)
    reason = "is moved by a force" if isinstance(axis, ForceAxis) else "is to be driven by its u"
    raise PlantError(
        message(
            "engine",
            "axis {quoted} {reason}: an open-loop run needs a {axis}.u column in the record ('# "
            "mode: closed_loop' and a controller in the robot file do without)",
        ).fill(quoted=repr(name), reason=reason, axis=name)
    )


def _response(plant: Plant, record: Record, motion: Motion) -> Response:
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, name in enumerate(plant.axes):
        if name not in record.axes:
            continue
        if not isinstance(plant.robot.axes[name], StepperAxis):
            signals[name, Tap.U] = motion.inputs[:, column]
        signals[name, Tap.REF] = motion.position[:, column]
        signals[name, Tap.MEAS] = motion.reading[:, column]
    velocity = {name: motion.velocity[:, plant.axes.index(name)] for name in record.axes}
    return Response(record.time_s, signals, velocity)
