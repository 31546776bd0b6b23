"""Tracked tip positions as columns of a recording, and as the ``ref`` signal of a record.

The pixel of the tip gives x and y through the calibration, and its blur gives the depth. If only
one axis moves and the others are at their commanded positions, the kinematics give the true
position of that axis:

    x, y: tip position minus the vector from the pivot to the tip
    thy = arcsin(Δx / (L cos thx)),   thx = −arcsin(Δy / L)
    z, zn: from the depth, with the uncertainty of the blur

Here Δx and Δy are the tip position minus the pivot position, and ``L = zn − pin_length`` is the
signed distance from the pivot to the tip along the pin.
"""

from collections.abc import Mapping

import numpy as np

from rotemina.app.errors import MicroscopeError
from rotemina.app.microscope.calibration_file import StageCalibration
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_from_pivot
from rotemina.sim.messages import message
from rotemina.sim.records import (
    REFERENCE_NOISE_KEY,
    Record,
    Tap,
)
from rotemina.sim.vision import TipTrack

TIP_CHANNEL = "tip"
_UM_PER_M = 1e6


def make_tip_columns(track: TipTrack, calibration: StageCalibration | None) -> dict[str, float]:
    """Return the values of a tracked tip for one row of a recording, by column name.

    ``x`` and ``y`` are NaN without a calibration. ``z`` is the distance from focus; ``z sign
    known`` is 0 if its sign is ambiguous. The ``sd`` columns are standard deviations. While the tip
    is lost, all values are NaN except ``quality``, which is 0.
    """
    if track.lost:
        return {**dict.fromkeys(_TIP_COLUMNS, float("nan")), "quality": 0.0}
    tip_m, tip_covariance = np.full(2, np.nan), np.full((2, 2), np.nan)
    if calibration is not None:
        tip_m, tip_covariance = compute_tip_xy(track.pixel, track.covariance, calibration)
    deviations_m = np.sqrt(np.diag(tip_covariance))
    values = (
        float(tip_m[0]) * _UM_PER_M,
        float(tip_m[1]) * _UM_PER_M,
        track.depth.distance * _UM_PER_M,
        float(deviations_m[0]) * _UM_PER_M,
        float(deviations_m[1]) * _UM_PER_M,
        track.depth.uncertainty * _UM_PER_M,
        float(track.pixel[0]),
        float(track.pixel[1]),
        float(track.depth.sign_known),
        track.quality,
    )
    return dict(zip(_TIP_COLUMNS, values, strict=True))


_TIP_COLUMNS = (
    "x [um]",
    "y [um]",
    "z [um]",
    "x sd [um]",
    "y sd [um]",
    "z sd [um]",
    "column [px]",
    "row [px]",
    "z sign known",
    "quality",
)


def compute_tip_xy(
    pixel: FloatArray, covariance: FloatArray, calibration: StageCalibration
) -> tuple[FloatArray, FloatArray]:
    """Return x and y (..., 2), m, of tips at ``pixel`` (..., 2), and their covariance, m².

    The result includes the covariance of the pixel, ``covariance`` (..., 2, 2), px², and the
    covariance of the calibration.
    """
    stage_map = calibration.map
    inverse = np.linalg.inv(stage_map.matrix)
    displacement = stage_map.displacement_of(np.asarray(pixel) - np.array(calibration.tip_px))
    # Derivative of the pixel with respect to the elements of the map's matrix.
    derivatives = np.einsum("ij,...k->...ijk", np.eye(2), displacement)
    jacobian = derivatives.reshape(*displacement.shape[:-1], 2, 4)
    map_covariance = jacobian @ stage_map.covariance @ np.swapaxes(jacobian, -1, -2)
    tip_covariance = inverse @ (covariance + map_covariance) @ inverse.T
    return np.array(calibration.tip_m)[:2] + displacement, np.asarray(tip_covariance)


