"""Extracts the record of a playback from the samples of a device."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rotemina.app.motion.live_models import ModelOutputs
from rotemina.drivers.samples import Samples
from rotemina.sim.arrays import FloatArray, IntArray
from rotemina.sim.messages import message
from rotemina.sim.records.record import Channel, Record, RecordError, Tap
from rotemina.sim.robot.model import Robot, StepperAxis
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.dry_run import mode_of

# Samples are kept in blocks so large that allocators give each back to the system at once.
_BLOCK_BYTES = 1 << 26
_SHORT = 32  # rows of a trajectory whose times its record names
# Device times are told apart to this many parts of a second: the rounding of a late device time
# must not make every interval a different one.
_PER_SECOND = 1e9


@dataclass(frozen=True, slots=True, eq=False)
class RunAnswers:
    """The models' answers for each row of a record during its playback, with their history.

    Attributes
    ----------
    axes : tuple of str
        The record's.
    in_use, nominal : (n, axes)
        As :class:`~rotemina.app.motion.live_models.ModelOutputs`.
    began_s : float
        Device time of the first row.
    memory : int
        Which of the memories of commands that is a time of.
    """

    axes: tuple[str, ...]
    in_use: FloatArray
    nominal: FloatArray
    began_s: float
    memory: int


class PlaybackRecorder:
    """Collects the samples of a device from the first row of a trajectory to the last.

    The record has every sample of the device in between, on the device's time from 0, and for the
    trajectory's axes ``cmd``, ``u`` (not of steppers, and only if the device reports it) and
    ``meas``. Its metadata give mode, robot, driver, and the requested trajectory: name (its ``#
    trajectory:`` or ``# name:``), rows, duration, digest, and the times of a short one.

    With ``laser`` it also has ``ref``, if the device's samples have a reference. ``calibrations``
    names those applied to ``meas``, by axis; ``compensations`` the inverses between commands and
    actuators; ``loops`` the closed loops. ``cmd`` is always the desired position of the trajectory.

    A sample takes 8 bytes per column: 128 with six axes of which three report a voltage, 460 MB per
    hour at 1 kHz. :meth:`finish` releases its data while copying, so the record is not held twice.
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
        self._metadata = _metadata(trajectory, driver)
        self._metadata |= {f"calibration {axis}": name for axis, name in calibrations.items()}
        self._metadata |= {f"compensation {axis}": name for axis, name in compensations.items()}
        self._metadata |= {f"feedback {axis}": name for axis, name in loops.items()}
        self._channels = tuple(_channels(trajectory.robot, trajectory.commands.axes, laser=laser))
        self._told = np.ones(len(self._channels), dtype=np.bool_)
        self._samples = _Samples(1 + len(self._channels))
        self._answers: _Samples | None = None
        #: The models' answers for each row; None before its end or without models.
        self.answers: RunAnswers | None = None
        self._memory = 0
        self._rows = 0  # samples up to the latest row that began
        self._row = -1

    @property
    def complete(self) -> bool:
        """Whether the last row of the trajectory was sampled."""
        return self._row == len(self._trajectory.commands.time_s) - 1

    def say(self, name: str, text: str) -> None:
        """Put something into the record's metadata."""
        self._metadata[name] = text

    def add(self, samples: Samples, answers: ModelOutputs | None = None, memory: int = 0) -> None:
        """Add the samples of the trajectory, with the models' answers.

        ``memory`` is the number of the memory of commands that these samples are in.

        Raises
        ------
        RecordError
            If the device names rows that do not follow one another.
        """
        began = np.flatnonzero(samples.playback_row >= 0)
        if self.complete and not len(began):
            return
        self._check_rows(samples, began)
        first = int(began[0]) if self._row < 0 and len(began) else 0
        if self._row < 0 and not len(began):
            return
        if len(began):
            self._rows = len(self._samples) + int(began[-1]) + 1 - first
            self._row = int(samples.playback_row[began[-1]])
        self._samples.append(self._table(samples, first))
        if answers is not None:
            self._add_answers(answers, first)
            self._memory = memory

    def finish(self) -> Record | None:
        """Return the record of the playback, once; None if it never started."""
        if self._row < 0:
            return None
        told = np.flatnonzero(self._told)
        device_time_s, values = self._samples.drained(self._rows, told)
        if self._answers is not None:
            began_s = float(device_time_s[0])
            self.answers = self._drained_answers(self._answers, began_s)
        time_s = np.rint((device_time_s - device_time_s[0]) * _PER_SECOND) / _PER_SECOND
        channels = tuple(self._channels[column] for column in told)
        return Record(time_s, channels, values, self._trajectory.commands.units, self._metadata)

    def _add_answers(self, answers: ModelOutputs, first: int) -> None:
        order, axes = tuple(self._trajectory.robot.axes), self._trajectory.commands.axes
        own = [order.index(axis) for axis in axes]
        alike = answers.in_use is answers.nominal
        parts = (answers.in_use,) if alike else (answers.in_use, answers.nominal)
        table = np.concatenate([part[first:, own] for part in parts], axis=1)
        if self._answers is None:
            self._answers = _Samples(table.shape[1])
        self._answers.append(table)

    def _drained_answers(self, kept: "_Samples", began_s: float) -> RunAnswers:
        axes = self._trajectory.commands.axes
        count = len(axes)
        columns = np.arange(kept.columns - 1)
        values = np.column_stack(kept.drained(self._rows, columns))
        in_use = np.ascontiguousarray(values[:, :count])
        nominal = in_use if kept.columns == count else values[:, count:]
        return RunAnswers(axes, in_use, nominal, began_s, self._memory)

    def _check_rows(self, samples: Samples, began: IntArray) -> None:
        rows = np.concatenate([[self._row], samples.playback_row[began]])
        wrong = np.flatnonzero(np.diff(rows) <= 0)
        last = len(self._trajectory.commands.time_s) - 1
        if len(wrong) or rows[-1] > last:
            at = int(wrong[0]) if len(wrong) else len(rows) - 2
            raise RecordError(
                message(
                    "engine",
                    "playback: the device went from row {from_row} to row {to_row} of a trajectory "
                    "whose rows are 0 to {last}",
                ).fill(from_row=rows[at], to_row=rows[at + 1], last=last)
            )

    def _table(self, samples: Samples, first: int) -> FloatArray:
        """Return time and channels (n, 1 + c) from one sample on."""
        order = tuple(self._trajectory.robot.axes)
        taps = {Tap.CMD: samples.command, Tap.U: samples.inputs, Tap.MEAS: samples.measured}
        unseen = np.full_like(samples.measured, np.nan)
        taps[Tap.REF] = samples.reference if samples.reference is not None else unseen
        table = np.empty((len(samples) - first, 1 + len(self._channels)))
        table[:, 0] = samples.device_time_s[first:]
        for column, (axis, tap) in enumerate(self._channels):
            table[:, 1 + column] = taps[tap][first:, order.index(axis)]
        self._told &= np.isfinite(table[:, 1:]).all(axis=0)
        return table


class _Samples:
    """Times and values of samples, in blocks."""

    def __init__(self, columns: int) -> None:
        self.columns = columns
        self._block = max(1, _BLOCK_BYTES // (8 * columns))
        self._blocks: list[FloatArray] = []
        self._rows = 0

    def __len__(self) -> int:
        return self._rows

    def append(self, table: FloatArray) -> None:
        while len(table):
            used = self._rows % self._block
            if used == 0:
                self._blocks.append(np.empty((self._block, self.columns)))
            part = table[: self._block - used]
            self._blocks[-1][used : used + len(part)] = part
            self._rows += len(part)
            table = table[len(part) :]

    def drained(self, rows: int, columns: IntArray) -> tuple[FloatArray, FloatArray]:
        """Return times (rows,) and some columns (rows, c); nothing is left here."""
        time_s, values = np.empty(rows), np.empty((rows, len(columns)), order="F")
        blocks, self._blocks, self._rows = self._blocks[::-1], [], 0
        for begin in range(0, rows, self._block):
            block = blocks.pop()[: rows - begin]
            here = slice(begin, begin + len(block))
            time_s[here] = block[:, 0]
            for to, column in enumerate(columns):
                values[here, to] = block[:, 1 + column]
        return time_s, values


def _channels(robot: Robot, axes: tuple[str, ...], *, laser: bool) -> Iterator[Channel]:
    for axis in axes:
        yield Channel(axis, Tap.CMD)
        if not isinstance(robot.axes[axis], StepperAxis):
            yield Channel(axis, Tap.U)
        if laser:
            yield Channel(axis, Tap.REF)
        yield Channel(axis, Tap.MEAS)


def _metadata(trajectory: CheckedTrajectory, driver: str) -> dict[str, str]:
    asked = trajectory.commands
    since_s = asked.time_s - asked.time_s[0]
    name = asked.metadata.get("trajectory") or asked.metadata.get("name")
    metadata = {
        "mode": mode_of(trajectory.robot, asked.axes),
        # What the machine remembers from before the first row is not in the record.
        "history": "unknown",
        "robot": trajectory.robot.name,
        "driver": driver,
        **({"trajectory": name} if name else {}),
        "trajectory_rows": str(len(since_s)),
        "trajectory_duration_s": repr(asked.duration_s),
        "trajectory_digest": trajectory.digest,
    }
    if len(since_s) <= _SHORT:
        metadata["trajectory_times_s"] = " ".join(repr(each) for each in since_s.tolist())
    return metadata
