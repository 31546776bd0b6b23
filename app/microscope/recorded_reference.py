"""Conversion of a recording of the tip into a record with the tracked tip as ``ref``."""

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.measurements import TIP_CHANNEL, compute_axis_reference, with_reference
from rotemina.app.motion.recording import Recording, make_record
from rotemina.sim.kinematics import JOINTS, KinematicChain
from rotemina.sim.records import Record

#: Axes that move the tip across the picture. The depth axes are left out, because blur gives depth
#: only relative to the focus.
MEASURABLE_AXES = ("x", "y", "thx", "thy")


def make_reference_record(
    recording: Recording, axis: str, begin_s: float = -np.inf, end_s: float = np.inf
) -> Record:
    """Return the record between two host times, with ``axis.ref`` from the tracked tip.

    Only this axis may deviate from its command; the other axes are assumed to be at their commanded
    positions. The record begins with the first picture and ends with the last one.

    Raises
    ------
    MicroscopeError
        If the microscope cannot measure the axis, no tip was recorded, or the micro stage was not
        calibrated.
    RecordingError
        See :func:`make_record`.
    """
    if axis not in MEASURABLE_AXES:
        raise MicroscopeError(
            "axis {axis}: the microscope measures only {names}; depth has no zero",
            axis=repr(axis),
            names=", ".join(MEASURABLE_AXES),
        )
    record, samples = make_record(recording, begin_s, end_s), recording.read_samples(begin_s, end_s)
    if TIP_CHANNEL not in recording.channels:
        raise MicroscopeError(
            "{path}: the recording contains no tip; calibrate, and track the tip while recording",
            path=recording.path,
        )
    tips = recording.read_channel(TIP_CHANNEL, samples.host_time_s[0], samples.host_time_s[-1])
    frame_times_s = tips["host_time_s"]
    chain = KinematicChain.of(recording.robot)
    columns = [samples.axes.index(joint) for joint in JOINTS]
    joints = np.stack(
        [
            np.interp(frame_times_s, samples.host_time_s, samples.command[:, column])
            for column in columns
        ],
        axis=-1,
    )
    tip_m = 1e-6 * np.stack([tips["x [um]"], tips["y [um]"], np.zeros(len(frame_times_s))], axis=-1)
    component = "x" if axis in ("x", "thy") else "y"
    deviation_m = 1e-6 * tips[f"{component} sd [um]"]
    is_tip_visible = np.isfinite(tip_m).all(axis=-1)
    if not is_tip_visible.any():
        raise MicroscopeError(
            "{path}: none of the {count} pictures shows where the tip is; calibrate the "
            "micro stage before recording",
            path=recording.path,
            count=len(frame_times_s),
        )
    values = np.full(len(frame_times_s), np.nan)
    values[is_tip_visible] = compute_axis_reference(
        chain, axis, tip_m[is_tip_visible], joints[is_tip_visible]
    )
    noise = float(np.sqrt(np.mean(deviation_m[is_tip_visible] ** 2)))
    if axis in ("thx", "thy"):
        noise /= chain.pin_length
    record_start_s = samples.device_time_s[0]
    time_s = np.interp(frame_times_s, samples.host_time_s, samples.device_time_s) - record_start_s
    return with_reference(record, axis, time_s, values, noise)
