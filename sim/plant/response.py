"""The nominal response to a record's commands, with what came before its first row."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.plant.plant import Motion, Plant, PlantError, PlantState
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import ForceAxis, Robot, StepperAxis

_FIRST_ROWS = 5  # rows from which position and velocity at the start are taken
_SETTLED = 1e-12  # change from period to period, over the motion, that counts as steady
_MOST_PERIODS = 50


@dataclass(frozen=True, slots=True, eq=False)
class Response:
    """What the nominal model answers: one (n,) array per axis and tap, SI.

    ``signals`` maps (axis, tap) for the taps ``u`` (not of steppers), ``ref`` and ``meas``.
    """

    time_s: FloatArray
    signals: Mapping[tuple[str, Tap], FloatArray]
    velocity: Mapping[str, FloatArray]

    def signal(self, axis: str, tap: Tap) -> FloatArray:
        """Return one modelled tap (n,), SI; KeyError if the model has none."""
        return self.signals[axis, tap]


def nominal_response(robot: Robot, record: Record, *, drive: Tap = Tap.CMD) -> Response:
    """Simulate the nominal plant over the commands of ``record``.

    The axes of the record are driven by ``drive``: their commands, or (``Tap.U``) the measured
    amplifier outputs. The robot's other axes stay where they are. In a closed-loop record, axes
    with a controller are under it. The history of the record decides how the run starts: at rest,
    from the first measured samples (``unknown``), or in the steady state (``periodic``).

    Raises
    ------
    PlantError
        If the record names an axis that the robot lacks, has no command of one, or a force axis
        has neither a controller nor a measured ``u``.
    """
    _check_axes(robot, record)
    plant = Plant.of(robot, closed_loop=record.closed_loop)
    run = _commands(plant, record, drive)
    if record.history == "periodic":
        return _response(plant, record, _steady(plant, run, record.period_samples))
    state = plant.at_rest(run.time_s[0], run.command[0])
    if record.history == "unknown":
        state = _measured_start(plant, record, state, run)
    motion, _ = plant.advance(state, run.time_s, run.command, add=run.add, inputs=run.inputs)
    return _response(plant, record, motion)


@dataclass(frozen=True, slots=True, eq=False)
class _Run:
    """Samples (n,) and what drives each axis of the robot (n, axes)."""

    time_s: FloatArray
    command: FloatArray
    add: FloatArray
    inputs: FloatArray


def _check_axes(robot: Robot, record: Record) -> None:
    for axis in record.axes:
        if axis not in robot.axes:
            raise PlantError(
                f"axis {axis!r} of the record: robot {robot.name!r} has {list(robot.axes)}"
            )
        if not record.has(axis, Tap.CMD):
            raise PlantError(
                f"axis {axis!r} of the record: it has no {axis}.cmd column to drive the model"
            )


def _commands(plant: Plant, record: Record, drive: Tap) -> _Run:
    rows = len(record.time_s)
    command = np.tile([axis.range[0] for axis in plant.robot.axes.values()], (rows, 1))
    add = np.zeros_like(command)
    for column, name in enumerate(plant.axes):
        if record.has(name, Tap.CMD):
            command[:, column] = record.signal(name, Tap.CMD)
        if record.has(name, Tap.ADD):
            add[:, column] = record.signal(name, Tap.ADD)
    inputs = plant.open_loop_inputs(command)
    for column, name in enumerate(plant.axes):
        if plant.loops[column] is not None:
            continue
        force = isinstance(plant.robot.axes[name], ForceAxis)
        if record.has(name, Tap.U) and (force or drive is Tap.U):
            inputs[:, column] = record.signal(name, Tap.U)
        elif force:
            if record.has(name, Tap.CMD):
                raise PlantError(
                    f"axis {name!r} is moved by a force: an open-loop record needs its {name}.u, "
                    "or '# mode: closed_loop' and a controller in the robot file"
                )
            inputs[:, column] = 0.0
    return _Run(record.time_s, command, add, inputs)


def _steady(plant: Plant, run: _Run, period_samples: int | None) -> Motion:
    """Run the first period before the record until it repeats itself, then the record itself."""
    rows = len(run.time_s)
    period = min(period_samples or rows, rows)
    lead = _lead(run, period)
    state = plant.at_rest(lead.time_s[0], run.command[0])
    before = state
    for _ in range(_MOST_PERIODS):
        motion, after = plant.advance(
            state, lead.time_s, lead.command, add=lead.add, inputs=lead.inputs
        )
        settled = np.abs(after.position[-1] - before.position[-1]) <= _SETTLED * np.ptp(
            motion.position, axis=0
        )
        if settled.all():
            break
        before, state = after, _moved(after, lead.time_s[0] - run.time_s[0])
    motion, _ = plant.advance(after, run.time_s, run.command, add=run.add, inputs=run.inputs)
    return motion


def _lead(run: _Run, period: int) -> _Run:
    """Return the first period, moved to end where the record begins."""
    rows = len(run.time_s)
    if period < rows:
        length = run.time_s[period] - run.time_s[0]
    else:
        length = (run.time_s[-1] - run.time_s[0]) * rows / max(rows - 1, 1)
    first = slice(0, period)
    return _Run(run.time_s[first] - length, run.command[first], run.add[first], run.inputs[first])


def _moved(state: PlantState, by_s: float) -> PlantState:
    return replace(state, time_s=state.time_s + by_s)


def _measured_start(plant: Plant, record: Record, rest: PlantState, run: _Run) -> PlantState:
    """Take position and velocity from a parabola through the first measured rows."""
    position, velocity = rest.position[0].copy(), rest.velocity[0].copy()
    rows = min(_FIRST_ROWS, len(record.time_s))
    since = record.time_s[:rows] - record.time_s[0]
    for column, name in enumerate(plant.axes):
        tap = Tap.REF if record.has(name, Tap.REF) else Tap.MEAS
        if not record.has(name, tap):
            continue
        offset = plant.robot.axes[name].offset if tap is Tap.MEAS else 0.0
        first = record.signal(name, tap)[:rows] - offset
        curve = np.polynomial.Polynomial.fit(since, first, min(2, rows - 1))
        position[column] = curve(0.0)
        velocity[column] = curve.deriv()(0.0)
    return plant.at(run.time_s[0], run.inputs[0], position, velocity)


def _response(plant: Plant, record: Record, motion: Motion) -> Response:
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, name in enumerate(plant.axes):
        if name not in record.axes:
            continue
        axis = plant.robot.axes[name]
        if not isinstance(axis, StepperAxis):
            signals[name, Tap.U] = motion.inputs[:, column]
        signals[name, Tap.REF] = motion.position[:, column]
        signals[name, Tap.MEAS] = motion.position[:, column] + axis.offset
    velocity = {name: motion.velocity[:, plant.axes.index(name)] for name in record.axes}
    return Response(record.time_s, signals, velocity)