def compute_axis_reference(
    chain: KinematicChain, axis: str, tip_m: FloatArray, joints: FloatArray
) -> FloatArray:
    """Compute the true positions (n,), m or rad, of one axis from the tip seen in the picture.

    Parameters
    ----------
    chain : KinematicChain
    axis : str
        The axis that moved.
    tip_m : (n, 3)
        Tip positions from the picture; only the coordinates that the axis moves are used.
    joints : (n, 6)
        Joint positions, commanded or measured; the column of ``axis`` is not used.

    Raises
    ------
    MicroscopeError
        If ``axis`` is not a joint, or the tip is farther from the pivot than the pin is long.
    """
    if axis not in JOINTS:
        raise MicroscopeError(
            "axis {axis} does not move the tip; choose one of {joints}",
            axis=repr(axis),
            joints=str(JOINTS),
        )
    pivot_to_tip = compute_tip_from_pivot(chain, joints[..., 3:])
    index = JOINTS.index(axis)
    if index < 3:
        return np.asarray(tip_m[..., index] - pivot_to_tip[..., index])
    seen_from_pivot, length = tip_m - joints[..., :3], joints[..., 5] - chain.pin_length
    thx, thy = joints[..., 3], joints[..., 4]
    if axis == "zn":
        return np.asarray(chain.pin_length + seen_from_pivot[..., 2] / (np.cos(thx) * np.cos(thy)))
    sine = (
        -seen_from_pivot[..., 1] / length
        if axis == "thx"
        else seen_from_pivot[..., 0] / (length * np.cos(thx))
    )
    if not (np.abs(sine) <= 1.0).all():
        raise MicroscopeError(
            "axis {axis}: the tip appears farther from the pivot than the pin is long; the "
            "calibration was made on another machine or at another position: calibrate again",
            axis=axis,
        )
    return np.asarray(np.arcsin(sine))


def with_reference(
    record: Record, axis: str, time_s: FloatArray, values: FloatArray, noise_rms: float
) -> Record:
    """Return the part of a record that the frames cover, with ``axis.ref`` computed from them.

    Parameters
    ----------
    record : Record
    axis : str
    time_s : (n,)
        Times of the frames on the record's clock, s, increasing.
    values : (n,)
        Result of :func:`compute_axis_reference`, m or rad; NaN while the tip was lost.
    noise_rms : float
        Uncertainty of the values, m or rad; stored in the metadata.

    Frames are less frequent than samples. The reference is interpolated linearly between frames, so
    it contains nothing above half the frame rate.

    Raises
    ------
    MicroscopeError
        If the record lacks the axis or already has its reference, or if no sample lies between the
        first and the last frame that show the tip.
    """
    if axis not in record.axes or record.has(axis, Tap.REF):
        template = (
            message(
                "engine",
                "the record already has a reference of axis {axis}; choose one of {names} "
                "without ref",
            )
            if axis in record.axes
            else message(
                "engine", "the record has no axis {axis}; choose one of {names} without ref"
            )
        )
        raise MicroscopeError(template.fill(axis=repr(axis), names=", ".join(record.axes)))
    is_tip_visible = np.isfinite(values)
    frame_times_s, positions = (
        np.asarray(time_s)[is_tip_visible],
        np.asarray(values)[is_tip_visible],
    )
    is_covered = np.zeros(len(record.time_s), dtype=bool)
    if len(frame_times_s) >= 2:
        is_covered = (record.time_s >= frame_times_s[0]) & (record.time_s <= frame_times_s[-1])
    if not is_covered.any():
        raise MicroscopeError(
            "{count} frames show the tip, but no sample of the record lies between the first "
            "and the last of them; record frames and samples together, on one clock",
            count=len(frame_times_s),
        )
    signals = {
        (channel.axis, channel.tap): record.values[is_covered, column]
        for column, channel in enumerate(record.columns)
    }
    signals[axis, Tap.REF] = np.interp(record.time_s[is_covered], frame_times_s, positions)
    metadata: Mapping[str, str] = {
        **record.metadata,
        # The motion before the first remaining sample, which hysteresis depends on, is missing.
        "history": "unknown",
        f"{REFERENCE_NOISE_KEY} {axis}": f"{noise_rms:.6g}",
        "reference": f"microscope: {axis}, {noise_rms:.3g} rms, {len(frame_times_s)} frames",
    }
    return Record.from_signals(record.time_s[is_covered], signals, record.units, metadata)
