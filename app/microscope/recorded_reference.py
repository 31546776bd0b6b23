"""Converts a recording of the tip into a record with the microscope as ``ref``."""

import numpy as np

from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.measurements import CHANNEL, axis_reference, with_reference
from rotemina.app.motion.recording.exporting import record_of
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record

#: Axes whose motion is across the view. Depth comes from blur, without its zero.
SEEN = ("x", "y", "thx", "thy")


def recorded_reference(
    recording: Recording, axis: str, begin_s: float = -np.inf, end_s: float = np.inf
) -> Record:
    """Return what was recorded between two host times, with ``axis.ref`` from the tracked tip.

    The axis must be the only one that deviates from its commands; the others count as commanded.
    It begins with the first picture and ends with the last.

    Raises
    ------
    MicroscopeError
        If the axis is not seen from there, or no tip was tracked and calibrated meanwhile.
    RecordingError
        As :func:`record_of`.
    """
    if axis not in SEEN:
        raise MicroscopeError(
            message(
                "engine",
                "axis {axis}: the microscope measures only {names}; depth has no zero",
            ).fill(axis=repr(axis), names=", ".join(SEEN))
        )
    record, samples = record_of(recording, begin_s, end_s), recording.samples(begin_s, end_s)
    if CHANNEL not in recording.channels:
        raise MicroscopeError(
            message(
                "engine",
                "{path}: the recording contains no tip; calibrate, and track the tip while "
                "recording",
            ).fill(path=recording.path)
        )
    tips = recording.channel(CHANNEL, samples.host_time_s[0], samples.host_time_s[-1])
    at_s = tips["host_time_s"]
    chain = Chain.of(recording.robot)
    columns = [samples.axes.index(joint) for joint in JOINTS]
    joints = np.stack(
        [np.interp(at_s, samples.host_time_s, samples.command[:, column]) for column in columns],
        axis=-1,
    )
    tip_m = 1e-6 * np.stack([tips["x [um]"], tips["y [um]"], np.zeros(len(at_s))], axis=-1)
    along = "x" if axis in ("x", "thy") else "y"
    doubt_m = 1e-6 * tips[f"{along} sd [um]"]
    seen = np.isfinite(tip_m).all(axis=-1)
    if not seen.any():
        raise MicroscopeError(
            message(
                "engine",
                "{path}: none of the {count} pictures shows where the tip is; calibrate the "
                "micro stage before recording",
            ).fill(path=recording.path, count=len(at_s))
        )
    values = np.full(len(at_s), np.nan)
    values[seen] = axis_reference(chain, axis, tip_m[seen], joints[seen])
    noise = float(np.sqrt(np.mean(doubt_m[seen] ** 2)))
    if axis in ("thx", "thy"):
        noise /= chain.pin_length
    begin = samples.device_time_s[0]
    time_s = np.interp(at_s, samples.host_time_s, samples.device_time_s) - begin
    return with_reference(record, axis, time_s, values, noise)
