"""Tracked positions as numbers for recordings, and as an independent ``ref`` for records.

A tip in the picture gives x and y through the calibration, and the depth through its blur. With
one axis moving and the others as commanded, the kinematics turn that into the axis' true place:

    x, y: the tip's less the pin's;   thy = arcsin(Δx / (L cos thx)),   thx = −arcsin(Δy / L)
    z, zn: from the depth, whose uncertainty is that of blur

with the pin's signed length ``L = zn − pin_length``.
"""

from collections.abc import Mapping

import numpy as np

from rotemina.app.microscope.calibration_file import StageCalibration
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.sim.arrays import FloatArray
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_from_pivot
from rotemina.sim.messages import message
from rotemina.sim.records.record import REFERENCE_NOISE, Record, Tap
from rotemina.sim.vision.tracking import TipTrack

CHANNEL = "tip"
_UM = 1e6


def tip_columns(track: TipTrack, calibration: StageCalibration | None) -> dict[str, float]:
    """Return what a recording keeps of a tip, by column; positions in µm, ``sd`` their doubts.

    ``x`` and ``y`` are NaN where nothing is calibrated. All are NaN while the tip is lost, but
    ``quality``, which is 0 then. ``z`` is the distance from focus; ``z sign known`` is 0 where its
    sign may as well be the other one.
    """
    if track.lost:
        return {**dict.fromkeys(_COLUMNS, float("nan")), "quality": 0.0}
    tip_m, spread = np.full(2, np.nan), np.full((2, 2), np.nan)
    if calibration is not None:
        tip_m, spread = tip_in_plane(track.pixel, track.covariance, calibration)
    doubts = np.sqrt(np.diag(spread))
    values = (
        float(tip_m[0]) * _UM,
        float(tip_m[1]) * _UM,
        track.depth.distance * _UM,
        float(doubts[0]) * _UM,
        float(doubts[1]) * _UM,
        track.depth.uncertainty * _UM,
        float(track.pixel[0]),
        float(track.pixel[1]),
        float(track.depth.sign_known),
        track.quality,
    )
    return dict(zip(_COLUMNS, values, strict=True))


_COLUMNS = (
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


def tip_in_plane(
    pixel: FloatArray, covariance: FloatArray, calibration: StageCalibration
) -> tuple[FloatArray, FloatArray]:
    """Return x and y (..., 2), m, of tips seen at ``pixel`` (..., 2), and their covariance.

    Both doubts count: that of the pixel, ``covariance`` (..., 2, 2), and the calibration's.
    """
    mapped = calibration.map
    inverse = np.linalg.inv(mapped.matrix)
    moved = mapped.displacement(np.asarray(pixel) - np.array(calibration.tip_px))
    # By how much the map's doubt moves a pixel so far away.
    away = np.einsum("ij,...k->...ijk", np.eye(2), moved)
    jacobian = away.reshape(*moved.shape[:-1], 2, 4)
    own = jacobian @ mapped.covariance @ np.swapaxes(jacobian, -1, -2)
    spread = inverse @ (covariance + own) @ inverse.T
    return np.array(calibration.tip_m)[:2] + moved, np.asarray(spread)


def axis_reference(chain: Chain, axis: str, tip_m: FloatArray, joints: FloatArray) -> FloatArray:
    """Return where one axis truly was, (n,), m or rad, by where the tip was seen.

    Parameters
    ----------
    chain : Chain
    axis : str
        The one that moved.
    tip_m : (n, 3)
        Seen; only the coordinates that the axis moves count.
    joints : (n, 6)
        Of the other axes, as commanded or measured.

    Raises
    ------
    MicroscopeError
        If it is no joint, or the tip is farther away than the pin is long.
    """
    if axis not in JOINTS:
        raise MicroscopeError(
            message("engine", "axis {axis} does not move the tip; choose one of {joints}").fill(
                axis=repr(axis), joints=str(JOINTS)
            )
        )
    pin = tip_from_pivot(chain, joints[..., 3:])
    index = JOINTS.index(axis)
    if index < 3:
        return np.asarray(tip_m[..., index] - pin[..., index])
    reach, length = tip_m - joints[..., :3], joints[..., 5] - chain.pin_length
    thx, thy = joints[..., 3], joints[..., 4]
    if axis == "zn":
        return np.asarray(chain.pin_length + reach[..., 2] / (np.cos(thx) * np.cos(thy)))
    sine = -reach[..., 1] / length if axis == "thx" else reach[..., 0] / (length * np.cos(thx))
    if not (np.abs(sine) <= 1.0).all():
        raise MicroscopeError(
            message(
                "engine",
                "axis {axis}: the tip appears farther from the pivot than the pin is long; "
                "the calibration belongs to another machine or place: calibrate again",
            ).fill(axis=axis)
        )
    return np.asarray(np.arcsin(sine))


def with_reference(
    record: Record, axis: str, time_s: FloatArray, values: FloatArray, noise_rms: float
) -> Record:
    """Return the part of a record that frames cover, with ``axis.ref`` from them.

    Parameters
    ----------
    record : Record
    axis : str
    time_s : (n,)
        When the frames were taken, on the record's clock, increasing.
    values : (n,)
        Of :func:`axis_reference`, m or rad; NaN where the tip was lost.
    noise_rms : float
        Their uncertainty, m or rad: kept as metadata.

    Frames are slower than samples: between two of them the axis is taken to move evenly, so
    nothing above half the frame rate is in the reference.

    Raises
    ------
    MicroscopeError
        If the record does not know the axis or has a reference already, or fewer than two frames
        show the tip while it was taken.
    """
    if axis not in record.axes or record.has(axis, Tap.REF):
        said = (
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
        raise MicroscopeError(said.fill(axis=repr(axis), names=", ".join(record.axes)))
    seen = np.isfinite(values)
    times, places = np.asarray(time_s)[seen], np.asarray(values)[seen]
    rows = np.zeros(len(record.time_s), dtype=bool)
    if len(times) >= 2:
        rows = (record.time_s >= times[0]) & (record.time_s <= times[-1])
    if not rows.any():
        raise MicroscopeError(
            message(
                "engine",
                "{count} frames show the tip, but no time of the record lies between them; "
                "record frames and samples together, on one clock",
            ).fill(count=len(times))
        )
    kept = {
        (channel.axis, channel.tap): record.values[rows, column]
        for column, channel in enumerate(record.columns)
    }
    kept[axis, Tap.REF] = np.interp(record.time_s[rows], times, places)
    facts: Mapping[str, str] = {
        **record.metadata,
        "history": "unknown",
        f"{REFERENCE_NOISE} {axis}": f"{noise_rms:.6g}",
        "reference": f"microscope: {axis}, {noise_rms:.3g} rms, {len(times)} frames",
    }
    return Record.from_signals(record.time_s[rows], kept, record.units, facts)
