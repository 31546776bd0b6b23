"""Export of recordings as records or as playable trajectories."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from rotemina.app.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import RecordedSamples, Recording
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import format_fixed, message
from rotemina.sim.records import Record, Tap, write_pieces
from rotemina.sim.robot import Robot
from rotemina.sim.trajectory import CheckedTrajectory, dry_run, find_mode

# Device times are rounded to this many steps per second. Otherwise floating-point rounding of large
# device times would make the intervals slightly different.
_TIME_STEPS_PER_S = 1e9
#: Metadata that an exported record copies from its recording.
_EXPORTED_METADATA_KEYS = (
    "began",
    "robot_sha256",
    "machine_kind",
    "model",
    "effects",
    "run",
    "operator",
    "sample",
)
# An axis counts as at rest if its command is constant for this long.
_MIN_REST_S = 0.02


def export_record(
    recording: Recording, path: Path, begin_s: float = -np.inf, end_s: float = np.inf
) -> int:
    """Write the samples between two host times to an ASCII record; return their number.

    Raises
    ------
    RecordError
        If the file cannot be written.
    RecordingError
        If there are no samples, or the device was reconnected in between.
    """
    sample_count = 0

    def count_samples() -> Iterator[Record]:
        nonlocal sample_count
        for piece in make_record_pieces(recording, begin_s, end_s):
            sample_count += len(piece.time_s)
            yield piece

    write_pieces(count_samples(), path)
    return sample_count


def make_record(recording: Recording, begin_s: float = -np.inf, end_s: float = np.inf) -> Record:
    """Return the samples between two host times as a record.

    The record contains ``cmd`` and ``meas`` of all axes, and ``u`` of the axes for which the device
    always sent it. Its time is the device time, shifted to begin at 0.

    Raises
    ------
    RecordingError
        See :func:`export_record`.
    """
    section = _read_section(recording, begin_s, end_s)
    return _to_record(recording, section, recording.read_samples(begin_s, end_s))


def make_record_pieces(
    recording: Recording, begin_s: float = -np.inf, end_s: float = np.inf
) -> Iterator[Record]:
    """Yield the record that :func:`make_record` returns, in consecutive pieces.

    Raises
    ------
    RecordingError
        See :func:`export_record`.
    """
    section = _read_section(recording, begin_s, end_s)
    for piece in recording.read_pieces(begin_s, end_s):
        yield _to_record(recording, section, piece)


def make_trajectory(
    recording: Recording,
    begin_s: float,
    end_s: float,
    period_s: float,
    robot: Robot | None = None,
) -> CheckedTrajectory:
    """Return the commands between two host times as a trajectory that can be played again.

    The trajectory contains the axes that moved, with set-points every ``period_s`` that are
    interpolated linearly between the samples. A dry run checks the trajectory.

    Parameters
    ----------
    recording : Recording
    begin_s, end_s : float
        Host times at which every axis stands still.
    period_s : float
        Set-point period of the device that will play the trajectory.
    robot : Robot, optional
        Robot whose limits apply; by default the recorded one.

    Raises
    ------
    RecordingError
        If no axis moves, an axis moves at the start or end, samples are missing in between, or
        :func:`export_record` would raise it.
    OutOfLimitsError, TrajectoryError
        If the robot cannot play the trajectory.
    """
    _read_section(recording, begin_s, end_s)
    samples = recording.read_samples(begin_s, end_s)
    moving_axes = np.flatnonzero(np.ptp(samples.command, axis=0) > 0.0)
    if not len(moving_axes):
        raise RecordingError(
            "{path}: no axis was commanded to move in this section", path=recording.path
        )
    _check_gaps(recording, samples)
    _check_rest(recording, samples)
    time_s = samples.device_time_s - samples.device_time_s[0]
    rows = int(np.floor(time_s[-1] / period_s + 1e-6)) + 1
    grid_s = period_s * np.arange(rows, dtype=np.float64)
    signals = {
        (recording.axes[axis], Tap.CMD): np.interp(grid_s, time_s, samples.command[:, axis])
        for axis in moving_axes
    }
    metadata = {"trajectory": f"{recording.path.stem} again", "recording": recording.path.name}
    record = Record.from_signals(grid_s, signals, dict(recording.units), metadata)
    return dry_run(robot or recording.robot, record, setpoint_period_s=period_s).require()


@dataclass(frozen=True, slots=True, eq=False)
class _RecordedSection:
    start_s: float
    has_input: BoolArray
    metadata: dict[str, str]


def _read_section(recording: Recording, begin_s: float, end_s: float) -> _RecordedSection:
    first: RecordedSamples | None = None
    has_input = np.ones(len(recording.axes), dtype=np.bool_)
    for piece in recording.read_pieces(begin_s, end_s):
        first = piece if first is None else first
        reconnected_rows = np.flatnonzero(piece.connection != first.connection[0])
        if len(reconnected_rows):
            reconnected_s = piece.host_time_s[reconnected_rows[0]] - recording.began_s
            raise RecordingError(
                "{path}: the device was reconnected {at_s} s after the start, with a new "
                "clock; choose a section before or after that",
                path=recording.path,
                at_s=format_fixed(reconnected_s, 3),
            )
        has_input &= np.isfinite(piece.inputs).all(axis=0)
    if first is None:
        duration_s = recording.ended_s - recording.began_s
        raise RecordingError(
            "{path}: no samples in this section; the recording lasts {whole_s} s",
            path=recording.path,
            whole_s=format_fixed(duration_s, 3),
        )
    return _RecordedSection(
        float(first.device_time_s[0]), has_input, _make_metadata(recording, first)
    )


def _make_metadata(recording: Recording, first: RecordedSamples) -> dict[str, str]:
    metadata = dict(recording.metadata)
    section_start_s = float(first.host_time_s[0]) - recording.began_s
    if metadata.get("began"):
        with suppress(ValueError):
            began = datetime.fromisoformat(metadata["began"]) + timedelta(seconds=section_start_s)
            metadata["began"] = began.isoformat(timespec="milliseconds")
    return {
        "mode": find_mode(recording.robot, recording.axes),
        # The motion of the machine before the first row is not in the record.
        "history": "unknown",
        "robot": metadata.get("robot", ""),
        "driver": metadata.get("driver", ""),
        **{key: metadata[key] for key in _EXPORTED_METADATA_KEYS if metadata.get(key)},
        "recording": recording.path.name,
        "recording_id": metadata["id"],
        "recording_from_s": f"{section_start_s:.6f}",
    }


def _to_record(recording: Recording, section: _RecordedSection, samples: RecordedSamples) -> Record:
    time_s = (
        np.rint((samples.device_time_s - section.start_s) * _TIME_STEPS_PER_S) / _TIME_STEPS_PER_S
    )
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, axis in enumerate(recording.axes):
        signals[axis, Tap.CMD] = samples.command[:, column]
        if section.has_input[column]:
            signals[axis, Tap.U] = samples.inputs[:, column]
        signals[axis, Tap.MEAS] = samples.measured[:, column]
    return Record.from_signals(time_s, signals, dict(recording.units), section.metadata)


def _check_rest(recording: Recording, samples: RecordedSamples) -> None:
    """Refuse samples in which an axis moves at the start or at the end."""
    time_s = samples.device_time_s
    ends = (
        (
            time_s <= time_s[0] + _MIN_REST_S,
            message(
                "engine",
                "{path}: axis {axis} moves at the start; every axis must rest there for {rest_s} "
                "s: choose an earlier start",
            ),
        ),
        (
            time_s >= time_s[-1] - _MIN_REST_S,
            message(
                "engine",
                "{path}: axis {axis} moves at the end; every axis must rest there for {rest_s} s: "
                "choose a later end",
            ),
        ),
    )
    for rows, objection in ends:
        moving_axes = np.flatnonzero(np.ptp(samples.command[rows], axis=0) > 0.0)
        if len(moving_axes):
            raise RecordingError(
                objection.fill(
                    path=recording.path,
                    axis=recording.axes[moving_axes[0]],
                    rest_s=_MIN_REST_S,
                )
            )


def _check_gaps(recording: Recording, samples: RecordedSamples) -> None:
    """Refuse samples that are missing during a move."""
    intervals_s = np.diff(samples.device_time_s)
    has_moved = (np.diff(samples.command, axis=0) != 0.0).any(axis=1)
    gaps = np.flatnonzero(has_moved & (intervals_s > _MIN_REST_S))
    if len(gaps):
        gap_start_s = samples.host_time_s[gaps[0]] - recording.began_s
        raise RecordingError(
            "{path}: {steps_s} ms of samples are missing during a move {at_s} s after "
            "the start, at most {rest_s} ms are permitted; choose a section before or "
            "after that",
            path=recording.path,
            steps_s=format_fixed(1000.0 * intervals_s[gaps[0]], 0),
            at_s=format_fixed(gap_start_s, 3),
            rest_s=format_fixed(1000.0 * _MIN_REST_S, 0),
        )
