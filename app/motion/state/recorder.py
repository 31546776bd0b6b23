"""Recorder that extracts the record of a playback from the samples of a device."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.model import ModelOutputs
from rotemina.drivers.contract import DeviceSamples
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.errors import RecordError
from rotemina.sim.records import Record, RecordChannel, Tap
from rotemina.sim.robot import Robot, StepperAxis
from rotemina.sim.trajectory import CheckedTrajectory, find_mode

# Blocks of samples are so large that allocators return each to the system as soon as it is freed.
_BLOCK_BYTES = 1 << 26
# The metadata of a trajectory of at most this many rows contain their times.
_MAX_ROWS_WITH_TIMES = 32
# Device times are rounded to this many steps per second. Otherwise the rounding errors of large
# device times would make all intervals different.
_TIME_STEPS_PER_S = 1e9


@dataclass(frozen=True, slots=True, eq=False)
class RunModelOutputs:
    """Outputs of the models for each row of a record, computed during its playback.

    The outputs include the effect of commands before the playback.

    Attributes
    ----------
    axes : tuple of str
        Axes of the record.
    in_use, nominal : (n, axes)
        See :class:`~rotemina.app.motion.model.ModelOutputs`.
    began_s : float
        Device time of the first row.
    memory : int
        Number of the command memory to which this time belongs.
    """

    axes: tuple[str, ...]
    in_use: FloatArray
    nominal: FloatArray
    began_s: float
    memory: int


class PlaybackRecorder:
    """Collects the samples of a device from the first row of a trajectory to the last.

    The record contains every sample of the device in between, on the device's time starting at 0.
    For each axis of the trajectory it has the taps ``cmd``, ``meas`` and ``u`` (not for steppers,
    and only if the device reports it). Its metadata give mode, robot, driver, and the requested
    trajectory: name (its ``# trajectory:`` or ``# name:``), row count, duration, digest, and the
    times of a short trajectory.

    With ``laser`` the record also has ``ref``, if the samples contain a reference. By axis,
    ``calibrations`` names the calibrations applied to ``meas``, ``compensations`` the inverses
    between commands and actuators, and ``loops`` the closed loops. ``cmd`` is always the desired
    position of the trajectory.

    A sample takes 8 bytes per column: 128 bytes for six axes of which three report a voltage, or
    460 MB per hour at 1 kHz. :meth:`finish` frees these data while it copies them, so the record is
    never in memory twice.
    """

    def __init__(
        self,
        trajectory: CheckedTrajectory,
        driver: str,
        *,
        laser: bool = False,
        calibrations: Mapping[str, str] = MappingProxyType({}),
        compensations: Mapping[str, str] = MappingProxyType({}),
        loops: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._trajectory = trajectory
        self._metadata = _make_metadata(trajectory, driver)
        self._metadata |= {f"calibration {axis}": name for axis, name in calibrations.items()}
        self._metadata |= {f"compensation {axis}": name for axis, name in compensations.items()}
        self._metadata |= {f"feedback {axis}": name for axis, name in loops.items()}
        self._channels = tuple(
            _make_channels(trajectory.robot, trajectory.commands.axes, laser=laser)
        )
        self._finite_columns = np.ones(len(self._channels), dtype=np.bool_)
        self._samples = _SampleBlocks(1 + len(self._channels))
        self._output_blocks: _SampleBlocks | None = None
        #: Outputs of the models for each row; None before :meth:`finish`, or without models.
        self.model_outputs: RunModelOutputs | None = None
        self._memory = 0
        # Number of samples up to the beginning of the latest row, and the index of that row.
        self._sample_count = 0
        self._latest_row = -1

    @property
    def is_complete(self) -> bool:
        """Whether the last row of the trajectory has been sampled."""
        return self._latest_row == len(self._trajectory.commands.time_s) - 1

    def add_metadata(self, name: str, text: str) -> None:
        """Add an entry to the record's metadata."""
        self._metadata[name] = text

    def add(
        self, samples: DeviceSamples, model_outputs: ModelOutputs | None = None, memory: int = 0
    ) -> None:
        """Add samples, of which those of the trajectory are kept, with the outputs of the models.

        ``memory`` is the number of the command memory that contains these samples.

        Raises
        ------
        RecordError
            If the device reports rows that are out of order.
        """
        begun_rows = np.flatnonzero(samples.playback_row >= 0)
        # The record ends with the last row. Later samples are not part of the playback.
        if self.is_complete and not len(begun_rows):
            return
        self._check_rows(samples, begun_rows)
        first = int(begun_rows[0]) if self._latest_row < 0 and len(begun_rows) else 0
        if self._latest_row < 0 and not len(begun_rows):
            return
        if len(begun_rows):
            self._sample_count = len(self._samples) + int(begun_rows[-1]) + 1 - first
            self._latest_row = int(samples.playback_row[begun_rows[-1]])
        self._samples.append(self._make_table(samples, first))
        if model_outputs is not None:
            self._add_model_outputs(model_outputs, first)
            self._memory = memory

    def finish(self) -> Record | None:
        """Return the record of the playback, or None if it never started. Call this only once."""
        if self._latest_row < 0:
            return None
        columns = np.flatnonzero(self._finite_columns)
        device_time_s, values = self._samples.drain(self._sample_count, columns)
        if self._output_blocks is not None:
            began_s = float(device_time_s[0])
            self.model_outputs = self._drain_model_outputs(self._output_blocks, began_s)
        time_s = np.rint((device_time_s - device_time_s[0]) * _TIME_STEPS_PER_S) / _TIME_STEPS_PER_S
        channels = tuple(self._channels[column] for column in columns)
        return Record(time_s, channels, values, self._trajectory.commands.units, self._metadata)

    def _add_model_outputs(self, model_outputs: ModelOutputs, first: int) -> None:
        robot_axes, axes = tuple(self._trajectory.robot.axes), self._trajectory.commands.axes
        columns = [robot_axes.index(axis) for axis in axes]
        is_nominal_in_use = model_outputs.in_use is model_outputs.nominal
        outputs = (
            (model_outputs.in_use,)
            if is_nominal_in_use
            else (model_outputs.in_use, model_outputs.nominal)
        )
        table = np.concatenate([output[first:, columns] for output in outputs], axis=1)
        if self._output_blocks is None:
            self._output_blocks = _SampleBlocks(table.shape[1])
        self._output_blocks.append(table)

    def _drain_model_outputs(self, blocks: "_SampleBlocks", began_s: float) -> RunModelOutputs:
        axes = self._trajectory.commands.axes
        axis_count = len(axes)
        columns = np.arange(blocks.columns - 1)
        values = np.column_stack(blocks.drain(self._sample_count, columns))
        in_use = np.ascontiguousarray(values[:, :axis_count])
        nominal = in_use if blocks.columns == axis_count else values[:, axis_count:]
        return RunModelOutputs(axes, in_use, nominal, began_s, self._memory)

    def _check_rows(self, samples: DeviceSamples, begun_rows: IntArray) -> None:
        rows = np.concatenate([[self._latest_row], samples.playback_row[begun_rows]])
        backward_steps = np.flatnonzero(np.diff(rows) <= 0)
        last_row = len(self._trajectory.commands.time_s) - 1
        if len(backward_steps) or rows[-1] > last_row:
            index = int(backward_steps[0]) if len(backward_steps) else len(rows) - 2
            raise RecordError(
                "playback: the device went from row {from_row} to row {to_row} of a trajectory "
                "whose rows are 0 to {last}",
                from_row=rows[index],
                to_row=rows[index + 1],
                last=last_row,
            )

    def _make_table(self, samples: DeviceSamples, first: int) -> FloatArray:
        """Return time and channels (n, 1 + c) from sample ``first`` on."""
        robot_axes = tuple(self._trajectory.robot.axes)
        values_by_tap = {
            Tap.CMD: samples.command,
            Tap.U: samples.inputs,
            Tap.MEAS: samples.measured,
        }
        no_reference = np.full_like(samples.measured, np.nan)
        values_by_tap[Tap.REF] = (
            samples.reference if samples.reference is not None else no_reference
        )
        table = np.empty((len(samples) - first, 1 + len(self._channels)))
        table[:, 0] = samples.device_time_s[first:]
        for column, (axis, tap) in enumerate(self._channels):
            table[:, 1 + column] = values_by_tap[tap][first:, robot_axes.index(axis)]
        self._finite_columns &= np.isfinite(table[:, 1:]).all(axis=0)
        return table


class _SampleBlocks:
    def __init__(self, columns: int) -> None:
        self.columns = columns
        self._block_rows = max(1, _BLOCK_BYTES // (8 * columns))
        self._blocks: list[FloatArray] = []
        self._row_count = 0

    def __len__(self) -> int:
        return self._row_count

    def append(self, table: FloatArray) -> None:
        while len(table):
            used_rows = self._row_count % self._block_rows
            if used_rows == 0:
                self._blocks.append(np.empty((self._block_rows, self.columns)))
            rows = table[: self._block_rows - used_rows]
            self._blocks[-1][used_rows : used_rows + len(rows)] = rows
            self._row_count += len(rows)
            table = table[len(rows) :]

    def drain(self, rows: int, columns: IntArray) -> tuple[FloatArray, FloatArray]:
        """Return times (rows,) and some columns (rows, c), freeing each block once copied."""
        time_s, values = np.empty(rows), np.empty((rows, len(columns)), order="F")
        blocks, self._blocks, self._row_count = self._blocks[::-1], [], 0
        for start in range(0, rows, self._block_rows):
            block = blocks.pop()[: rows - start]
            rows_of_block = slice(start, start + len(block))
            time_s[rows_of_block] = block[:, 0]
            for index, column in enumerate(columns):
                values[rows_of_block, index] = block[:, 1 + column]
        return time_s, values


def _make_channels(robot: Robot, axes: tuple[str, ...], *, laser: bool) -> Iterator[RecordChannel]:
    for axis in axes:
        yield RecordChannel(axis, Tap.CMD)
        if not isinstance(robot.axes[axis], StepperAxis):
            yield RecordChannel(axis, Tap.U)
        if laser:
            yield RecordChannel(axis, Tap.REF)
        yield RecordChannel(axis, Tap.MEAS)


def _make_metadata(trajectory: CheckedTrajectory, driver: str) -> dict[str, str]:
    commands = trajectory.commands
    elapsed_s = commands.time_s - commands.time_s[0]
    name = commands.metadata.get("trajectory") or commands.metadata.get("name")
    metadata = {
        "mode": find_mode(trajectory.robot, commands.axes),
        # Hysteresis depends on commands before the first row, which are not in the record.
        "history": "unknown",
        "robot": trajectory.robot.name,
        "driver": driver,
        **({"trajectory": name} if name else {}),
        "trajectory_rows": str(len(elapsed_s)),
        "trajectory_duration_s": repr(commands.duration_s),
        "trajectory_digest": trajectory.digest,
    }
    if len(elapsed_s) <= _MAX_ROWS_WITH_TIMES:
        metadata["trajectory_times_s"] = " ".join(repr(time_s) for time_s in elapsed_s.tolist())
    return metadata
