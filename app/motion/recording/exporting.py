"""Export of recordings as records or playable trajectories."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from rotemina.app.motion.recording.errors import RecordingError
from rotemina.app.motion.recording.recording_reader import RecordedSamples, Recording
from rotemina.sim.arrays import BoolArray, FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_pieces
from rotemina.sim.robot.model import Robot
from rotemina.sim.trajectory.checked_trajectory import CheckedTrajectory
from rotemina.sim.trajectory.dry_run import dry_run, mode_of

# Device times are told apart to this many parts of a second: the rounding of a late device time
# must not make every interval a different one.
_PER_SECOND = 1e9
#: Metadata of a recording that stand in what is exported of it as well.
_CARRIED = (
    "began",
    "robot_sha256",
    "machine_kind",
    "model",
    "effects",
    "run",
    "operator",
    "sample",
)
_REST_S = 0.02  # for so long an axis must stand to count as at rest


def export(
    recording: Recording, path: Path, begin_s: float = -np.inf, end_s: float = np.inf
) -> int:
    """Write the samples between two host times as an ASCII record; return their number.

    Raises
    ------
    RecordError
        If the file cannot be written.
    RecordingError
        If there are no samples, or the device was connected again in between.
    """
    count = 0

    def counted() -> Iterator[Record]:
        nonlocal count
        for piece in record_pieces(recording, begin_s, end_s):
            count += len(piece.time_s)
            yield piece

    write_pieces(counted(), path)
    return count


def record_of(recording: Recording, begin_s: float = -np.inf, end_s: float = np.inf) -> Record:
    """Return the samples between two host times as a record.

    It has ``cmd``, ``u`` (where the device told it throughout) and ``meas`` of all axes, on the
    device's time from 0.

    Raises
    ------
    RecordingError
        As :func:`export`.
    """
    span = _span(recording, begin_s, end_s)
    return _record(recording, span, recording.samples(begin_s, end_s))


def record_pieces(
    recording: Recording, begin_s: float = -np.inf, end_s: float = np.inf
) -> Iterator[Record]:
    """Give the record of :func:`record_of` in pieces, one behind the other.

    Raises
    ------
    RecordingError
        As :func:`export`.
    """
    span = _span(recording, begin_s, end_s)
    for piece in recording.pieces(begin_s, end_s):
        yield _record(recording, span, piece)


def trajectory(
    recording: Recording,
    begin_s: float,
    end_s: float,
    period_s: float,
    robot: Robot | None = None,
) -> CheckedTrajectory:
    """Return the commands between two host times, to be played again.

    They are those of the axes that moved, on lines between samples, every ``period_s``, at which
    the device that shall play them applies set-points; checked by a dry run.

    Parameters
    ----------
    recording : Recording
    begin_s, end_s : float
        Between two moments at which every axis stood.
    period_s : float
    robot : Robot, optional
        Whose limits are asked; the recorded one by default.

    Raises
    ------
    RecordingError
        If nothing moved, an axis moves at the begin or end, samples are missing in between, or as
        :func:`export`.
    OutOfLimitsError, TrajectoryError
        If the robot must not play it.
    """
    _span(recording, begin_s, end_s)
    samples = recording.samples(begin_s, end_s)
    moving = np.flatnonzero(np.ptp(samples.command, axis=0) > 0.0)
    if not len(moving):
        raise RecordingError(
            message("engine", "{path}: no axis was commanded to move in this section").fill(
                path=recording.path
            )
        )
    _check_gaps(recording, samples)
    _check_rest(recording, samples)
    time_s = samples.device_time_s - samples.device_time_s[0]
    rows = int(np.floor(time_s[-1] / period_s + 1e-6)) + 1
    grid_s = period_s * np.arange(rows, dtype=np.float64)
    signals = {
        (recording.axes[axis], Tap.CMD): np.interp(grid_s, time_s, samples.command[:, axis])
        for axis in moving
    }
    metadata = {"trajectory": f"{recording.path.stem} again", "recording": recording.path.name}
    record = Record.from_signals(grid_s, signals, dict(recording.units), metadata)
    return dry_run(robot or recording.robot, record, setpoint_period_s=period_s).require()


@dataclass(frozen=True, slots=True, eq=False)
class _Span:
    """The common data of the pieces of a record: its start, and the axes with ``u``."""

    first_s: float
    told: BoolArray
    metadata: dict[str, str]


def _span(recording: Recording, begin_s: float, end_s: float) -> _Span:
    first: RecordedSamples | None = None
    told = np.ones(len(recording.axes), dtype=np.bool_)
    for piece in recording.pieces(begin_s, end_s):
        first = piece if first is None else first
        changed = np.flatnonzero(piece.connection != first.connection[0])
        if len(changed):
            at_s = piece.host_time_s[changed[0]] - recording.began_s
            raise RecordingError(
                message(
                    "engine",
                    "{path}: the device was reconnected {at_s} s after the start, with a new "
                    "clock; choose a section before or after that",
                ).fill(path=recording.path, at_s=fixed(at_s, 3))
            )
        told &= np.isfinite(piece.inputs).all(axis=0)
    if first is None:
        whole_s = recording.ended_s - recording.began_s
        raise RecordingError(
            message(
                "engine", "{path}: no samples in this section; the recording lasts {whole_s} s"
            ).fill(path=recording.path, whole_s=fixed(whole_s, 3))
        )
    return _Span(float(first.device_time_s[0]), told, _metadata(recording, first))


def _metadata(recording: Recording, first: RecordedSamples) -> dict[str, str]:
    said = dict(recording.metadata)
    since_s = float(first.host_time_s[0]) - recording.began_s
    if said.get("began"):
        with suppress(ValueError):
            began = datetime.fromisoformat(said["began"]) + timedelta(seconds=since_s)
            said["began"] = began.isoformat(timespec="milliseconds")
    return {
        "mode": mode_of(recording.robot, recording.axes),
        # What the machine remembers from before the first row is not in the record.
        "history": "unknown",
        "robot": said.get("robot", ""),
        "driver": said.get("driver", ""),
        **{key: said[key] for key in _CARRIED if said.get(key)},
        "recording": recording.path.name,
        "recording_id": said["id"],
        "recording_from_s": f"{since_s:.6f}",
    }


def _record(recording: Recording, span: _Span, samples: RecordedSamples) -> Record:
    time_s = np.rint((samples.device_time_s - span.first_s) * _PER_SECOND) / _PER_SECOND
    signals: dict[tuple[str, Tap], FloatArray] = {}
    for column, axis in enumerate(recording.axes):
        signals[axis, Tap.CMD] = samples.command[:, column]
        if span.told[column]:
            signals[axis, Tap.U] = samples.inputs[:, column]
        signals[axis, Tap.MEAS] = samples.measured[:, column]
    return Record.from_signals(time_s, signals, dict(recording.units), span.metadata)


def _check_rest(recording: Recording, samples: RecordedSamples) -> None:
    time_s = samples.device_time_s
    ends = {
        "start": (time_s <= time_s[0] + _REST_S, "an earlier start"),
        "end": (time_s >= time_s[-1] - _REST_S, "a later end"),
    }
    for end, (rows, advice) in ends.items():
        moves = np.flatnonzero(np.ptp(samples.command[rows], axis=0) > 0.0)
        if len(moves):
            raise RecordingError(
                message(
                    "engine",
                    "{path}: axis {axes} moves at the {end}; every axis must rest there for "
                    "{rest_s} s: choose {advice}",
                ).fill(
                    path=recording.path,
                    axes=recording.axes[moves[0]],
                    end=end,
                    rest_s=_REST_S,
                    advice=advice,
                )
            )


def _check_gaps(recording: Recording, samples: RecordedSamples) -> None:
    steps_s = np.diff(samples.device_time_s)
    moved = (np.diff(samples.command, axis=0) != 0.0).any(axis=1)
    wide = np.flatnonzero(moved & (steps_s > _REST_S))
    if len(wide):
        at_s = samples.host_time_s[wide[0]] - recording.began_s
        raise RecordingError(
            message(
                "engine",
                "{path}: {steps_s} ms of samples are missing during a move {at_s} s after "
                "the start, at most {rest_s} ms are permitted; choose a section before or "
                "after that",
            ).fill(
                path=recording.path,
                steps_s=fixed(1000.0 * steps_s[wide[0]], 0),
                at_s=fixed(at_s, 3),
                rest_s=fixed(1000.0 * _REST_S, 0),
            )
        )
