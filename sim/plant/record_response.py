"""Response of a robot to a record's commands, with the state before its first row."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import PlantError
from rotemina.sim.plant.fine_rows import compute_motion
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.run_start import estimate_start, find_steady_start
from rotemina.sim.plant.state import ChainPoint, PlantMotion, RunCommands
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    ForceAxis,
    Robot,
    StepperAxis,
)


@dataclass(frozen=True, slots=True, eq=False)
class ModelResponse:
    """Response of the model: one (n,) array per axis and tap, SI.

    ``signals`` maps (axis, tap) for the taps ``u`` (not of steppers), ``ref`` and ``meas``.
    """

    time_s: FloatArray
    signals: Mapping[tuple[str, Tap], FloatArray]
    velocity: Mapping[str, FloatArray]

    def signal(self, axis: str, tap: Tap) -> FloatArray:
        """Return one modelled tap (n,), SI.

        Raises
        ------
        KeyError
            If the model has no such tap.
        """
        return self.signals[axis, tap]


def simulate_nominal_response(
    robot: Robot, record: Record, *, drive: Tap = Tap.CMD
) -> ModelResponse:
    """Simulate a robot with the effects of its file over the commands of ``record``.

    The axes of the record are simulated, and those that a coupling joins to them. The latter are
    commanded to the middle of their range and move only by the coupling.

    Parameters
    ----------
    robot : Robot
    record : Record
        Its ``history`` decides how the run starts: at rest, from the first measured samples
        (``unknown``), or in the steady state (``periodic``).
    drive : {Tap.CMD, Tap.U}
        ``CMD``: the commands drive the model; in a closed-loop record, the controllers of the axes
        are active. ``U``: the measured ``u`` drives the part behind the amplifier, with every loop
        open and without effects of the electronics; steppers, which have no ``u``, follow their
        commands.

    Raises
    ------
    PlantError
        If the record names an axis that the robot lacks, has no command for an axis, lacks a ``u``
        that is needed, or has no steady state although it is periodic.
    """
    check_axes(robot, record)
    plant = Plant.of(robot, closed_loop=record.closed_loop and drive is Tap.CMD, only=record.axes)
    run = make_run(plant, record, drive)
    if record.history == "periodic":
        state = find_steady_start(plant, run, record.period_samples)
    elif record.history == "unknown":
        state = estimate_start(plant, record, run)
    else:
        state = plant.find_rest_state(run.time_s[0], run.command[0])
    behind = ChainPoint.AMPLIFIER if drive is Tap.U else ChainPoint.COMMAND
    motion = compute_motion(plant, state, run, behind)
    return _collect_response(plant, record, motion)


def check_axes(robot: Robot, record: Record) -> None:
    """Check that the robot has all axes of a record, and that each has a command.

    Raises
    ------
    PlantError
        If the robot lacks an axis or an axis has no command; the message names the axis.
    """
    for axis in record.axes:
        if axis not in robot.axes:
            known_axes = ", ".join(robot.axes)
            raise PlantError(
                "axis {axis} of the record: robot {name} has only {known}",
                axis=repr(axis),
                name=repr(robot.name),
                known=known_axes,
            )
        if not record.has(axis, Tap.CMD):
            raise PlantError(
                "axis {quoted} of the record: it has no {axis}.cmd column to drive the model",
                quoted=repr(axis),
                axis=axis,
            )


def make_run(plant: Plant, record: Record, drive: Tap = Tap.CMD) -> RunCommands:
    """Return the inputs of a plant from a record; axes without a command rest in mid-range."""
    rows = len(record.time_s)
    mid_range = [sum(axis.range) / 2.0 for axis in plant.robot.axes.values()]
    command, add = np.tile(mid_range, (rows, 1)), np.zeros((rows, len(plant.axes)))
    for column, name in enumerate(plant.axes):
        if record.has(name, Tap.CMD):
            command[:, column] = record.signal(name, Tap.CMD)
        if record.has(name, Tap.ADD):
            add[:, column] = record.signal(name, Tap.ADD)
    inputs = plant.compute_open_loop_inputs(command)
    for column, name in enumerate(plant.axes):
        if plant.loops[column] is None:
            inputs[:, column] = _find_inputs(plant, record, name, drive, inputs[:, column])
    return RunCommands(record.time_s, command, add, inputs)


def _find_inputs(
    plant: Plant, record: Record, name: str, drive: Tap, requested: FloatArray
) -> FloatArray | float:
    """Return the inputs (n,) of an axis without a closed loop."""
    axis = plant.robot.axes[name]
    if name not in record.axes:
        return axis.force_offset / axis.gain if isinstance(axis, ForceAxis) else requested
    is_voltage_driven = isinstance(axis, ForceAxis) or drive is Tap.U
    if isinstance(axis, StepperAxis) or not is_voltage_driven:
        return requested
    if record.has(name, Tap.U):
        return record.signal(name, Tap.U)
    reason = "is moved by a force" if isinstance(axis, ForceAxis) else "is to be driven by its u"
    raise PlantError(
        "axis {quoted} {reason}: an open-loop run needs a {axis}.u column in the record; add "
        "it, or use '# mode: closed_loop' and a controller in the robot file",
        quoted=repr(name),
        reason=reason,
        axis=name,
    )


def _collect_response(plant: Plant, record: Record, motion: PlantMotion) -> ModelResponse:
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, name in enumerate(plant.axes):
        if name not in record.axes:
            continue
        if not isinstance(plant.robot.axes[name], StepperAxis):
            signals[name, Tap.U] = motion.inputs[:, column]
        signals[name, Tap.REF] = motion.position[:, column]
        signals[name, Tap.MEAS] = motion.reading[:, column]
    velocity = {name: motion.velocity[:, plant.axes.index(name)] for name in record.axes}
    return ModelResponse(record.time_s, signals, velocity)
