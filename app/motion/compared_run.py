"""A run: a real record and the model in use, with the gap of each axis."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.bracketed_model import BracketedModel
from rotemina.app.motion.command_memory import CommandMemory
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.motion.recorder import RunAnswers
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.comparison import Comparison, compare
from rotemina.sim.comparison.gap import GapFigure, gap_figure, moving
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot

_REPLACED = ("compensation ", "feedback ")  # metadata: what was sent is not what the record says


@dataclass(frozen=True, eq=False)
class Run:
    """A real record and the answer of the model in use to its commands.

    Attributes
    ----------
    name : str
    comparison : Comparison
        With the model in use.
    completed : bool
    model_id : str
        Of the model in use; empty where there is none but the robot file's.
    nominal : mapping axis -> (n,)
        What the nominal model reads, m or rad; empty where that is the model in use.
    answers : RunAnswers, optional
        What the models said while it was played.
    """

    name: str
    comparison: Comparison
    completed: bool = True
    model_id: str = ""
    nominal: Mapping[str, FloatArray] = field(default_factory=lambda: MappingProxyType({}))
    answers: RunAnswers | None = None

    @property
    def record(self) -> Record:
        """The real record."""
        return self.comparison.record

    @cached_property
    def gaps(self) -> Mapping[tuple[str, Tap], GapFigure | None]:
        """The gap of each axis at each tap that is compared; None: nothing moved.

        A run is returned with its gaps worked out: of a long record it takes tenths of a second.
        """
        record, response = self.record, self.comparison.response
        commands = [record.signal(axis, Tap.CMD) for axis in record.axes]
        counted = moving(record.time_s, np.column_stack(commands))
        places = [(one.axis, Tap(one.tap)) for one in self.comparison.taps]
        return {
            (axis, tap): gap_figure(
                counted,
                record.signal(axis, tap),
                response.signal(axis, tap),
                self.nominal.get(axis) if tap is Tap.MEAS else None,
            )
            for axis, tap in places
        }


def worst(
    gaps: Mapping[tuple[str, Tap], GapFigure | None], robot: Robot
) -> tuple[str, GapFigure] | None:
    """Return the axis whose reading departs most, in noise floors of its sensor, with its gap.

    None where nothing moved, or nothing was read.
    """
    found = []
    for (axis, tap), figure in gaps.items():
        if tap is Tap.MEAS and figure is not None:
            described = robot.axes.get(axis)
            floor = described.sensor.noise_floor if described and described.sensor else 0.0
            found.append((figure.rms / (floor or 1.0), axis, figure))
    return max(found, key=lambda one: one[0])[1:] if found else None


def compared(
    model: ModelInUse,
    name: str,
    record: Record,
    *,
    completed: bool = True,
    answers: RunAnswers | None = None,
) -> Run:
    """Compare a record with a model.

    Parameters
    ----------
    model : ModelInUse
    name : str
    record : Record
    completed : bool
    answers : RunAnswers, optional
        What the models said while it was played: they know what came before. Without, the model
        begins with what the record tells of it.

    Raises
    ------
    InputError
        If the record does not fit the robot, or nothing was measured.
    """
    response = nominal_response(model.robot, record)
    nominal: dict[str, FloatArray] = {}
    if model.corrected:
        plain = nominal_response(model.nominal, record)
        nominal = {axis: plain.signal(axis, Tap.MEAS) for axis in record.axes}
    shifts = {axis: model.offsets.get(axis, 0.0) for axis in record.axes}
    readings = {axis: response.signal(axis, Tap.MEAS) + shifts[axis] for axis in record.axes}
    if answers is not None and not any(key.startswith(_REPLACED) for key in record.metadata):
        for column, axis in enumerate(answers.axes):
            if np.isfinite(answers.in_use[:, column]).all():
                readings[axis] = answers.in_use[:, column]
                if model.corrected:
                    nominal[axis] = answers.nominal[:, column]
    signals = {**response.signals, **{(axis, Tap.MEAS): one for axis, one in readings.items()}}
    answered = replace(response, signals=signals)
    comparison = compare(model.robot, record, response=answered)
    shown = MappingProxyType(nominal)
    return _with_gaps(Run(name, comparison, completed, model.id, shown, answers))


def compared_again(model: ModelInUse, run: Run, memory: CommandMemory) -> Run:
    """Compare the record of a run with another model, which also knows the earlier commands.

    The memory holds all commands while the machine stays connected.

    Raises
    ------
    InputError
        As :func:`compared`.
    """
    told = run.answers
    if told is not None:
        told = _answers_anew(model, run.record, told, memory)
    answered = compared(model, run.name, run.record, completed=run.completed, answers=told)
    return _with_gaps(replace(answered, answers=run.answers))


def _with_gaps(run: Run) -> Run:
    """Return a run with its gaps worked out, as this may take long and the window shows them."""
    assert run.gaps is not None
    return run


def _answers_anew(
    model: ModelInUse, record: Record, told: RunAnswers, memory: CommandMemory
) -> RunAnswers | None:
    """Return what another model says of a record; None where nothing is known of before."""
    if not model.corrected:
        return replace(told, in_use=told.nominal)
    time_s, command = memory.history()
    before = time_s < told.began_s
    if memory.number != told.memory or not before.any():
        return None
    order = tuple(model.robot.axes)
    rows = np.repeat(command[before][-1:], len(record.time_s), axis=0)
    for axis in record.axes:
        rows[:, order.index(axis)] = record.signal(axis, Tap.CMD)
    run = BracketedModel(model.robot, model.offsets)
    run.answer(time_s[before], command[before])
    in_use, _ = run.answer(told.began_s + record.time_s - record.time_s[0], rows)
    own = [order.index(axis) for axis in told.axes]
    return replace(told, in_use=in_use[:, own])
