"""Comparison of a real record with the model in use, and the gap of each axis."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.model import BracketedModel, CommandMemory, ModelInUse
from rotemina.app.motion.state import RunModelOutputs
from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison import (
    GapFigure,
    ModelComparison,
    compare,
    compute_gap_figure,
    find_moving_samples,
)
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot

# Prefixes of metadata keys of a record whose commands were converted before they were sent.
_CONVERSION_KEY_PREFIXES = ("compensation ", "feedback ")


@dataclass(frozen=True, eq=False)
class ComparedRun:
    """A real record and the predictions of the model in use for its commands.

    Attributes
    ----------
    name : str
    comparison : ModelComparison
        Comparison with the model in use.
    completed : bool
    model_id : str
        Id of the model in use; empty if the only model is that of the robot file.
    nominal : mapping axis -> (n,)
        Predicted readings of the nominal model, m or rad; empty if it is the model in use.
    model_outputs : RunModelOutputs, optional
        Outputs of the models during the playback.
    """

    name: str
    comparison: ModelComparison
    completed: bool = True
    model_id: str = ""
    nominal: Mapping[str, FloatArray] = field(default_factory=lambda: MappingProxyType({}))
    model_outputs: RunModelOutputs | None = None

    @property
    def record(self) -> Record:
        """The real record."""
        return self.comparison.record

    @cached_property
    def gaps(self) -> Mapping[tuple[str, Tap], GapFigure | None]:
        """The gap of each axis at each compared tap; None where nothing moved.

        This takes tenths of a second for a long record. Functions of this module therefore return
        runs whose gaps are already computed.
        """
        record, response = self.record, self.comparison.response
        commands = [record.signal(axis, Tap.CMD) for axis in record.axes]
        is_moving = find_moving_samples(record.time_s, np.column_stack(commands))
        taps = [(entry.axis, Tap(entry.tap)) for entry in self.comparison.taps]
        return {
            (axis, tap): compute_gap_figure(
                is_moving,
                record.signal(axis, tap),
                response.signal(axis, tap),
                self.nominal.get(axis) if tap is Tap.MEAS else None,
            )
            for axis, tap in taps
        }


def find_worst_axis(
    gaps: Mapping[tuple[str, Tap], GapFigure | None], robot: Robot
) -> tuple[str, GapFigure] | None:
    """Return the axis with the largest ratio of gap to noise floor of its sensor, and its gap.

    Return None if nothing moved, or nothing was measured.
    """
    candidates = []
    for (axis, tap), figure in gaps.items():
        if tap is Tap.MEAS and figure is not None:
            axis_model = robot.axes.get(axis)
            noise_floor = axis_model.sensor.noise_floor if axis_model and axis_model.sensor else 0.0
            candidates.append((figure.rms / (noise_floor or 1.0), axis, figure))
    return max(candidates, key=lambda candidate: candidate[0])[1:] if candidates else None


def compare_with_model(
    model: ModelInUse,
    name: str,
    record: Record,
    *,
    completed: bool = True,
    model_outputs: RunModelOutputs | None = None,
) -> ComparedRun:
    """Compare a record with a model.

    Parameters
    ----------
    model : ModelInUse
    name : str
    record : Record
    completed : bool
    model_outputs : RunModelOutputs, optional
        Outputs of the models during the playback, which include the effect of earlier commands.
        Without these outputs the model starts from the first row of the record.

    Raises
    ------
    InputError
        If the record does not fit the robot, or nothing was measured.
    """
    response = simulate_nominal_response(model.robot, record)
    nominal: dict[str, FloatArray] = {}
    if model.is_corrected:
        nominal_prediction = simulate_nominal_response(model.nominal, record)
        nominal = {axis: nominal_prediction.signal(axis, Tap.MEAS) for axis in record.axes}
    offsets = {axis: model.offsets.get(axis, 0.0) for axis in record.axes}
    readings = {axis: response.signal(axis, Tap.MEAS) + offsets[axis] for axis in record.axes}
    if model_outputs is not None and not any(
        key.startswith(_CONVERSION_KEY_PREFIXES) for key in record.metadata
    ):
        for column, axis in enumerate(model_outputs.axes):
            if np.isfinite(model_outputs.in_use[:, column]).all():
                readings[axis] = model_outputs.in_use[:, column]
                if model.is_corrected:
                    nominal[axis] = model_outputs.nominal[:, column]
    signals = {
        **response.signals,
        **{(axis, Tap.MEAS): reading for axis, reading in readings.items()},
    }
    prediction = replace(response, signals=signals)
    comparison = compare(model.robot, record, response=prediction)
    nominal_readings = MappingProxyType(nominal)
    return _compute_gaps(
        ComparedRun(name, comparison, completed, model.id, nominal_readings, model_outputs)
    )


def compare_run_again(model: ModelInUse, run: ComparedRun, memory: CommandMemory) -> ComparedRun:
    """Compare the record of a run with another model, which first follows the earlier commands.

    The memory holds the commands since the machine was connected.

    Raises
    ------
    InputError
        See :func:`compare_with_model`.
    """
    outputs = run.model_outputs
    if outputs is not None:
        outputs = _predict_again(model, run.record, outputs, memory)
    comparison = compare_with_model(
        model, run.name, run.record, completed=run.completed, model_outputs=outputs
    )
    return _compute_gaps(replace(comparison, model_outputs=run.model_outputs))


def _compute_gaps(run: ComparedRun) -> ComparedRun:
    """Compute the gaps of a run now, because the window that shows them cannot wait."""
    assert run.gaps is not None
    return run


def _predict_again(
    model: ModelInUse, record: Record, outputs: RunModelOutputs, memory: CommandMemory
) -> RunModelOutputs | None:
    """Return the outputs of another model for a record; None without any earlier command."""
    if not model.is_corrected:
        return replace(outputs, in_use=outputs.nominal)
    time_s, command = memory.read_history()
    is_earlier = time_s < outputs.began_s
    if memory.number != outputs.memory or not is_earlier.any():
        return None
    robot_axes = tuple(model.robot.axes)
    command_rows = np.repeat(command[is_earlier][-1:], len(record.time_s), axis=0)
    for axis in record.axes:
        command_rows[:, robot_axes.index(axis)] = record.signal(axis, Tap.CMD)
    predictor = BracketedModel(model.robot, model.offsets)
    predictor.predict(time_s[is_earlier], command[is_earlier])
    in_use, _ = predictor.predict(outputs.began_s + record.time_s - record.time_s[0], command_rows)
    columns = [robot_axes.index(axis) for axis in outputs.axes]
    return replace(outputs, in_use=in_use[:, columns])
